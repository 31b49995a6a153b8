#include "tracking/silhouettes/silhouette_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/homography_jacobian.h"
#include "core/robust_statistics.h"
#include "core/values/last_frame.h"
#include "imaging/picture_darkness.h"
#include "tracking/finishing/frames_of.h"
#include "tracking/finishing/track_occupancy.h"

namespace eyrie {
namespace {

constexpr double kSureVehicle = 0.5;   ///< score …
constexpr double kMaybeVehicle = 0.2;  ///< … and of tracks that are looked at: parts and shadows are no sure vehicles
constexpr std::size_t kLooks = 12;     ///< at most, a track
constexpr double kPicturesApart = 0.1;  ///< s; so that few pictures are read
constexpr double kGroundWithin = 3;     ///< s before and after: later the light and the registration are others
constexpr int kGroundsASide = 2;
constexpr double kMarginAbout = 1.2;  ///< m about a vehicle
constexpr double kGridStep = 0.1;     ///< m, at least half a pixel
constexpr double kClear = 0.7;        ///< share of the margin that other boxes stay off

}  // namespace

class SilhouetteSearch::Plan {
 public:
    Plan(const std::vector<TrackPath>& paths, const PartsByTrack& parts, const GroundMotion& ground,
         const SceneScale& scale)
        : paths_(paths),
          parts_(parts),
          ground_(ground),
          scale_(scale),
          taken_(paths),
          apart_(std::max(1, framesOf(kPicturesApart, scale))),
          within_(framesOf(kGroundWithin, scale)) {}

    std::vector<Planned> looks() const {
        std::vector<Planned> looks;
        for (const TrackPath& path : paths_) {
            const double score = path.states.front().second.score;
            if (score < kMaybeVehicle) continue;
            for (const TimedPathState* state : momentsOf(path)) {
                const OrientedBox box = state->second.box;
                const double metre = scale_.at(state->first, box.centre).px(1);
                Planned look{{path.id, score >= kSureVehicle, state->first, box, 0, 0, 0, {}, {}},
                             SilhouetteGrid(box, kMarginAbout * metre, std::max(0.5, kGridStep * metre)),
                             ExtentGrid(box, metre, parts_.contains(path.id)),
                             {}};
                addGrounds(look, path, -1);
                addGrounds(look, path, 1);
                if (look.grounds.empty()) continue;
                look.last = state->first;
                for (const Ground& bare : look.grounds) look.last = std::max(look.last, bare.frame);
                looks.push_back(std::move(look));
            }
        }
        return looks;
    }

 private:
    std::vector<const TimedPathState*> momentsOf(const TrackPath& path) const {
        std::vector<const TimedPathState*> all;
        for (const TimedPathState& state : path.states) {
            const bool detected = state.second.origin == StateOrigin::detected;
            if (detected && state.first % apart_ == 0) all.push_back(&state);
        }
        if (all.size() <= kLooks) return all;
        std::vector<const TimedPathState*> spread;
        for (std::size_t i = 0; i < kLooks; ++i) spread.push_back(all[i * (all.size() - 1) / (kLooks - 1)]);
        return spread;
    }

    /// Goes through the pictures to one side, nearest first.
    void addGrounds(Planned& look, const TrackPath& path, int direction) const {
        cv::Matx33d there = cv::Matx33d::eye();
        int near = 0;
        int far = 0;
        for (int gone = 1; gone <= within_ && far < kGroundsASide; ++gone) {
            const FrameIndex frame = look.look.frame + direction * gone;
            const cv::Matx33d* step = ground_.step(frame - direction, frame, false);
            if (step == nullptr) return;
            there = *step * there;
            if (frame % apart_ != 0 || !isBare(look.look, there, frame)) continue;
            const TimedPathState* itself = path.at(frame);
            const bool is_far = itself == nullptr || !look.extents.mayReach(itself->second.box, there);
            const bool is_near = near < kGroundsASide;
            near += is_near ? 1 : 0;
            far += is_far ? 1 : 0;
            if (is_near || is_far) look.grounds.push_back({frame, there, is_near, is_far});
        }
    }

    /// Whether no track is near the place of a box, which the map takes into the frame.
    bool isBare(const SilhouetteLook& look, const cv::Matx33d& map, FrameIndex frame) const {
        const OrientedBox& box = look.box;
        const HomographyJacobian there(map, box.centre);
        const double margin = 2 * kClear * scale_.at(look.frame, box.centre).px(kMarginAbout);
        const OrientedBox place{there.point(), (box.length + margin) * there.scale(),
                                (box.width + margin) * there.scale(), there.turned(box.heading)};
        return taken_.isBare(frame, place);
    }

