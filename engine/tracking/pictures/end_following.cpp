#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <set>

#include "imaging/following/box_follower.h"
#include "tracking/finishing/track_occupancy.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

constexpr double kSureTrack = 0.8;          ///< score from which a track is surely a vehicle …
constexpr int kSurelyDetected = 6;          ///< … and states in which it was detected, at least
constexpr double kSureLooks = 0.78;         ///< certainty below which the pictures do not surely show it any more
constexpr double kFairLooks = 0.55;         ///< that will do where many corners agree
constexpr double kNearBy = 32;              ///< px, root of the area: so large a vehicle carries many corners …
constexpr int kManyCorners = 12;            ///< … which are so many
constexpr double kSurelyMoves = 1.5;        ///< px/frame over the ground
constexpr double kFollowedInImage = 0.9;    ///< share of the box that must lie in the image
constexpr double kSlowestFollowed = 1;      ///< m/s at the end it is followed on from; what stands is known otherwise
constexpr double kHardestBraking = 10;      ///< m/s²; a box that slides off onto the ground brakes harder
constexpr double kBrakingSeconds = 0.4;     ///< over which that is measured …
constexpr double kBrakingFewestFrames = 3;  ///< … and frames, at least
constexpr double kUsualSeconds = 0.28;      ///< in which a vehicle's motion changes little
constexpr double kStandingPerSecond = 10;   ///< px; up to that it waits
constexpr double kBend = 0.5;               ///< cosine of the turn in that time up to which it is a bend
constexpr double kPlaceError = 1;           ///< px by which both ends of that may be off
constexpr double kJumpShare = 0.25;     ///< of a vehicle's size by which its speed may change in 0.04 s, or in a frame
constexpr std::size_t kLastStates = 5;  ///< of an end, in which it was seen without a gap
constexpr int kMostGuessed = 8;         ///< frames of a guessed beginning; longer ones tell where it stood
constexpr std::size_t kMostHeldBytes = 200'000'000;  ///< of pictures, for those who are followed back

bool wasSeen(const TimedPathState& state) {
    return state.second.origin == StateOrigin::detected || state.second.origin == StateOrigin::reconstructed;
}

FollowOptions followOptions(double frame_rate_hz) {
    FollowOptions options;
    options.usual_share = std::min(1 / (kUsualSeconds * frame_rate_hz), 0.5);
    options.max_standing_px = std::min(options.max_standing_px, kStandingPerSecond / frame_rate_hz);
    options.corners_to_grow = kManyCorners;
    options.size_to_grow_px = kNearBy;
    options.max_speed_change_share = kJumpShare * std::clamp(1 / (0.04 * frame_rate_hz), 1.0, 2.0);
    return options;
}

/// The grey pictures read last, neighbours in order.
class HeldPictures {
 public:
    /// `frames`: as many as may be needed at once.
    HeldPictures(const GrayOfFrame& source, std::size_t frames) : source_(source), frames_(frames) {}

    void read(FrameIndex frame) {
        if (!pictures_.empty() && last_ + 1 != frame) pictures_.clear();
        last_ = frame;
        pictures_.push_back(source_(frame));
        while (pictures_.size() > mostOf(pictures_.back().size())) pictures_.pop_front();
    }
    /// As many of that size as are held.
    std::size_t mostOf(cv::Size size) const {
        const auto bytes = std::max<std::size_t>(1, static_cast<std::size_t>(size.area()));
        return std::max<std::size_t>(2, std::min(frames_, kMostHeldBytes / bytes));
    }
    /// Null where it is not held or could not be read.
    const cv::Mat* at(FrameIndex frame) const {
        const FrameIndex back = last_ - frame;
        if (back < 0 || static_cast<std::size_t>(back) >= pictures_.size()) return nullptr;
        const cv::Mat& picture = pictures_[pictures_.size() - 1 - static_cast<std::size_t>(back)];
        return picture.empty() || picture.type() != CV_8UC1 ? nullptr : &picture;
    }

 private:
    const GrayOfFrame& source_;
    std::size_t frames_;
    FrameIndex last_ = -1;
    std::deque<cv::Mat> pictures_;  ///< up to the last
};

