#include "motion/differences/silhouettes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <utility>

#include "core/values/inferred_ids.h"

namespace eyrie {
namespace {

constexpr double kCell = 0.3;  ///< m, at least a pixel: how finely a silhouette is looked at
constexpr double kVelocityShare = 0.12;
constexpr std::size_t kFewestCorners = 3;  ///< from which a silhouette is grown
constexpr std::size_t kFewestCells = 6;    ///< a silhouette has
constexpr double kFrontPx = 2;             ///< px by which a vehicle reaches beyond its corners …
constexpr double kFrontM = 0.5;            ///< … and m
constexpr double kAsideM = 1.5;            ///< m to either side of the corners that are looked at
constexpr double kTolerancePx = 2;         ///< px by which silhouettes may be wider: edges are blurred
constexpr double kShadowDarkest = 0.4;     ///< share of the ground's brightness that is left in a shadow …
constexpr double kShadowBrightest = 0.75;  ///< … at most
constexpr int kSamples = 5;                ///< of the ground's brightness, at different times …
constexpr int kFewestSamples = 3;          ///< … at least
constexpr double kOutlineStep = 2;         ///< px between inferred vectors
constexpr double kBesideCorner = 1.5;      ///< px: so close to a corner nothing needs to be inferred

/// Brightness of the ground at a place over time.
struct GroundBrightness {
    int median = 0;
    int spread = 0;  ///< without the extremes
};

/// Cells behind the front of a group of vectors, in rows across its motion.
class Lattice {
 public:
    struct Cell {
        int row = 0;     ///< from the front
        int column = 0;  ///< from the left
    };

    /// Lengths in px.
    Lattice(const VectorGroup& group, double cell, double ahead, double length, double half_width)
        : origin_(group.box.centre),
          along_(std::cos(group.box.heading), std::sin(group.box.heading)),
          across_(-along_.y, along_.x),
          cell_(cell),
          front_(group.box.length / 2 + ahead),
          rows_(static_cast<int>(length / cell)),
          half_(static_cast<int>(half_width / cell)) {}

    int rows() const { return rows_; }
    int columns() const { return 2 * half_ + 1; }
    double cell() const { return cell_; }
    /// px from the front
    double behind(int row) const { return row * cell_; }
    bool has(Cell cell) const {
        return cell.row >= 0 && cell.row < rows_ && cell.column >= 0 && cell.column < columns();
    }
    std::size_t index(Cell cell) const { return static_cast<std::size_t>(cell.row * columns() + cell.column); }
    cv::Point2d place(Cell cell) const {
        return origin_ + along_ * (front_ - behind(cell.row)) + across_ * ((cell.column - half_) * cell_);
    }
    Cell at(cv::Point2d place) const {
        const cv::Point2d from = place - origin_;
        return {cvRound((front_ - from.dot(along_)) / cell_), cvRound(from.dot(across_) / cell_) + half_};
    }

