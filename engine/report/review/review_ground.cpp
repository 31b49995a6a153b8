#include <algorithm>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "ground/ground_mosaic.h"
#include "ground/place_history.h"
#include "report/review/review_parts.h"

namespace eyrie {
namespace {

constexpr std::size_t kMostSheets = 6;
constexpr int kWantedFrames = 150;
constexpr std::int64_t kMostPixels = 6'000'000;
constexpr int kWidest = 1800;      ///< px
constexpr int kLeastWidth = 1200;  ///< px
constexpr int kRing_px = 9;
constexpr double kWidth_mm = 170;
constexpr int kGroundQuality = 85;
constexpr int kGroundBits = 4;

const cv::Scalar kEdge(20, 20, 20);
const cv::Scalar kWay(230, 230, 230);
const cv::Scalar kEventWay(230, 150, 45);
const cv::Scalar kPlace(70, 90, 255);

/// The mosaic of one sheet on its way to a picture of the report.
class SheetPainter {
 public:
    SheetPainter(const MosaicSheet& sheet, const GroundSheets& sheets) : sheet_(sheet), sheets_(sheets) {
        // Small ones are enlarged, so that rings and lines do not hide what they are about.
        const double widest = static_cast<double>(kWidest) / sheet.picture.cols;
        zoom_ = std::min(widest, std::max(1.0, static_cast<double>(kLeastWidth) / sheet.picture.cols));
        cv::resize(sheet.picture, picture_, {}, zoom_, zoom_, zoom_ < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
        if (picture_.channels() == 1) cv::cvtColor(picture_, picture_, cv::COLOR_GRAY2BGR);
    }

    void way(const SheetPath& path, FrameIndex first, FrameIndex last) const {
        std::vector<cv::Point> all, part;
        for (const FramePoint& point : path.points) {
            all.push_back(fixed(point.at));
            if (point.frame >= first && point.frame <= last) part.push_back(all.back());
        }
        cv::polylines(picture_, all, false, kEdge, 3, cv::LINE_AA, kGroundBits);
        cv::polylines(picture_, all, false, kWay, 1, cv::LINE_AA, kGroundBits);
        cv::polylines(picture_, part, false, kEventWay, 3, cv::LINE_AA, kGroundBits);
    }

    /// Rings at the places of events, and their numbers; those that lie on each other share one label.
    void places(const std::vector<Event>& events, const std::vector<std::size_t>& indices) const {
        std::vector<std::pair<cv::Point, std::string>> labels;
        for (const std::size_t index : indices) {
            const cv::Point at = ring(events[index]);
            const auto near = std::find_if(labels.begin(), labels.end(), [at](const auto& label) {
                return cv::norm(label.first - at) < kRing_px * (1 << kGroundBits);
            });
            const std::string number = std::to_string(index + 1);
            if (near == labels.end())
                labels.emplace_back(at, number);
            else
                near->second += ", " + number;
        }
        for (const auto& [at, text] : labels) write(at, text);
    }

    std::string jpeg() const {
        std::vector<unsigned char> bytes;
        cv::imencode(".jpg", picture_, bytes, {cv::IMWRITE_JPEG_QUALITY, kGroundQuality});
        return {bytes.begin(), bytes.end()};
    }

 private:
    cv::Point ring(const Event& event) const {
        const cv::Vec3d at = sheets_.sheetFromImage(event.frame) * cv::Vec3d(event.place.x, event.place.y, 1);
        const cv::Point centre = fixed({at[0] / at[2], at[1] / at[2]});
        for (const auto& [colour, width] : {std::pair(kEdge, 4), std::pair(kPlace, 2)})
            cv::circle(picture_, centre, kRing_px << kGroundBits, colour, width, cv::LINE_AA, kGroundBits);
        return centre;
    }

    /// Right of a ring, within the picture.
    void write(cv::Point ring, const std::string& text) const {
        constexpr double kHeight = 0.5;
        const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kHeight, 1, nullptr);
        cv::Point at(ring.x / (1 << kGroundBits) + kRing_px + 3, ring.y / (1 << kGroundBits) + size.height / 2);
        at.x = std::clamp(at.x, 0, std::max(0, picture_.cols - size.width - 2));
        at.y = std::clamp(at.y, size.height + 2, std::max(size.height + 2, picture_.rows - 2));
        for (const auto& [colour, width] : {std::pair(kEdge, 4), std::pair(kPlace, 1)})
            cv::putText(picture_, text, at, cv::FONT_HERSHEY_SIMPLEX, kHeight, colour, width, cv::LINE_AA);
    }

