#include "tracking/association/split_merge.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"
#include "tracking/association/best_assignment.h"

namespace eyrie {
namespace {

constexpr double kMergedIsLarger = 1.2;   ///< a merged box has at least this many times the area of each of its tracks
constexpr double kDuplicateTracks = 0.5;  ///< tracks inside each other by this share are not a merge
constexpr double kBoxMargin = 3;          ///< px by which gradients widen boxes
constexpr double kFairPart = 0.08;        ///< area of a part, as a share of the track's, that counts as separate

std::size_t at(int index) {
    return static_cast<std::size_t>(index);
}

/// The work of one frame; its parts run in the order of `run`.
class Associator {
 public:
    Associator(const OverlapMatrix& matrix, const std::vector<MovingBox>& detections,
               const std::vector<MovingBox>& tracks, const std::vector<TrackAuthority>& authority,
               double part_containment, const VehicleLimit& one_vehicle)
        : matrix_(matrix),
          detections_(detections),
          tracks_(tracks),
          authority_(authority),
          part_containment_(part_containment),
          one_vehicle_(one_vehicle) {
        result_.tracks.resize(tracks.size());
        result_.used.assign(detections.size(), 0);
    }

    FrameAssociation run(SplitMergeRule rule) {
        if (rule == SplitMergeRule::overlap_matrix) markByMatrix();
        if (rule == SplitMergeRule::containment) markMergedByContainment();
        pairOneToOne();
        if (rule == SplitMergeRule::containment) fuseParts();
        return std::move(result_);
    }

 private:
    const BoxRelation& relation(int index) const { return matrix_.relations()[at(index)]; }

    /// Two ones in a column: merged; two ones in a row: split, all of whose detections are ignored.
    void markByMatrix() {
        for (int i = 0; i < matrix_.detectionCount(); ++i) {
            const auto ones = acceptedOf(matrix_.ofDetection(i));
            if (ones.size() < 2) continue;
            result_.used[at(i)] = 1;
            for (const int r : ones) result_.tracks[at(relation(r).track)].kind = AssociationKind::merged;
        }
        for (int j = 0; j < matrix_.trackCount(); ++j) {
            const auto ones = acceptedOf(matrix_.ofTrack(j));
            if (ones.size() < 2) continue;
            if (result_.tracks[at(j)].kind == AssociationKind::missed) {
                result_.tracks[at(j)].kind = AssociationKind::split;
            }
            for (const int r : ones) result_.used[at(relation(r).detection)] = 1;
        }
    }

    std::vector<int> acceptedOf(const std::vector<int>& relations) const {
        std::vector<int> ones;
        for (const int r : relations) {
            if (relation(r).accepted) ones.push_back(r);
        }
        return ones;
    }

    void markMergedByContainment() {
        for (int i = 0; i < matrix_.detectionCount(); ++i) {
            // Two tracks in a box that holds but one vehicle are parts of it.
            if (one_vehicle_.holds(detections_[at(i)].box)) continue;
            std::vector<int> covered;
            for (const int r : matrix_.ofDetection(i)) {
                const BoxRelation& here = relation(r);
                if (here.track_share < part_containment_ || !authority_[at(here.track)].mergeable) continue;
                if (detections_[at(i)].box.area() < kMergedIsLarger * tracks_[at(here.track)].box.area()) continue;
                if (hasBetterDetection(here) || liesInOneOf(covered, here.track)) continue;
                covered.push_back(here.track);
            }
            const bool known = std::any_of(covered.begin(), covered.end(),
                                           [&](int track) { return authority_[at(track)].established; });
            if (covered.size() < 2 || !known) continue;
            result_.used[at(i)] = 1;
            for (const int track : covered) result_.tracks[at(track)].kind = AssociationKind::merged;
        }
    }

    bool hasBetterDetection(const BoxRelation& here) const {
        const auto& others = matrix_.ofTrack(here.track);
        return std::any_of(others.begin(), others.end(), [&](int r) {
            const BoxRelation& other = relation(r);
            return other.detection != here.detection && other.accepted && other.score > here.overlap;
        });
    }

    bool liesInOneOf(const std::vector<int>& tracks, int track) const {
        return std::any_of(tracks.begin(), tracks.end(), [&](int other) {
            return containment(tracks_[at(other)].box, tracks_[at(track)].box) > kDuplicateTracks;
        });
    }