/// Follows one track on, frame by frame, from one of its states.
class EndFollower {
 public:
    /// `way`: 1 or −1, towards later or earlier frames.
    EndFollower(const TimedPathState& from, int way, const cv::Mat& gray, const SceneScale& scale)
        : way_(way),
          state_(from.second),
          frame_(from.first),
          follower_(from.second.box, gray, followOptions(scale.frame_rate_hz)) {
        const cv::Point2d velocity = cv::Point2d(from.second.velocity) * way;
        follower_.startsWith(velocity);
        const SceneScale here = scale.at(from.second.box.centre);
        const double frames = std::max(kBrakingFewestFrames, std::round(kBrakingSeconds * here.frame_rate_hz));
        allowed_change_ = here.pxPerFrame(kHardestBraking) / here.frame_rate_hz * frames + kPlaceError / frames;
        window_ = static_cast<std::size_t>(frames);
        steps_.assign(window_, velocity);
    }

    /// Its state in the next frame; nothing where the pictures do not surely show it there.
    std::optional<TimedPathState> next(const HeldPictures& pictures, const GroundMotion& ground,
                                       const TrackOccupancy& taken) {
        const FrameIndex to = frame_ + way_;
        const cv::Matx33d* step = ground.step(frame_, to, false);
        const cv::Mat* current = pictures.at(frame_);
        const cv::Mat* picture = pictures.at(to);
        if (!step || !current || !picture || current->size() != picture->size()) return std::nullopt;
        Homography map;
        map.matrix = *step;
        if (!ground.frozen(frame_, to)) {
            const BoxFollower::Step moved = follower_.advance(*current, *picture, map);
            const bool drives = drivesBySight(moved, map);
            if (moved.end || moved.certainty < (drives ? kFairLooks : kSureLooks)) return std::nullopt;
            braked_ = brakesTooHard(moved.box, map) && !drives;
            if (braked_) return std::nullopt;
            state_.box = moved.box;
            state_.velocity = follower_.usualVelocity() * way_;
        }
        if (areaInImage(state_.box, picture->size()) < kFollowedInImage * state_.box.area()) return std::nullopt;
        met_ = !taken.isFree(to, state_.box);
        if (met_) return std::nullopt;
        state_.origin = StateOrigin::reconstructed;
        if (way_ < 0) state_.hits = 0;
        frame_ = to;
        return TimedPathState{to, state_};
    }

    /// Whether it ended since there is another track where it would go on.
    bool met() const { return met_; }
    /// How many of the states found last are not to be trusted now that it has ended.
    std::size_t doubtful() const { return braked_ ? window_ - 1 : 0; }

 private:
    /// Many corners that move together over the ground are the vehicle's, however its looks and its way change on a
    /// bend or near by; what has slid off onto the ground moves with it.
    bool drivesBySight(const BoxFollower::Step& moved, const Homography& map) const {
        const cv::Point2d before = map.applyToVector(state_.box.centre, cv::Point2d(state_.velocity) * way_);
        const cv::Point2d way = moved.box.centre - map.apply(state_.box.centre);
        return moved.by_corners &&
               std::hypot(way.x, way.y) >= std::max(kSurelyMoves, 0.5 * std::hypot(before.x, before.y));
    }

    /// A box that lost its vehicle sticks to the ground, or is taken along by another.
    bool brakesTooHard(const OrientedBox& box, const Homography& map) {
        const cv::Point2d before = state_.box.centre;
        for (cv::Point2d& step : steps_) step = map.applyToVector(before, step);
        allowed_change_ *= map.scaleAt(before);
        steps_.push_back(box.centre - map.apply(before));
        if (steps_.size() > 2 * window_) steps_.pop_front();
        return changeBetween(meanStep(0, window_), meanStep(steps_.size() - window_, steps_.size())) > allowed_change_;
    }

    /// On a bend a vehicle keeps its speed.
    static double changeBetween(cv::Point2d before, cv::Point2d after) {
        const double speed = std::hypot(before.x, before.y);
        const double new_speed = std::hypot(after.x, after.y);
        if (before.dot(after) >= kBend * speed * new_speed) return std::abs(new_speed - speed);
        return std::hypot(after.x - before.x, after.y - before.y);
    }

