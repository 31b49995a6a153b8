#include "tracking/finishing/track_finishing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "tracking/finishing/frames_of.h"
#include "tracking/finishing/track_paths.h"
#include "tracking/ground_motion.h"
#include "tracking/pictures/light_telling.h"
#include "tracking/pictures/picture_finishing.h"

namespace eyrie {
namespace {

bool usableForFinishing(const TrackState& state) {
    const OrientedBox& box = state.box;
    return std::isfinite(box.centre.x) && std::isfinite(box.centre.y) && std::isfinite(box.heading) &&
           std::isfinite(box.area()) && box.length > 0 && box.width > 0 && std::isfinite(state.velocity.x) &&
           std::isfinite(state.velocity.y);
}

/// The tracks that were ever confirmed, by ascending id; the others go to `unconfirmed`.
std::vector<TrackPath> groupedById(const StatesOfRun& states, std::unordered_set<TrackId>& unconfirmed) {
    // Counted first: vectors that grow hold up to twice as much as they need.
    struct Seen {
        std::size_t states = 0;
        bool confirmed = false;
    };
    std::map<TrackId, Seen> seen;
    states([&](FrameIndex, const TrackState& state) {
        if (!usableForFinishing(state)) return;
        Seen& track = seen[state.id];
        ++track.states;
        track.confirmed = track.confirmed || state.status != TrackStatus::tentative;
    });
    std::map<TrackId, TrackPath> by_id;
    for (const auto& [id, track] : seen) {
        if (!track.confirmed) {
            unconfirmed.insert(id);
            continue;
        }
        by_id[id].id = id;
        by_id[id].states.reserve(track.states);
    }
    states([&](FrameIndex frame, const TrackState& state) {
        const auto path = by_id.find(state.id);
        if (path != by_id.end() && usableForFinishing(state)) path->second.states.emplace_back(frame, PathState(state));
    });
    std::vector<TrackPath> paths;
    for (auto& [id, path] : by_id) {
        auto& all = path.states;
        std::stable_sort(all.begin(), all.end(),
                         [](const TimedPathState& a, const TimedPathState& b) { return a.first < b.first; });
        all.erase(std::unique(all.begin(), all.end(),
                              [](const TimedPathState& a, const TimedPathState& b) { return a.first == b.first; }),
                  all.end());
        paths.push_back(std::move(path));
    }
    return paths;
}

/// An object that is on its way out of the image is not lost but gone.
bool leftTheImage(const TrackPath& path, const GroundMotion& ground) {
    return ground.cutByBorder(path.states.back().second.box, path.lastFrame());
}

/// `stop_speed`: px/frame below which a lost object is taken to stand where it was, unless its place was looked at.
void trimPredictedEnd(TrackPath& path, const GroundMotion& ground, double stop_speed) {
    if (leftTheImage(path, ground)) return;
    std::size_t seen = path.states.size();
    while (seen > 0 && path.states[seen - 1].second.origin == StateOrigin::predicted) --seen;
    if (seen > 0 && path.states[seen - 1].second.origin != StateOrigin::standing) {
        const cv::Point2d velocity = path.states[seen - 1].second.velocity;
        if (std::hypot(velocity.x, velocity.y) < stop_speed) return;
    }
    path.states.resize(seen);
}

}  // namespace

void FinishingOptions::describe(ParameterVisitor& v) {
    const ParameterDeclarer declare(v, ChainStage::finishing);
    declare.flag(
        "finishing.keep_tentative", keep_tentative,
        {"", "A confirmed track's states from before its confirmation belong to the result.", "Teutsch §7.1.2"});
    declare.flag("finishing.trim_predicted", trim_predicted,
                 {"", "Cut the end of a track that was predicted only, unless it left the image.", ""});
    declare.real("finishing.stop_speed", stop_speed_m_s, 0, 50,
                 {"m/s", "An object that was lost while slower than this stands: its predicted end is kept.", ""});
    declare.real("finishing.join_gap", join_gap_s, 0, 60,
                 {"s", "Longest gap over which two fragments become one track. 0: never joined.", ""});
    declare.real("finishing.join_distance_m", join_distance_m, 0, 100,
                 {"m",
                  "Largest distance between where a fragment is expected and where the next one starts; grows with the "
                  "gap.",
                  ""});
    declare.real("finishing.join_distance_px", join_distance_px, 0, 500, {"px", "Pixel floor of join_distance_m.", ""});
    declare.flag("finishing.constant_size", constant_size,
                 {"", "Vehicles keep their size on the ground: replace it by its median over size_window.", ""});
    declare.real("finishing.size_window", size_window_s, 0, 3600,
                 {"s", "Window of that median. Short windows follow changes of the view, long ones are steadier.", ""});
    declare.flag("finishing.smooth_path", smooth_path,
                 {"", "Smooth centres and headings by fits over frames before and after.", ""});
    declare.real("finishing.smooth_window", smooth_window_s, 0, 60,
                 {"s", "Width of those fits. Wide ones cut corners.", ""});
    declare.integer(
        "finishing.extend_back", extend_back, 0, 100,
        {"frames", "Extend a track back to where its motion vectors began, before they were old enough to count.", ""});
    declare.real("finishing.extend_entry", extend_entry_s, 0, 60,
                 {"s", "Longest extension of a track back to the border of the image where it came in.", ""});
    declare.real(
        "finishing.trace_back", trace_back_s, 0, 60,
        {"s",
         "Follow a track back in time by single motion vectors, by at most this long: vehicles that start slowly or "
         "hardly stand out show some before they are detected. 0: never.",
         ""});
    declare.real(
        "finishing.from_rest", from_rest_s, 0, 60,
        {"s",
         "A track that begins slowly and gathers speed is carried back to where the vehicle stood and stands there, "
         "in all by at most this long. 0: never.",
         ""});
    declare.real("finishing.follow_ends", follow_ends_s, 0, 60,
                 {"s",
                  "A track that is surely a vehicle and that begins or ends in mid-picture is followed on in the "
                  "pictures, while they surely show it, by at most this long. Needs a method with a classifier. 0: "
                  "never.",
                  ""});
    declare.real(
        "finishing.min_length", min_length_m, 0, 100,
        {"m", "Tracks whose boxes stay shorter are not vehicles. Used where the ground sampling distance is known.",
         ""});
    declare.real("finishing.min_width", min_width_m, 0, 100, {"m", "The same for the width.", ""});
    declare.real("finishing.max_aspect", max_aspect, 0, 10,
                 {"",
                  "Tracks whose boxes are usually wider than this many times their length are no vehicles, but people, "
                  "riders or upright things seen from the side. 0: none.",
                  ""});
    declare.real(
        "finishing.max_sharing", max_sharing, 0, 1,
        {"",
         "Two tracks that on average share more than this of the smaller box are one vehicle: the one detected "
         "less often gives way. 1: never.",
         ""});
    declare.flag(
        "finishing.drop_shadows", drop_shadows,
        {"",
         "Tracks that drive beside a vehicle as if fixed to it and were detected less than half as often are its "
         "shadow and are dropped; such as touch it, and with finishing.trim_shadows also such as lie farther off where "
         "shadows fall.",
         ""});
    declare.flag("finishing.trim_shadows", trim_shadows,
                 {"",
                  "Take the shadow out of the boxes of sure tracks where the vehicles show which way shadows fall, and "
                  "what their headlights light about them where no shadows fall and a quarter of the tracks have "
                  "them on, fewer in the dark. Needs a method with a classifier.",
                  ""});
    declare.flag("finishing.whole_lorries", whole_lorries,
                 {"",
                  "Where the box of a sure track holds a part of a longer vehicle, make it as long as what hides the "
                  "ground there, and leave out the tracks of other parts. Not in the dark. Used where the ground "
                  "sampling distance is known or was estimated. Needs a method with a classifier.",
                  ""});
    declare.real(
        "finishing.min_detected", min_detected, 0, 1,
        {"",
         "Tracks detected in less than this share of their frames, not counting predicted ones, and in less than "
         "0.4 s altogether, are dropped. 0: none.",
         ""});
    declare.real(
        "finishing.standing_height", standing_height, 0, 0.9,
        {"",
         "A track that goes along the camera's flow no faster than a standing thing of this share of the flight "
         "height would seem to, and that was never classified as a vehicle, is taken for standing and dropped; in "
         "oblique views also one that moves just as such a thing would that the camera passes or circles, whatever it "
         "was classified as. 0: never.",
         ""});
    declare.real(
        "finishing.standing_depth", standing_depth, 0, 0.9,
        {"", "The same against the flow: over relief the plane of the registration may lie above the ground. 0: never.",
         ""});
    declare.real(
        "finishing.roof_height", roof_height, 0, 0.9,
        {"",
         "In oblique views a track that moves just as a thing of this share of the flight height would that the camera "
         "passes or circles, and that was never classified as a vehicle, is taken for standing and dropped. 0: none.",
         ""});
    declare.real("finishing.min_score", min_score, 0, 1,
                 {"",
                  "Tracks with a lower probability of being a moving vehicle, gathered along their life, are dropped. "
                  "Needs a method with a classifier. 0: none; larger: fewer false tracks, unsure vehicles are lost.",
                  ""});
    declare.flag(
        "finishing.join_parts", join_parts,
        {"",
         "Tracks that drive right behind or on each other as if fixed are parts of one vehicle. Used where the ground "
         "sampling distance is known or was estimated.",
         ""});
}

FinishingOptions FinishingOptions::thesis() {
    FinishingOptions options;
    options.trim_predicted = false;
    options.join_gap_s = 0;
    options.constant_size = false;
    options.smooth_path = false;
    options.extend_back = 0;
    options.extend_entry_s = 0;
    options.trace_back_s = 0;
    options.from_rest_s = 0;
    options.follow_ends_s = 0;
    options.min_length_m = 0;
    options.min_width_m = 0;
    options.max_aspect = 0;
    options.max_sharing = 1;
    options.drop_shadows = false;
    options.trim_shadows = false;
    options.whole_lorries = false;
    options.min_detected = 0;
    options.join_parts = false;
    options.standing_height = 0;
    options.standing_depth = 0;
    options.roof_height = 0;
    options.min_score = 0;
    return options;
}

namespace {

template <class Value>
std::function<std::vector<Value>(FrameIndex)> askFor(const std::unordered_map<FrameIndex, std::vector<Value>>& kept) {
    return [&kept](FrameIndex frame) {
        const auto found = kept.find(frame);
        return found == kept.end() ? std::vector<Value>{} : found->second;
    };
}

}  // namespace

ClassifiedAt classifiedIn(const ClassifiedByFrame& kept) {
    return askFor(kept);
}

VectorsAt vectorsIn(const VectorsByFrame& kept) {
    return askFor(kept);
}

cv::Point2d middleOf(const TrackPath& path) {
    cv::Point2d sum(0, 0);
    for (const auto& [frame, state] : path.states) sum += cv::Point2d(state.box.centre);
    return sum / static_cast<double>(std::max<std::size_t>(path.states.size(), 1));
}

SceneScale scaleOf(const TrackPath& path, const SceneScale& scale) {
    if (path.states.empty()) return scale.at(scale.slope.centre());
    double zooms = 0;
    for (const auto& [frame, state] : path.states) zooms += scale.zoom.at(frame);
    return scale.zoomed(zooms / static_cast<double>(path.states.size())).at(middleOf(path));
}

void prepend(TrackPath& path, const std::vector<TimedPathState>& backwards) {
    // Not by insert, which would hold twice as much from then on.
    std::vector<TimedPathState> states;
    states.reserve(backwards.size() + path.states.size());
    states.insert(states.end(), backwards.rbegin(), backwards.rend());
    states.insert(states.end(), path.states.begin(), path.states.end());
    path.states = std::move(states);
}

void visitByFrame(const std::vector<TrackPath>& paths, const PathVisitor& visitor) {
    // Tracks in the order in which they begin, and of those alive what each has still to tell.
    struct Alive {
        const TrackPath* path;
        std::span<const TimedPathState> rest;
    };
    std::vector<const TrackPath*> waiting;
    for (const TrackPath& path : paths) waiting.push_back(&path);
    std::sort(waiting.begin(), waiting.end(), [](const TrackPath* a, const TrackPath* b) {
        return a->firstFrame() != b->firstFrame() ? a->firstFrame() < b->firstFrame() : a->id < b->id;
    });
    std::map<TrackId, Alive> alive;
    std::size_t next = 0;
    for (FrameIndex frame = 0; next < waiting.size() || !alive.empty(); ++frame) {
        if (alive.empty()) frame = waiting[next]->firstFrame();
        for (; next < waiting.size() && waiting[next]->firstFrame() == frame; ++next) {
            alive[waiting[next]->id] = {waiting[next], waiting[next]->states};
        }
        for (auto each = alive.begin(); each != alive.end();) {
            auto& [path, rest] = each->second;
            if (rest.front().first == frame) {
                visitor(frame, *path, rest.front().second);
                rest = rest.subspan(1);
            }
            each = rest.empty() ? alive.erase(each) : std::next(each);
        }
    }
}

namespace {

void visitPaths(const std::vector<TrackPath>& paths, const StateVisitor& visitor) {
    visitByFrame(paths, [&](FrameIndex frame, const TrackPath& path, const PathState& found) {
        TrackState state;
        state.id = path.id;
        state.box = found.box;
        state.velocity = found.velocity;
        state.status = found.status;
        state.origin = found.origin;
        state.age = frame - path.firstFrame();
        state.hits = found.hits;
        state.score = found.score;
        visitor(frame, state);
    });
}

void confirm(std::vector<TrackPath>& paths) {
    for (TrackPath& path : paths) {
        for (auto& [frame, state] : path.states) {
            if (state.status == TrackStatus::tentative) state.status = TrackStatus::confirmed;
        }
    }
}

}  // namespace

void FinishedTracks::visit(const StateVisitor& visitor) const {
    visitPaths(paths, visitor);
}

void FinishedTracks::visitDoubtful(const StateVisitor& visitor) const {
    visitPaths(doubtful, visitor);
}

void FinishedTracks::visitDropped(const StatesOfRun& states, const DropVisitor& visitor) const {
    states([&](FrameIndex frame, const TrackState& state) {
        if (unconfirmed.contains(state.id) && usableForFinishing(state))
            visitor(frame, {state.id, state.box, TrackDrop::unconfirmed, 0});
    });
    for (const auto& [path, why, beside] : dropped) {
        for (const auto& [frame, state] : path.states) visitor(frame, {path.id, state.box, why, beside});
    }
}

FinishedTracks finishRun(const StatesOfRun& states, const GroundMotion& ground, const FinishingOptions& options,
                         const SceneScale& first_scale, const FoundInFrames& found) {
    const SceneScale scale = ground.zooming(first_scale);
    FinishedTracks finished;
    DropList& drops = finished.dropped;
    std::vector<TrackPath>& paths = finished.paths;
    paths = groupedById(states, finished.unconfirmed);
    for (TrackPath& path : paths) {
        if (!options.keep_tentative) {
            std::erase_if(path.states,
                          [](const TimedPathState& s) { return s.second.status == TrackStatus::tentative; });
        }
        if (options.trim_predicted)
            trimPredictedEnd(path, ground, scaleOf(path, scale).pxPerFrame(options.stop_speed_m_s));
    }
    std::erase_if(paths, [](const TrackPath& path) { return path.states.empty(); });
    dropGraphics(paths, found.graphics, drops);
    paths = joinFragments(std::move(paths), ground, options, scale);
    const bool join_parts = options.join_parts && hasMetricLimits(scale);
    if (join_parts) joinParts(paths, scale, PartsOfVehicle::in_line);
    dropTooSmall(paths, options, scale, drops);
    dropSharers(paths, options.max_sharing, scale, drops);
    for (TrackPath& path : paths) {
        if (options.constant_size) steadySize(path, ground, framesOf(options.size_window_s / 2, scale));
        if (options.smooth_path) smoothPath(path, ground, std::max(2, framesOf(options.smooth_window_s / 2, scale)));
    }
    if (options.drop_shadows) dropShadows(paths, scale, drops);
    traceBack(paths, ground, found.vectors_at, framesOf(options.trace_back_s, scale));
    dropHardlyDetected(paths, options.min_detected, scale, drops);
    if (join_parts) joinParts(paths, scale, PartsOfVehicle::overlapping);
    dropWiderThanLong(paths, options.max_aspect, drops);  // parts of lorries are joined by now
    // Without a classifier nothing is known of looks, and nothing is judged by them.
    const bool judged = static_cast<bool>(found.classified_at);
    const VehicleLooks looks = judged ? looksOf(paths, found.classified_at) : VehicleLooks{};
    if (judged) dropStanding(paths, ground, looks, options, drops);
    extendToRest(paths, ground, framesOf(options.from_rest_s, scale), scale);
    extendBack(paths, ground, options.extend_back, framesOf(options.extend_entry_s, scale));
    if (judged) scoreTracks(paths, ground, looks, options.min_score, scale, finished);
    if (judged)
        finishByPictures(finished, ground, options, scale, found.gray_at);
    else
        finished.light = untoldLight(paths, LightOutcome::no_classifier);
    confirm(paths);
    confirm(finished.doubtful);
    return finished;
}

std::vector<TimedState> finishTracks(const std::vector<TimedState>& states,
                                     const std::vector<FrameMotionSummary>& motion, const FinishingOptions& options,
                                     const SceneScale& scale, const FoundInFrames& found,
                                     std::vector<TimedDrop>* dropped) {
    const StatesOfRun all = [&](const StateVisitor& visitor) {
        for (const auto& [frame, state] : states) visitor(frame, state);
    };
    GroundMotion ground(motion);
    ground.seenAt(scale.slope);
    const FinishedTracks finished = finishRun(all, ground, options, scale, found);
    if (dropped != nullptr) {
        finished.visitDropped(
            all, [&](FrameIndex frame, const DroppedState& state) { dropped->emplace_back(frame, state); });
    }
    std::vector<TimedState> result;
    finished.visit([&](FrameIndex frame, const TrackState& state) { result.emplace_back(frame, state); });
    return result;
}

}  // namespace eyrie