    void pairOneToOne() {
        std::vector<WeightedPair> pairs;
        for (const BoxRelation& here : matrix_.relations()) {
            if (!here.accepted || result_.used[at(here.detection)]) continue;
            if (result_.tracks[at(here.track)].kind != AssociationKind::missed) continue;
            // Squares favour one good pair over two poor ones; known tracks come first when otherwise equal.
            const double bonus = authority_[at(here.track)].confirmed ? 0.05 : 0.01;
            pairs.push_back({here.detection, here.track, here.score * here.score + bonus});
        }
        for (const int chosen : bestAssignment(pairs)) {
            const WeightedPair& pair = pairs[at(chosen)];
            result_.used[at(pair.row)] = 1;
            result_.tracks[at(pair.column)].kind = AssociationKind::matched;
            result_.tracks[at(pair.column)].detection = pair.row;
        }
    }

    /// Detections that were left over and lie in a predicted box are parts of its object.
    void fuseParts() {
        std::vector<std::vector<int>> parts(tracks_.size());
        for (int i = 0; i < matrix_.detectionCount(); ++i) {
            if (result_.used[at(i)]) continue;
            int home = -1;
            double best = part_containment_;
            for (const int r : matrix_.ofDetection(i)) {
                const BoxRelation& here = relation(r);
                const TrackAssociation& track = result_.tracks[at(here.track)];
                const bool open = track.kind == AssociationKind::missed || track.kind == AssociationKind::matched;
                if (!open || !authority_[at(here.track)].established || here.detection_share < best) continue;
                best = here.detection_share;
                home = here.track;
            }
            if (home >= 0) parts[at(home)].push_back(i);
        }
        for (std::size_t j = 0; j < tracks_.size(); ++j) {
            if (!parts[j].empty()) fusePartsOf(j, std::move(parts[j]));
        }
    }

    void fusePartsOf(std::size_t j, std::vector<int> parts) {
        TrackAssociation& track = result_.tracks[j];
        const OrientedBox& predicted = tracks_[j].box;
        if (track.detection >= 0) parts.insert(parts.begin(), track.detection);
        judgeParts(parts, predicted, track);
        if (authority_[j].gives_up_parts && track.in_parts) return;
        for (const int part : parts) result_.used[at(part)] = 1;
        if (parts.size() == 1) {
            track.kind = AssociationKind::matched;
            track.detection = parts.front();
            return;
        }
        OrientedBox fused{detections_[at(parts.front())].box.centre, 0, 0, predicted.heading};
        for (const int part : parts) fused = unionBox(fused, detections_[at(part)].box);
        const double alone = track.detection < 0 ? 0 : overlap(detections_[at(track.detection)].box, predicted);
        if (overlap(fused, predicted) < alone) return;
        track.kind = AssociationKind::split;
        track.parts = std::move(parts);
    }

    /// Tells fair parts that lie apart from fragments, and those of neighbours from those of one long vehicle.
    void judgeParts(const std::vector<int>& parts, const OrientedBox& predicted, TrackAssociation& track) const {
        std::vector<OrientedBox> fair;
        for (const int part : parts) {
            const OrientedBox& box = detections_[at(part)].box;
            if (box.area() < kFairPart * predicted.area()) continue;
            const bool apart = std::all_of(fair.begin(), fair.end(), [&](const OrientedBox& other) {
                return containment(other, box) < kDuplicateTracks;
            });
            if (!apart) continue;
            track.abreast = track.abreast || std::any_of(fair.begin(), fair.end(), [&](const OrientedBox& other) {
                                return areAbreast(other, box, predicted);
                            });
            fair.push_back(box);
        }
        track.in_parts = fair.size() >= 2;
    }

    static bool areAbreast(const OrientedBox& a, const OrientedBox& b, const OrientedBox& predicted) {
        if (std::min(a.length, b.length) < predicted.length / 2) return false;
        const cv::Point2d apart = predicted.toBox(a.centre) - predicted.toBox(b.centre);
        return std::abs(apart.x) < std::min(a.length, b.length) / 2 && std::abs(apart.y) > (a.width + b.width) / 4;
    }