    cv::Point2d meanStep(std::size_t begin, std::size_t end) const {
        cv::Point2d sum(0, 0);
        for (std::size_t i = begin; i < end; ++i) sum += steps_[i];
        return sum * (1.0 / static_cast<double>(end - begin));
    }

    int way_;
    PathState state_;
    FrameIndex frame_;
    BoxFollower follower_;
    std::deque<cv::Point2d> steps_;  ///< px over the ground in the picture reached, of twice the window at most
    std::size_t window_ = 0;         ///< frames
    double allowed_change_ = 0;      ///< px/frame
    bool braked_ = false;
    bool met_ = false;
};

/// Goes through the run once, in the order of its frames: those who end are followed on as the pictures come, those who
/// begin are followed back through the pictures held.
class EndFollowing {
 public:
    EndFollowing(std::vector<TrackPath>& paths, const GroundMotion& ground, const GrayOfFrame& gray_at, int frames,
                 const SceneScale& scale)
        : paths_(paths),
          ground_(ground),
          scale_(scale),
          frames_(frames),
          taken_(paths),
          pictures_(gray_at, static_cast<std::size_t>(frames) + 1) {
        for (std::size_t i = 0; i < paths.size(); ++i) {
            if (!isSure(paths[i])) continue;
            const auto& states = paths[i].states;
            const auto seen = std::find_if(states.begin(), states.end(), wasSeen);
            if (seen - states.begin() <= kMostGuessed && inMidPicture(states.front()) && inMidPicture(*seen) &&
                moves(*seen)) {
                begins_[seen->first].push_back(i);
            }
            if (seenToTheEnd(paths[i]) && inMidPicture(states.back()) && moves(states.back()))
                ends_[states.back().first].push_back(i);
        }
    }

    FollowedEnds run() {
        for (const auto& [frame, tracks] : begins_) {
            const FrameIndex held = static_cast<FrameIndex>(pictures_.mostOf(ground_.imageSize(frame))) - 1;
            for (FrameIndex each = std::max(0, frame - held); each <= frame; ++each) want(each);
        }
        for (const auto& [frame, tracks] : ends_) wanted_.insert(frame);
        while (!wanted_.empty()) {
            const FrameIndex frame = *wanted_.begin();
            wanted_.erase(wanted_.begin());
            pictures_.read(frame);
            goOn(frame);
            if (const auto here = begins_.find(frame); here != begins_.end()) followBack(here->second, frame);
            if (const auto here = ends_.find(frame); here != ends_.end()) {
                for (const std::size_t i : here->second) begin(i, frame);
            }
        }
        for (const auto& [track, active] : active_) {
            if (paths_[track].lastFrame() > active.start) followed_.ends.insert(paths_[track].id);
        }
        return std::move(followed_);
    }

 private:
    struct Active {
        FrameIndex start = 0;
        EndFollower follower;
    };

    bool isSure(const TrackPath& path) const {
        return path.states.back().second.score >= kSureTrack && path.statesOf(StateOrigin::detected) >= kSurelyDetected;
    }
    /// What was seen once after it was lost may be another.
    static bool seenToTheEnd(const TrackPath& path) {
        const auto& states = path.states;
        const auto last = static_cast<std::ptrdiff_t>(std::min(kLastStates, states.size()));
        return std::all_of(states.end() - last, states.end(), wasSeen);
    }
    bool inMidPicture(const TimedPathState& state) const { return !ground_.cutByBorder(state.second.box, state.first); }
    bool moves(const TimedPathState& state) const {
        const cv::Point2d velocity = state.second.velocity;
        return std::hypot(velocity.x, velocity.y) >= scale_.at(state.second.box.centre).pxPerFrame(kSlowestFollowed);
    }

    void begin(std::size_t track, FrameIndex frame) {
        const cv::Mat* picture = pictures_.at(frame);
        if (!picture) return;
        active_.emplace(track, Active{frame, EndFollower(paths_[track].states.back(), 1, *picture, scale_)});
        want(frame + 1);
    }

