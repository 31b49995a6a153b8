#include "registration/graphics/burned_in_graphics.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "registration/estimation/point_jacobian.h"

namespace eyrie {
namespace {

constexpr int kWidest = 1000;        ///< px of the pictures that are looked at, by level of the pyramid
constexpr int kCell = 16;            ///< px of such a picture in which the ground's motion is one
constexpr double kShortest = 3;      ///< px of the ground's way from look to look, so that it shows something else …
constexpr double kLongest = 6;       ///< … not always the same, as the ground may repeat itself
constexpr float kMemory = 60;        ///< looks
constexpr float kFewest = 9;         ///< weight from which on a pixel can be judged
constexpr float kLeastGradient = 3;  ///< mean gradient of graphics, grey levels per px
constexpr float kCoherence = 0.3F;   ///< share of the gradient's energy that stays, of graphics …
constexpr float kByChance = 3;       ///< … and of what has been seen this often; ground has 1 by chance
constexpr int kAround = 2;           ///< px around a pixel that are judged together
constexpr int kBorder = 4;           ///< px at the border, where codecs and lenses leave a frame around the ground
constexpr int kFewestPixels = 6;     ///< less is chance
constexpr int kGlyphs = 15;          ///< px beside each other that belong together: figures between figures …
constexpr int kLine = 5;             ///< … and above each other
constexpr double kMostShare = 0.3;   ///< of the picture; more is no graphics
constexpr int kOldEnough = 8;        ///< frames of a corner that tells whether it stays …
constexpr double kStillPx = 0.2;     ///< … by this in the picture
constexpr double kLongestVehicle = 0.15;  ///< share of the picture's width; longer things need no corners to tell

/// Between kShortest and kLongest, the same for the same look.
double wayUntil(std::uint32_t look) {
    const std::uint32_t mixed = (look + 1) * 2654435761U;
    return kShortest + (kLongest - kShortest) * (mixed >> 8) / double(1U << 24);
}

/// Median over the picture's cells of how far the ground went.
double usualWay(const cv::Matx33d& way, cv::Size size) {
    std::vector<double> ways;
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 5; ++x) {
            const cv::Point2f place(float(size.width) * (float(x) + 0.5F) / 5,
                                    float(size.height) * (float(y) + 0.5F) / 5);
            const cv::Point2f moved = PointJacobian(way, place).point - place;
            ways.push_back(std::hypot(moved.x, moved.y));
        }
    }
    std::nth_element(ways.begin(), ways.begin() + 12, ways.end());
    return ways[12];
}

/// Components of a binary picture: `labels`, and what is counted of each, by label; 0 is what lies around them.
struct Components {
    struct Tally {
        int pixels = 0;
        int width = 0;
        int height = 0;
        int still = 0;   ///< corners that stay where they are in the picture …
        int moving = 0;  ///< … and that stay neither there nor on the ground
        bool known = false;
        bool kept = false;
    };
    cv::Mat1i labels;
    std::vector<Tally> tallies;

    explicit Components(const cv::Mat& binary) {
        cv::Mat stats;
        cv::Mat centroids;
        const int count = cv::connectedComponentsWithStats(binary, labels, stats, centroids, 8, CV_32S);
        tallies.resize(std::size_t(count));
        for (int label = 0; label < count; ++label) {
            Tally& tally = of(label);
            tally.pixels = stats.at<int>(label, cv::CC_STAT_AREA);
            tally.width = stats.at<int>(label, cv::CC_STAT_WIDTH);
            tally.height = stats.at<int>(label, cv::CC_STAT_HEIGHT);
        }
    }
    Tally& of(int label) { return tallies[std::size_t(label)]; }
    cv::Mat kept() const {
        cv::Mat1b result(labels.size());
        std::transform(labels.begin(), labels.end(), result.begin(), [&](int label) {
            return label > 0 && tallies[std::size_t(label)].kept ? uchar{255} : uchar{0};
        });
        return result;
    }
};

cv::Mat withoutSpecks(const cv::Mat& binary, int fewest) {
    Components components(binary);
    for (Components::Tally& tally : components.tallies) tally.kept = tally.pixels >= fewest;
    return components.kept();
}

}  // namespace

void GraphicsOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::registration);
    declare.flag("registration.leave_out_graphics", leave_out_graphics,
                 {"",
                  "Find text, reticles and logos that were drawn into the picture, by edges that stay while the ground "
                  "moves on under them, and look for neither ground nor motion there.",
                  ""});
}

void BurnedInGraphics::reset() {
    *this = BurnedInGraphics(options_);
}

void BurnedInGraphics::loseWay() {
    way_ = cv::Matx33d::eye();
}

void BurnedInGraphics::add(const ImagePyramid& picture, const CornerSet& corners,
                           const cv::Matx33d& current_from_previous) {
    if (!options_.leave_out_graphics || picture.levels() < 2) return;
    if (picture.size() != size_) {
        reset();
        size_ = picture.size();
        level_ = 1;
        while (level_ + 1 < picture.levels() && picture.level(level_).width() > kWidest) ++level_;
        for (std::vector<float>* sum : {&along_x_, &along_y_, &energy_, &weight_}) sum->assign(pixels(), 0.0F);
    }
    way_ = current_from_previous * way_;
    if (usualWay(way_, size_) < wayUntil(looks_)) return;
    look(picture.level(level_));
    way_ = cv::Matx33d::eye();
    ++looks_;
    findMask(corners);
}