 private:
    cv::Point2d origin_;
    cv::Point2d along_;
    cv::Point2d across_;
    double cell_;
    double front_;
    int rows_;
    int half_;
};

/// What differs from the ground and hangs together with the vectors of a group.
template <typename IsVehicle>
std::vector<Lattice::Cell> grown(const Lattice& lattice, const std::vector<cv::Point2d>& seeds, IsVehicle is_vehicle) {
    std::vector<Lattice::Cell> region;
    std::vector<char> seen(static_cast<std::size_t>(std::max(0, lattice.rows() * lattice.columns())), 0);
    const auto visit = [&](Lattice::Cell cell) {
        if (!lattice.has(cell) || std::exchange(seen[lattice.index(cell)], 1)) return;
        if (is_vehicle(cell)) region.push_back(cell);
    };
    for (const cv::Point2d& seed : seeds) {
        const Lattice::Cell middle = lattice.at(seed);
        for (int row = -1; row <= 1; ++row) {
            for (int column = -1; column <= 1; ++column) visit({middle.row + row, middle.column + column});
        }
    }
    for (std::size_t i = 0; i < region.size(); ++i) {
        const Lattice::Cell cell = region[i];
        visit({cell.row - 1, cell.column});
        visit({cell.row + 1, cell.column});
        visit({cell.row, cell.column - 1});
        visit({cell.row, cell.column + 1});
    }
    return region;
}

/// The outermost cells of every row, as far as the region reaches, about kOutlineStep px apart.
std::vector<Lattice::Cell> outlineOf(const std::vector<Lattice::Cell>& region, const Lattice& lattice) {
    struct Row {
        int left = -1;
        int right = -1;
    };
    std::vector<Row> rows(static_cast<std::size_t>(lattice.rows()));
    int first = lattice.rows();
    for (const Lattice::Cell& cell : region) {
        Row& row = rows[static_cast<std::size_t>(cell.row)];
        row.left = row.left < 0 ? cell.column : std::min(row.left, cell.column);
        row.right = std::max(row.right, cell.column);
        first = std::min(first, cell.row);
    }
    std::vector<Lattice::Cell> outline;
    const int step = std::max(1, static_cast<int>(kOutlineStep / lattice.cell()));
    for (int at = first; at < lattice.rows(); at += step) {
        const Row& row = rows[static_cast<std::size_t>(at)];
        if (row.left < 0) continue;
        outline.push_back({at, row.left});
        if (row.right > row.left) outline.push_back({at, row.right});
    }
    return outline;
}

cv::Size2d extentOf(const std::vector<Lattice::Cell>& region, double cell) {
    const auto [front, rear] =
        std::minmax_element(region.begin(), region.end(), [](auto a, auto b) { return a.row < b.row; });
    const auto [left, right] =
        std::minmax_element(region.begin(), region.end(), [](auto a, auto b) { return a.column < b.column; });
    return {(rear->row - front->row + 1) * cell, (right->column - left->column + 1) * cell};
}

}  // namespace

/// The pictures before the newest one, asked by places of the newest one.
class Silhouettes::Past {
 public:
    explicit Past(const RegisteredFrames& frames) : frames_(frames) {
        for (int back = 0; back <= frames.count(); ++back) to_past_.push_back(frames.pathTo(back));
    }

    /// The ground as it was at least `since` pictures ago; nothing where it was hardly seen.
    std::optional<GroundBrightness> groundAt(cv::Point2d place, int since) const {
        std::array<int, kSamples> values{};
        int count = 0;
        const int step = std::max(1, (frames_.count() - since) / (kSamples + 1));
        for (int back = since; back <= frames_.count() && count < kSamples; back += step) {
            const int value = valueAt(back, place);
            if (value >= 0) values[static_cast<std::size_t>(count++)] = value;
        }
        if (count < kFewestSamples) return std::nullopt;
        std::sort(values.begin(), values.begin() + count);
        const auto seen = static_cast<std::size_t>(count);
        return GroundBrightness{values[seen / 2], values[seen - 2] - values[1]};
    }

 private:
    /// Interpolated; -1 outside the picture.
    int valueAt(int back, cv::Point2d place) const {
        const cv::Mat& gray = frames_.picture(back);
        const cv::Point2d there = to_past_[static_cast<std::size_t>(back)].apply(place);
        if (!(there.x >= 0 && there.y >= 0 && there.x < gray.cols - 1 && there.y < gray.rows - 1)) return -1;
        const int x = cvFloor(there.x);
        const int y = cvFloor(there.y);
        const double right = there.x - x;
        const double down = there.y - y;
        const uchar* upper = gray.ptr<uchar>(y) + x;
        const uchar* lower = gray.ptr<uchar>(y + 1) + x;
        return cvRound((1 - down) * ((1 - right) * upper[0] + right * upper[1]) +
                       down * ((1 - right) * lower[0] + right * lower[1]));
    }

    const RegisteredFrames& frames_;
    std::vector<Homography> to_past_;
};

void SilhouetteOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::motion);
    declare.flag(
        "motion.silhouettes", silhouettes,
        {"",
         "Infer the motion of plain roofs, which have no corners, where the picture differs from the ground as "
         "it was before the vehicle came.",
         ""});
    declare.integer(
        "motion.silhouette_frames", silhouette_frames, 4, 200,
        {"frames",
         "How long the ground is remembered. Longer: silhouettes of slower and longer vehicles; more memory "
         "and more changes of light.",
         ""});
    declare.real("motion.silhouette_contrast", silhouette_contrast, 1, 255,
                 {"grey", "A vehicle differs from the ground under it by at least this.", ""});
    declare.real("motion.silhouette_noise_factor", silhouette_noise_factor, 0, 50,
                 {"",
                  "A vehicle differs from the ground under it by at least this many times the spread of the ground's "
                  "brightness over time.",
                  ""});
    declare.real("motion.silhouette_min_speed", silhouette_min_speed_m_s, 0, 50,
                 {"m/s", "Slower vehicles get no silhouette.", ""});
    declare.real("motion.silhouette_max_length", silhouette_max_length_m, 1, 200,
                 {"m", "Longer silhouettes are no single vehicle and are not used.", ""});
    declare.real("motion.silhouette_max_width", silhouette_max_width_m, 1, 50,
                 {"m", "Wider silhouettes are not used either.", ""});
}