    void goOn(FrameIndex frame) {
        for (auto each = active_.begin(); each != active_.end();) {
            auto& [start, follower] = each->second;
            TrackPath& path = paths_[each->first];
            const auto state = frame - start > frames_ ? std::nullopt : follower.next(pictures_, ground_, taken_);
            if (state) {
                path.states.push_back(*state);
                taken_.reaches(path, frame);
                want(frame + 1);
                ++each;
                continue;
            }
            const auto gained = static_cast<std::size_t>(path.lastFrame() - start);
            path.states.resize(path.states.size() - std::min(gained, follower.doubtful()));
            if (path.lastFrame() > start || follower.met()) followed_.ends.insert(path.id);
            each = active_.erase(each);
        }
    }

    /// What the pictures show of a track before it begins.
    struct Before {
        std::vector<TimedPathState> guessed;  ///< of the track so far, the first one first
        std::vector<TimedPathState> found;    ///< the last one first
        bool met = false;
    };

    /// Follows back those who begin in a frame: each by itself, then they make room for each other in their order.
    void followBack(const std::vector<std::size_t>& tracks, FrameIndex frame) {
        const cv::Mat* picture = pictures_.at(frame);
        if (!picture) return;
        std::vector<Before> before(tracks.size());
        for (std::size_t k = 0; k < tracks.size(); ++k) {
            std::vector<TimedPathState>& states = paths_[tracks[k]].states;
            const auto seen = std::find_if(states.begin(), states.end(), wasSeen);
            before[k].guessed.assign(states.begin(), seen);
            states.erase(states.begin(), seen);
        }
        // Written by index, so that the result does not depend on the number of threads.
        const int count = static_cast<int>(tracks.size());
        cv::parallel_for_(
            cv::Range(0, count),
            [&](const cv::Range& part) {
                for (int k = part.start; k < part.end; ++k) {
                    const auto index = static_cast<std::size_t>(k);
                    look(paths_[tracks[index]], *picture, before[index]);
                }
            },
            count);
        for (std::size_t k = 0; k < tracks.size(); ++k) goBack(paths_[tracks[k]], before[k]);
    }

    void look(const TrackPath& path, const cv::Mat& picture, Before& before) const {
        EndFollower follower(path.states.front(), -1, picture, scale_);
        while (static_cast<int>(before.found.size()) < frames_) {
            const auto state = follower.next(pictures_, ground_, taken_);
            if (!state) break;
            before.found.push_back(*state);
        }
        before.found.resize(before.found.size() - std::min(before.found.size(), follower.doubtful()));
        before.met = follower.met();
    }

    void goBack(TrackPath& path, Before& before) {
        const auto met = std::find_if(before.found.begin(), before.found.end(), [&](const TimedPathState& state) {
            return !taken_.isFree(state.first, state.second.box);
        });
        before.met = before.met || met != before.found.end();
        before.found.erase(met, before.found.end());
        if (!before.found.empty() || before.met) followed_.begins.insert(path.id);
        // What was guessed stays where the pictures tell nothing.
        const std::vector<TimedPathState>& guessed = before.guessed;
        for (std::size_t i = before.found.size(); i < guessed.size(); ++i)
            before.found.push_back(guessed[guessed.size() - 1 - i]);
        prepend(path, before.found);
        taken_.extended(path);
    }

    void want(FrameIndex frame) {
        if (ground_.imageSize(frame).area() > 0) wanted_.insert(frame);
    }

    std::vector<TrackPath>& paths_;
    const GroundMotion& ground_;
    const SceneScale& scale_;
    int frames_;
    TrackOccupancy taken_;
    HeldPictures pictures_;
    std::map<FrameIndex, std::vector<std::size_t>> begins_, ends_;  ///< tracks by the frame they are followed from
    std::map<std::size_t, Active> active_;                          ///< tracks that are followed on
    std::set<FrameIndex> wanted_;                                   ///< frames still to be read
    FollowedEnds followed_;
};

}  // namespace

FollowedEnds followEnds(std::vector<TrackPath>& paths, const GroundMotion& ground, const GrayOfFrame& gray_at,
                        int frames, const SceneScale& scale) {
    if (frames < 1 || !gray_at) return {};
    return EndFollowing(paths, ground, gray_at, frames, scale).run();
}

}  // namespace eyrie