void BurnedInGraphics::look(const PaddedPicture& picture) {
    const int width = picture.width();
    const int height = picture.height();
    const int rows_of_cells = (height + kCell - 1) / kCell;
    tbb::parallel_for(tbb::blocked_range<int>(0, rows_of_cells), [&](const tbb::blocked_range<int>& range) {
        for (int top = range.begin() * kCell; top < std::min(range.end() * kCell, height); top += kCell) {
            for (int left = 0; left < width; left += kCell) {
                const cv::Point2f place = ImagePyramid::fromLevel(
                    {float(left) + (kCell - 1) / 2.0F, float(top) + (kCell - 1) / 2.0F}, level_);
                const cv::Point2f moved = PointJacobian(way_, place).point - place;
                const float far = std::hypot(moved.x, moved.y);
                if (!(far > 0)) continue;
                const cv::Point2f direction = moved / far;
                const float weight = std::min(1.0F, far / float(kShortest));
                const float fade = 1 - weight / kMemory;
                // Border pixels have no gradient; sums over three rows and columns make the mask of Sobel.
                const int last_y = std::min(top + kCell, height - 1);
                const int last_x = std::min(left + kCell, width - 1);
                for (int y = std::max(1, top); y < last_y; ++y) {
                    const std::uint8_t* above = picture.row(y - 1);
                    const std::uint8_t* here = picture.row(y);
                    const std::uint8_t* below = picture.row(y + 1);
                    const std::size_t row = std::size_t(y) * std::size_t(width);
                    for (int x = std::max(1, left); x < last_x; ++x) {
                        const int right_less_left =
                            above[x + 1] - above[x - 1] + 2 * (here[x + 1] - here[x - 1]) + below[x + 1] - below[x - 1];
                        const int below_less_above =
                            below[x - 1] + 2 * below[x] + below[x + 1] - above[x - 1] - 2 * above[x] - above[x + 1];
                        const float along =
                            (direction.x * float(right_less_left) + direction.y * float(below_less_above)) / 8;
                        const std::size_t at = row + std::size_t(x);
                        along_x_[at] = along_x_[at] * fade + weight * along * direction.x;
                        along_y_[at] = along_y_[at] * fade + weight * along * direction.y;
                        energy_[at] = energy_[at] * fade + weight * along * along;
                        weight_[at] = weight_[at] * fade + weight;
                    }
                }
            }
        }
    });
}

cv::Mat BurnedInGraphics::stayingEdges() const {
    const int width = levelSize().width;
    const int height = levelSize().height;
    const auto at = [&](int x, int y) { return std::size_t(y) * std::size_t(width) + std::size_t(x); };
    const auto stays = [&](std::size_t i) { return along_x_[i] * along_x_[i] + along_y_[i] * along_y_[i]; };
    cv::Mat found = cv::Mat::zeros(levelSize(), CV_8UC1);
    tbb::parallel_for(tbb::blocked_range<int>(kBorder, height - kBorder), [&](const tbb::blocked_range<int>& range) {
        for (int y = range.begin(); y < range.end(); ++y) {
            for (int x = kBorder; x < width - kBorder; ++x) {
                const float seen = weight_[at(x, y)];
                if (seen < kFewest || stays(at(x, y)) < seen * seen * kLeastGradient * kLeastGradient) continue;
                float staying = 0;
                float all = 0;
                for (int v = y - kAround; v <= y + kAround; ++v) {
                    for (int u = x - kAround; u <= x + kAround; ++u) {
                        staying += stays(at(u, v));
                        all += energy_[at(u, v)] * weight_[at(u, v)];
                    }
                }
                if (staying > (kCoherence + kByChance / seen) * all) found.at<uchar>(y, x) = 255;
            }
        }
    });
    return found;
}

cv::Mat BurnedInGraphics::candidates() const {
    cv::Mat found = stayingEdges();
    if (cv::countNonZero(found) > 0) found = withoutSpecks(found, kFewestPixels);
    const int count = cv::countNonZero(found);
    if (count == 0 || count > kMostShare * double(pixels())) return {};
    // Room around it, so that what belongs together at the border does so, too.
    cv::copyMakeBorder(found, found, kLine, kLine, kGlyphs, kGlyphs, cv::BORDER_CONSTANT);
    cv::morphologyEx(found, found, cv::MORPH_CLOSE, cv::Mat1b::ones(kLine, kGlyphs));
    cv::dilate(found, found, cv::Mat1b::ones(3, 3));
    return found(cv::Rect({kGlyphs, kLine}, levelSize())).clone();
}

void BurnedInGraphics::findMask(const CornerSet& corners) {
    const cv::Mat found = candidates();
    if (found.empty()) {
        mask_ = {};
        return;
    }
    Components components(found);
    for (const TrackedCorner& corner : corners.corners) {
        if (corner.age < kOldEnough) continue;
        const cv::Point at(ImagePyramid::toLevel(corner.position, level_));
        if (!cv::Rect({}, levelSize()).contains(at)) continue;
        Components::Tally& tally = components.of(components.labels(at));
        const cv::Point2f gone = corner.position - corner.held;
        const bool still = corner.held_frames >= kOldEnough && std::hypot(gone.x, gone.y) <= kStillPx;
        if (still)
            ++tally.still;
        else if (!corner.on_background)
            ++tally.moving;
    }
    // Where graphics are known there are no corners any more.
    if (!mask_.empty()) {
        for (auto [label, marked] = std::pair(components.labels.begin(), mask_.cells.begin<uchar>());
             label != components.labels.end(); ++label, ++marked) {
            if (*marked != 0) components.of(*label).known = true;
        }
    }
    for (Components::Tally& tally : components.tallies) {
        const bool larger = std::max(tally.width, tally.height) > kLongestVehicle * levelSize().width;
        tally.kept = tally.known || larger || (tally.still > 0 && tally.still >= tally.moving);
    }
    mask_ = {components.kept(), 1 << level_};
}

}  // namespace eyrie