    const OverlapMatrix& matrix_;
    const std::vector<MovingBox>& detections_;
    const std::vector<MovingBox>& tracks_;
    const std::vector<TrackAuthority>& authority_;
    double part_containment_;
    VehicleLimit one_vehicle_;
    FrameAssociation result_;
};

/// The heading that a vector suggests for its track's box; nothing when it is too slow to tell one.
std::optional<double> suggestedHeading(const AssociatedVector& associated, const MotionVector& vector,
                                       double slow_speed) {
    if (std::hypot(vector.velocity.x, vector.velocity.y) < slow_speed) return std::nullopt;
    return std::atan2(vector.velocity.y, vector.velocity.x) + associated.heading_offset;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

}  // namespace

VehicleLimit VehicleLimit::of(const TrackerOptions& options, const SceneScale& scale) {
    if (!(options.one_vehicle > 0)) return {};
    return {options.one_vehicle * scale.px(options.car_length_m) + kBoxMargin,
            options.one_vehicle * scale.px(options.car_width_m) + kBoxMargin, kBoxMargin, scale.slope};
}

FrameAssociation associateDetections(const OverlapMatrix& matrix, const std::vector<MovingBox>& detections,
                                     const std::vector<MovingBox>& tracks, const std::vector<TrackAuthority>& authority,
                                     SplitMergeRule rule, double part_containment, const VehicleLimit& one_vehicle) {
    return Associator(matrix, detections, tracks, authority, part_containment, one_vehicle).run(rule);
}

std::optional<Reconstruction> reconstructBox(const std::vector<AssociatedVector>& vectors, const FrameVectors& frame,
                                             const OrientedBox& predicted, int min_vectors, double slow_speed,
                                             double agreement, RebuiltSize size) {
    if (vectors.empty() || static_cast<int>(vectors.size()) < min_vectors) return std::nullopt;
    Reconstruction result;
    result.box = predicted;
    std::vector<double> turns;
    std::vector<double> vx;
    std::vector<double> vy;
    for (const AssociatedVector& associated : vectors) {
        const MotionVector& vector = frame.at(associated.index);
        vx.push_back(vector.velocity.x);
        vy.push_back(vector.velocity.y);
        const auto suggested = suggestedHeading(associated, vector, slow_speed);
        if (suggested) turns.push_back(turnBetween(predicted.heading, *suggested));
    }
    result.velocity = {median(vx), median(vy)};
    if (2 * turns.size() > vectors.size()) {
        result.box.heading = wrapPi(predicted.heading + median(turns));
        result.heading_known = true;
    }

    if (size == RebuiltSize::stored) {
        std::vector<double> lengths;
        std::vector<double> widths;
        for (const AssociatedVector& associated : vectors) {
            lengths.push_back(associated.length);
            widths.push_back(associated.width);
        }
        result.box.length = median(std::move(lengths));
        result.box.width = median(std::move(widths));
        result.size_known = true;
    }

    const auto suggestedCentre = [&](const AssociatedVector& associated) {
        const MotionVector& vector = frame.at(associated.index);
        OrientedBox axes = result.box;
        axes.centre = {0, 0};
        // To the letter each vector suggests a whole box, placed by its own heading.
        if (size == RebuiltSize::stored)
            axes.heading = suggestedHeading(associated, vector, slow_speed).value_or(axes.heading);
        return cv::Point2d(vector.position.x, vector.position.y) - axes.toImage(associated.in_box);
    };
    std::vector<double> x;
    std::vector<double> y;
    for (const AssociatedVector& associated : vectors) {
        const cv::Point2d centre = suggestedCentre(associated);
        x.push_back(centre.x);
        y.push_back(centre.y);
    }
    result.box.centre = {median(x), median(y)};
    // Corners that slid off the object disagree with the others about its place.
    const double reach = std::max(1.5, agreement * std::min(predicted.length, predicted.width));
    for (std::size_t i = 0; i < x.size(); ++i) {
        const cv::Point2d apart = cv::Point2d(x[i], y[i]) - result.box.centre;
        result.vectors += !(agreement > 0) || std::hypot(apart.x, apart.y) <= reach;
    }
    if (result.vectors < min_vectors) return std::nullopt;
    return result;
}

}  // namespace eyrie
