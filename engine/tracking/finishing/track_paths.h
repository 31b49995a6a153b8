#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tracking/finishing/track_finishing.h"
#include "tracking/finishing/vehicle_looks.h"
#include "tracking/ground_motion.h"

namespace eyrie {

/// How much smaller, or larger by its inverse, than a limit in metres a vehicle may seem where the GSD was estimated.
inline constexpr double kEstimatedShare = 0.8;

/// Score from which on a finished track is surely a vehicle: it is followed on where it ends, and is no part of
/// another.
inline constexpr double kSurelyVehicle = 0.8;

/// m; the longest vehicles that more than one track may be of.
inline constexpr double kLongestOfParts = 20;

/// Collects what is left out.
using DropList = std::vector<DroppedPath>;

/// Moves the states of a track to what is left out; it has none from then on.
inline void drop(TrackPath& path, TrackDrop why, DropList& dropped, TrackId beside = 0) {
    dropped.push_back({{path.id, std::move(path.states)}, why, beside});
    path.states.clear();
}

/// Takes the states of tracks one by one.
using PathVisitor = std::function<void(FrameIndex, const TrackPath&, const PathState&)>;
/// All states, ordered by frame, then the tracks' ids.
void visitByFrame(const std::vector<TrackPath>& paths, const PathVisitor& visitor);

/// Where a track is on the whole: the mean of its boxes' centres. Of at least one state.
cv::Point2d middleOf(const TrackPath& path);
/// The scale there, under the mean of its frames' zooms.
SceneScale scaleOf(const TrackPath& path, const SceneScale& scale);

/// Puts earlier states, the latest first, before those of a path.
void prepend(TrackPath& path, const std::vector<TimedPathState>& backwards);

/// Joins the fragments of one vehicle: where a track ends and another starts soon after at the predicted place with
/// similar velocity and size, the later one continues the earlier one. Gaps are filled by interpolation.
std::vector<TrackPath> joinFragments(std::vector<TrackPath> paths, const GroundMotion& ground,
                                     const FinishingOptions& options, const SceneScale& scale);

/// How tracks lie that are parts of one vehicle.
enum class PartsOfVehicle {
    in_line,     ///< one right behind the other, closer and longer than drivers follow each other
    overlapping  ///< on each other, as the cab, the load and the wheels of a lorry that is seen from the side
};

/// Joins tracks that are parts of one vehicle: they drive as if fixed to each other. The longer track's id stays. Boxes
/// that overlap must be steady, and those of shadows be gone.
void joinParts(std::vector<TrackPath>& paths, const SceneScale& scale, PartsOfVehicle wanted);

/// By tracks: where other tracks usually lie that may be parts of the same vehicle, m ahead and to the right of the
/// middle of its box.
using PartsByTrack = std::map<TrackId, std::map<TrackId, cv::Point2d>>;

/// Of scored tracks those that have such parts: tracks that drive as if fixed to them within the length and width of a
/// lorry, and are not surely vehicles themselves. Who keeps their distance do so, too: whether the ground lies between
/// them tells.
PartsByTrack partsBeside(const std::vector<TrackPath>& paths, const SceneScale& scale);

/// Replaces lengths and widths by their weighted median over a window, on the ground: enlargement by the camera, and by
/// the vehicle's own way towards it, is taken into account, detections count most.
void steadySize(TrackPath& path, const GroundMotion& ground, int half_window);

/// Replaces centres, velocities and headings by a local polynomial fit on the ground over `half_window` frames to
/// either side.
void smoothPath(TrackPath& path, const GroundMotion& ground, int half_window);

/// Drops tracks whose boxes stayed smaller than any vehicle. Nothing is dropped where lengths in metres mean nothing
/// (hasMetricLimits()); limits are lower where the GSD was estimated.
void dropTooSmall(std::vector<TrackPath>& paths, const FinishingOptions& options, const SceneScale& scale,
                  DropList& dropped);

/// Drops tracks whose boxes, in the median, are wider than `max_aspect` times their length; 0: none.
void dropWiderThanLong(std::vector<TrackPath>& paths, double max_aspect, DropList& dropped);

/// Two vehicles cannot be in one place: of two tracks that share more than `max_sharing` of the smaller one's area on
/// average (of the union where the larger box is wider than any vehicle), the one that was detected less often gives
/// way where they meet, or wholly when little of it is left.
void dropSharers(std::vector<TrackPath>& paths, double max_sharing, const SceneScale& scale, DropList& dropped);

/// Whether a track drives beside a vehicle as if fixed to it, its long side no more than `gap_m` (m) off, and was
/// detected less than half as often.
bool drivesAsShadowOf(const TrackPath& shadow, const TrackPath& vehicle, const SceneScale& scale, double gap_m);

/// Whether the first is a shadow, or a side, of the second.
using IsShadow = std::function<bool(const TrackPath& shadow, const TrackPath& vehicle)>;

/// Drops every track that is a shadow of another. What lay beside it is told to lie beside that other.
void dropShadows(std::vector<TrackPath>& paths, const IsShadow& is_shadow, DropList& dropped);
/// The same of those that touch the vehicle they drive beside, whatever they look like.
void dropShadows(std::vector<TrackPath>& paths, const SceneScale& scale, DropList& dropped);

/// Drops tracks that are text or marks drawn into the pictures: of what was detected most lies on `graphics`.
void dropGraphics(std::vector<TrackPath>& paths, const PictureMask& graphics, DropList& dropped);

/// Drops tracks that were guessed rather than seen: detected in less than `min_share` of their frames, not counting
/// predicted ones, and in less than 0.4 s altogether.
void dropHardlyDetected(std::vector<TrackPath>& paths, double min_share, const SceneScale& scale, DropList& dropped);

/// Drops tracks that need not move at all: over windows of 24 frames they go along the camera's flow no faster than a
/// standing thing of `standing_height` would seem to, or against it no faster than one of `standing_depth` below the
/// plane of the registration, or never faster than that in any direction, and the classifier never took them for a
/// vehicle. Nothing is dropped where the camera hardly moves. In oblique views also what moves just as a standing thing
/// would that the camera passes: of up to `standing_height`, or `roof_height` where the classifier never took it for
/// one; and what is seen above the horizon.
void dropStanding(std::vector<TrackPath>& paths, const GroundMotion& ground, const VehicleLooks& looks,
                  const FinishingOptions& options, DropList& dropped);

/// Gives every state the probability that its track is a vehicle that moves, and drops tracks below `min_score`, which
/// are told as `finished.doubtful`, too. What speaks for each, and for those that could stand, goes to
/// `finished.evidence`.
void scoreTracks(std::vector<TrackPath>& paths, const GroundMotion& ground, const VehicleLooks& looks, double min_score,
                 const SceneScale& scale, FinishedTracks& finished);

/// Follows tracks back in time by the motion vectors in their boxes, by at most `frames`: where a vehicle starts slowly
/// or hardly stands out, single vectors show it long before there are enough for a detection.
void traceBack(std::vector<TrackPath>& paths, const GroundMotion& ground, const VectorsAt& vectors_at, int frames);

/// Carries tracks that begin slowly and gather speed back to where they stood, as uniformly accelerated, and lets them
/// stand there, in all by at most `frames`: nothing moves yet, but the vehicle is there. While the box stays in the
/// image and off other tracks. Not where lengths in metres mean nothing; see hasMetricLimits().
void extendToRest(std::vector<TrackPath>& paths, const GroundMotion& ground, int frames, const SceneScale& scale);

/// Extends paths back over frames in which the motion vectors were too young, by constant velocity over the ground,
/// while the box stays in the image and off other tracks. Tracks that came in over the border less than `entry_frames`
/// before they were found are extended back to it.
void extendBack(std::vector<TrackPath>& paths, const GroundMotion& ground, int frames, int entry_frames);

/// Tracks that were followed on, or met another at once, by where they were.
struct FollowedEnds {
    std::set<TrackId> begins;
    std::set<TrackId> ends;
};

/// Follows tracks that are surely vehicles by their score on in the pictures where they begin or end in mid-picture, by
/// at most `frames` each way: while the pictures surely show them, they brake as vehicles do, lie in the image and keep
/// off other tracks. What stands there is not followed. Reads every frame that it needs once, in order.
FollowedEnds followEnds(std::vector<TrackPath>& paths, const GroundMotion& ground, const GrayOfFrame& gray_at,
                        int frames, const SceneScale& scale);

/// Joins tracks that were followed to one another: where one ends another begins at once and at the same place, and
/// nothing else does, however it turned meanwhile. Tells which went into which.
std::vector<std::pair<TrackId, TrackId>> joinMeeting(std::vector<TrackPath>& paths, const FollowedEnds& followed,
                                                     const GroundMotion& ground, const FinishingOptions& options,
                                                     const SceneScale& scale);

}  // namespace eyrie