    cv::Point fixed(cv::Point2d on_sheet) const {
        const cv::Point2d p = (sheet_.pictureFromSheet(on_sheet) + cv::Point2d(0.5, 0.5)) * zoom_;
        return {cvRound((p.x - 0.5) * (1 << kGroundBits)), cvRound((p.y - 0.5) * (1 << kGroundBits))};
    }

    const MosaicSheet& sheet_;
    const GroundSheets& sheets_;
    double zoom_ = 1;
    cv::Mat picture_;
};

/// The sheets on which events lie, those with most first.
std::vector<std::pair<int, std::vector<std::size_t>>> sheetsOf(const std::vector<std::size_t>& events,
                                                               const ReviewScene& scene, const GroundSheets& sheets) {
    std::map<int, std::vector<std::size_t>> found;
    for (const std::size_t index : events) {
        const int sheet = sheets.sheetOf(scene.input().reviewed.events[index].frame);
        if (sheet >= 0) found[sheet].push_back(index);
    }
    std::vector<std::pair<int, std::vector<std::size_t>>> ordered(found.begin(), found.end());
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
    return ordered;
}

}  // namespace

GroundChapter addGround(const ReviewScene& scene, const std::vector<std::size_t>& events, FrameSource& pixels,
                        ReportFile& report, const std::function<void(double)>& progress, const std::stop_token& stop) {
    GroundChapter chapter;
    const Footage& footage = scene.input().reviewed.tracks.footage;
    const auto sheets = std::make_shared<const GroundSheets>(footage, footage.first_frame);
    auto ordered = sheetsOf(events, scene, *sheets);
    if (ordered.empty()) return chapter;
    for (std::size_t i = kMostSheets; i < ordered.size(); ++i) chapter.left_out += ordered[i].second.size();
    if (ordered.size() > kMostSheets) ordered.resize(kMostSheets);
    MosaicOptions options{kMostPixels, kWantedFrames};
    for (const auto& sheet : ordered) options.wanted_sheets.push_back(sheet.first);
    GroundMosaic mosaic(sheets, options);
    double done = 0;
    for (const FrameIndex frame : mosaic.frames()) {
        if (stop.stop_requested()) return {};
        if (progress) progress(++done / static_cast<double>(mosaic.frames().size()));
        const bool shown = std::any_of(ordered.begin(), ordered.end(),
                                       [&](const auto& sheet) { return sheet.first == sheets->sheetOf(frame); });
        if (shown && frame < pixels.info().frame_count) mosaic.paint(pixels.read(frame, true));
    }
    const auto paths = pathsOn(*sheets, scene.input().reviewed.tracks.tracks);
    for (const auto& [sheet, indices] : ordered) {
        const auto at = static_cast<std::size_t>(sheet);
        const SheetPainter painter(mosaic.sheets()[at], *sheets);
        for (const std::size_t index : indices) {
            const Event& event = scene.input().reviewed.events[index];
            for (const SheetPath& path : paths[at])
                if (std::find(event.tracks.begin(), event.tracks.end(), path.track) != event.tracks.end())
                    painter.way(path, event.first_frame, event.last_frame);
        }
        painter.places(scene.input().reviewed.events, indices);
        const std::string name = "ground-" + std::to_string(sheet + 1);
        report.add(name, ReportPicture::Kind::jpeg, painter.jpeg(), kWidth_mm);
        chapter.pictures.push_back(name);
    }
    return chapter;
}

}  // namespace eyrie