    const std::vector<TrackPath>& paths_;
    const PartsByTrack& parts_;
    const GroundMotion& ground_;
    const SceneScale& scale_;
    TrackOccupancy taken_;
    int apart_;   ///< frames between pictures that are read
    int within_;  ///< frames
};

std::map<TrackId, double> usualByTrack(const std::vector<SilhouetteLook>& looks, double SilhouetteLook::*figure,
                                       std::size_t fewest_looks) {
    std::map<TrackId, std::vector<double>> figures;
    for (const SilhouetteLook& look : looks) figures[look.track].push_back(look.*figure);
    std::map<TrackId, double> usual;
    for (auto& [track, of_track] : figures) {
        if (of_track.size() >= fewest_looks) usual[track] = medianOf(std::move(of_track));
    }
    return usual;
}

SilhouetteSearch::SilhouetteSearch(const std::vector<TrackPath>& paths, const GroundMotion& ground,
                                   const SceneScale& scale)
    : parts_(partsBeside(paths, scale)), planned_(Plan(paths, parts_, ground, scale).looks()) {
    for (std::size_t i = 0; i < planned_.size(); ++i) {
        wanting_[planned_[i].look.frame].push_back(i);
        for (const Ground& bare : planned_[i].grounds) wanting_[bare.frame].push_back(i);
    }
    for (const TrackPath& path : paths) {
        for (const auto& [frame, state] : path.states) {
            if (wanting_.contains(frame)) boxes_[frame].push_back({path.id, state.score, state.box});
        }
    }
}

void SilhouetteSearch::show(FrameIndex frame, const cv::Mat& gray) {
    const auto wanting = wanting_.find(frame);
    if (wanting == wanting_.end()) return;
    const double darkness = darknessOf(gray);
    for (const std::size_t i : wanting->second) take(planned_[i], frame, gray, boxes_[frame], darkness);
    wanting_.erase(wanting);
    boxes_.erase(frame);
}

bool SilhouetteSearch::mayBePart(TrackId vehicle, TrackId track) const {
    const auto parts = parts_.find(vehicle);
    return parts != parts_.end() && parts->second.contains(track);
}

void SilhouetteSearch::take(Planned& planned, FrameIndex frame, const cv::Mat& gray, const std::vector<TrackBox>& boxes,
                            double darkness) {
    const bool shows_vehicle = frame == planned.look.frame;
    std::vector<OrientedBox> others;
    for (const TrackBox& each : boxes) {
        // Who is not sure may be a part of the vehicle itself, too.
        const bool is_other = each.track != planned.look.track && each.score >= kSureVehicle &&
                              !mayBePart(planned.look.track, each.track);
        if (is_other || !shows_vehicle) others.emplace_back(each.box);
    }
    if (!gray.empty() && shows_vehicle) {
        planned.look.darkness = darkness;
        planned.vehicle = planned.grid.sampled(gray);
        planned.vehicle_about = planned.extents.sampled(gray, cv::Matx33d::eye(), others, true);
    } else if (!gray.empty()) {
        const auto ground = std::find_if(planned.grounds.begin(), planned.grounds.end(),
                                         [&](const Ground& each) { return each.frame == frame; });
        cv::Mat bare = ground->near ? planned.grid.sampled(gray, ground->way) : cv::Mat();
        if (!bare.empty()) planned.seen.push_back(std::move(bare));
        ExtentGrid::Sample about = planned.extents.sampled(gray, ground->way, others, false);
        if (ground->near) planned.near_seen.push_back(about);
        if (ground->far) planned.far_seen.push_back(std::move(about));
    }
    if (frame != planned.last) return;
    if (!planned.vehicle.empty() && !planned.seen.empty()) look(planned);
    planned.vehicle.release();
    planned.seen = {};
    planned.grounds = {};
    planned.vehicle_about = {};
    planned.near_seen = {};
    planned.far_seen = {};
}

void SilhouetteSearch::look(Planned& planned) {
    planned.look.shaded = planned.grid.shadedInBox(planned.vehicle, planned.seen);
    planned.look.beam = planned.grid.beamInBox(planned.vehicle, planned.seen);
    planned.look.silhouette = planned.grid.compare(planned.vehicle, planned.seen);
    // The nearest pictures show the ground best, but a long vehicle may still be there, or be there already.
    const auto by_near = planned.extents.compare(planned.vehicle_about, planned.near_seen);
    const auto by_far = planned.extents.compare(planned.vehicle_about, planned.far_seen);
    planned.look.extent = !by_near || (by_far && by_far->whole.length() > by_near->whole.length()) ? by_far : by_near;
    looks_.push_back(planned.look);
}

void SilhouetteSearch::readUpTo(FrameIndex frame, const GrayOfFrame& gray_at) {
    while (!wanting_.empty() && wanting_.begin()->first < frame) {
        const FrameIndex next = wanting_.begin()->first;
        show(next, gray_at(next));
    }
}

std::vector<SilhouetteLook> SilhouetteSearch::finish(const GrayOfFrame& gray_at) {
    readUpTo(kLastFrame + 1, gray_at);
    return std::move(looks_);
}

}  // namespace eyrie
