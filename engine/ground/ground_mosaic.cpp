#include "ground/ground_mosaic.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/error.h"

namespace eyrie {
namespace {

constexpr double kNewShare = 0.08;      ///< of the picture's diagonal that a corner moved: worth another frame
constexpr double kFewerFactor = 1.5;    ///< where there are too many
constexpr double kLongestSide = 16000;  ///< px, of a sheet
constexpr double kSoftEdge = 0.06;      ///< of the smaller side

double cornersApart(const std::vector<cv::Point2d>& a, const std::vector<cv::Point2d>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::hypot(a[i].x - b[i].x, a[i].y - b[i].y));
    return most;
}

double diagonalOf(const std::vector<cv::Point2d>& outline) {
    return std::min(std::hypot(outline[0].x - outline[2].x, outline[0].y - outline[2].y),
                    std::hypot(outline[1].x - outline[3].x, outline[1].y - outline[3].y));
}

}  // namespace

GroundMosaic::GroundMosaic(std::shared_ptr<const GroundSheets> sheets, const MosaicOptions& options)
    : sheets_(std::move(sheets)), colour_(options.colour) {
    if (sheets_->count() == 0) return;
    chooseFrames(std::max(1, options.wanted_frames));
    layOut(options);
    const cv::Size size = sheets_->imageSize();
    const double soft = std::max(1.0, kSoftEdge * std::min(size.width, size.height));
    edge_.create(size, CV_8UC1);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const int inside = 1 + std::min({x, y, size.width - 1 - x, size.height - 1 - y});
            edge_.at<uchar>(y, x) = cv::saturate_cast<uchar>(255 * std::min(1.0, inside / soft));
        }
}

void GroundMosaic::chooseFrames(int most) {
    for (double share = kNewShare;; share *= kFewerFactor) {
        frames_.clear();
        std::vector<cv::Point2d> last;
        for (FrameIndex frame = sheets_->firstFrame(); frame <= sheets_->lastFrame(); ++frame) {
            const std::vector<cv::Point2d> outline = sheets_->outlineOf(frame);
            const bool first = frame == sheets_->firstFrame() || sheets_->sheetOf(frame) != sheets_->sheetOf(frame - 1);
            const bool end = frame == sheets_->lastFrame() || sheets_->sheetOf(frame) != sheets_->sheetOf(frame + 1);
            if (!first && !end && cornersApart(outline, last) < share * diagonalOf(outline)) continue;
            frames_.push_back(frame);
            last = outline;
        }
        if (static_cast<int>(frames_.size()) <= std::max(most, 2 * sheets_->count())) return;
    }
}

void GroundMosaic::layOut(const MosaicOptions& options) {
    struct Extent {
        double left = 0, top = 0, right = 0, bottom = 0;
        bool any = false;
        cv::Rect2d area() const { return {cv::Point2d(left, top), cv::Point2d(right, bottom)}; }
    };
    std::vector<Extent> extents(static_cast<std::size_t>(sheets_->count()));
    for (FrameIndex frame = sheets_->firstFrame(); frame <= sheets_->lastFrame(); ++frame) {
        Extent& extent = extents[static_cast<std::size_t>(sheets_->sheetOf(frame))];
        for (const cv::Point2d& corner : sheets_->outlineOf(frame)) {
            extent.left = extent.any ? std::min(extent.left, corner.x) : corner.x;
            extent.top = extent.any ? std::min(extent.top, corner.y) : corner.y;
            extent.right = extent.any ? std::max(extent.right, corner.x) : corner.x;
            extent.bottom = extent.any ? std::max(extent.bottom, corner.y) : corner.y;
            extent.any = true;
        }
    }
    const auto isWanted = [&](std::size_t sheet) {
        const auto& wanted = options.wanted_sheets;
        return wanted.empty() || std::find(wanted.begin(), wanted.end(), static_cast<int>(sheet)) != wanted.end();
    };
    double area = 0;
    double longest = 1;
    for (std::size_t i = 0; i < extents.size(); ++i) {
        const Extent& extent = extents[i];
        if (!isWanted(i)) continue;
        area += extent.area().area();
        longest = std::max({longest, extent.area().width, extent.area().height});
    }
    const double budget = static_cast<double>(std::max<std::int64_t>(1, options.max_pixels));
    const double scale = std::min({1.0, std::sqrt(budget / std::max(1.0, area)), kLongestSide / longest});
    for (std::size_t i = 0; i < extents.size(); ++i) {
        MosaicSheet sheet;
        sheet.area = extents[i].area();
        sheet.px_per_unit = isWanted(i) ? scale : 1 / std::max({1.0, sheet.area.width, sheet.area.height});
        const auto side = [&](double length) {
            return std::max(1, static_cast<int>(std::floor(length * sheet.px_per_unit)));
        };
        const cv::Size size(side(sheet.area.width), side(sheet.area.height));
        sheet.picture = cv::Mat::zeros(size, colour_ ? CV_8UC3 : CV_8UC1);
        sheet.painted = cv::Mat::zeros(size, CV_8UC1);
        pictures_.push_back(std::move(sheet));
    }
}

void GroundMosaic::paint(const Frame& frame) {
    const int index = sheets_->sheetOf(frame.index);
    if (index < 0) return;
    cv::Mat pixels = colour_ && !frame.colour.empty() ? frame.colour : frame.gray;
    if (pixels.size() != sheets_->imageSize())
        throw Error(ErrorKind::input, "frame " + std::to_string(frame.index) +
                                          " is of another size than the run says; was it made from another video?");
    if (colour_ && pixels.channels() == 1) cv::cvtColor(pixels, pixels, cv::COLOR_GRAY2BGR);
    MosaicSheet& sheet = pictures_[static_cast<std::size_t>(index)];
    const double k = sheet.px_per_unit;
    const cv::Matx33d picture_from_sheet(k, 0, -k * sheet.area.x - 0.5, 0, k, -k * sheet.area.y - 0.5, 0, 0, 1);
    const cv::Matx33d map = picture_from_sheet * sheets_->sheetFromImage(frame.index);
    std::vector<cv::Point2f> outline;
    for (const cv::Point2d& corner : sheets_->outlineOf(frame.index))
        outline.emplace_back(sheet.pictureFromSheet(corner));
    const cv::Rect part = cv::boundingRect(outline) & cv::Rect({}, sheet.picture.size());
    if (part.empty()) return;
    const cv::Matx33d part_from_image = cv::Matx33d(1, 0, -part.x, 0, 1, -part.y, 0, 0, 1) * map;
    cv::Mat seen, weight;
    cv::warpPerspective(pixels, seen, part_from_image, part.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    cv::warpPerspective(edge_, weight, part_from_image, part.size(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
    cv::Mat below = sheet.picture(part);
    cv::Mat painted = sheet.painted(part);
    const int channels = below.channels();
    for (int y = 0; y < part.height; ++y) {
        const uchar* from = seen.ptr(y);
        const uchar* share = weight.ptr(y);
        uchar* to = below.ptr(y);
        uchar* mark = painted.ptr(y);
        for (int x = 0; x < part.width; ++x) {
            if (share[x] == 0) continue;
            // Where nothing is there yet, the edge of a picture is as good as its middle.
            const int w = mark[x] == 0 ? 255 : share[x];
            for (int c = 0; c < channels; ++c) {
                const int at = x * channels + c;
                to[at] = static_cast<uchar>((to[at] * (255 - w) + from[at] * w + 127) / 255);
            }
            mark[x] = 255;
        }
    }
}

}  // namespace eyrie