Silhouettes::Silhouettes(const SilhouetteOptions& options, const SceneScale& scale)
    : options_(options), scale_(scale), frames_(options.silhouette_frames), next_id_(kFirstOfSilhouettes) {}

void Silhouettes::add(const Frame& frame, const Registration& registration) {
    if (!options_.silhouettes) return;
    if (frame.gray.empty())
        frames_.clear();
    else
        frames_.add(frame, registration);
}

std::vector<MotionVector> Silhouettes::infer(const std::vector<MotionVector>& vectors, const std::vector<int>& chosen,
                                             double background_speed_sigma) {
    std::vector<MotionVector> inferred;
    if (!options_.silhouettes || frames_.count() < kFewestSamples) return inferred;
    const std::vector<VectorGroup> groups =
        groupVectors(vectors, chosen, vehicleLinkage(scale_, background_speed_sigma, kVelocityShare));
    const Past past(frames_);
    std::vector<std::vector<cv::Point2d>> outlines(groups.size());
    // Written by index, so that the result does not depend on the number of threads.
    cv::parallel_for_(cv::Range(0, static_cast<int>(groups.size())), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            const auto at = static_cast<std::size_t>(i);
            std::vector<cv::Point2d> corners;
            for (const int member : groups[at].members)
                corners.push_back(vectors[static_cast<std::size_t>(member)].position);
            outlines[at] = outlineAround(groups[at], corners, past);
        }
    });
    for (std::size_t i = 0; i < groups.size(); ++i) {
        for (const cv::Point2d& place : outlines[i]) inferred.push_back({next_id_++, place, groups[i].velocity, 0});
    }
    return inferred;
}

std::vector<cv::Point2d> Silhouettes::outlineAround(const VectorGroup& group, const std::vector<cv::Point2d>& corners,
                                                    const Past& past) const {
    const double speed = std::hypot(group.velocity.x, group.velocity.y);
    const SceneScale here = scale_.at(group.box.centre);
    if (corners.size() < kFewestCorners || !(speed >= here.pxPerFrame(options_.silhouette_min_speed_m_s))) return {};
    const double max_length = here.px(options_.silhouette_max_length_m);
    const double max_width = here.px(options_.silhouette_max_width_m) + kTolerancePx;
    const double ahead = kFrontPx + here.px(kFrontM);
    // Longer than what is allowed, to see what is too long.
    const Lattice lattice(group, std::max(1.0, here.px(kCell)), ahead, ahead + max_length + 2 * kTolerancePx,
                          group.box.width / 2 + here.px(kAsideM) + 1);
    const cv::Mat& now = frames_.newest();
    const cv::Rect image(0, 0, now.cols, now.rows);
    const auto is_vehicle = [&](Lattice::Cell cell) {
        const cv::Point2d place = lattice.place(cell);
        const cv::Point pixel(cvRound(place.x), cvRound(place.y));
        // The vehicle's front had not come here yet.
        const double since = std::max(2.0, std::ceil((lattice.behind(cell.row) + 1) / speed));
        if (!image.contains(pixel) || since > frames_.count() + 1 - kFewestSamples) return false;
        const auto ground = past.groundAt(pixel, static_cast<int>(since));
        if (!ground) return false;
        const double brightness = now.at<uchar>(pixel);
        const double share = brightness / std::max(1, ground->median);
        const bool shadow = share > kShadowDarkest && share < kShadowBrightest;
        return !shadow && std::abs(brightness - ground->median) >
                              std::max(options_.silhouette_contrast, options_.silhouette_noise_factor * ground->spread);
    };
    const std::vector<Lattice::Cell> region = grown(lattice, corners, is_vehicle);
    if (region.size() < kFewestCells) return {};
    const cv::Size2d extent = extentOf(region, lattice.cell());
    if (extent.width >= max_length || extent.height >= max_width) return {};
    std::vector<cv::Point2d> outline;
    for (const Lattice::Cell& cell : outlineOf(region, lattice)) {
        const cv::Point2d place = lattice.place(cell);
        const bool has_corner = std::any_of(corners.begin(), corners.end(), [&](const cv::Point2d& corner) {
            return std::hypot(corner.x - place.x, corner.y - place.y) < kBesideCorner;
        });
        if (!has_corner) outline.push_back(place);
    }
    return outline;
}

}  // namespace eyrie
