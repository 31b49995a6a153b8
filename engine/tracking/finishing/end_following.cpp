#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>
#include <optional>

#include "imaging/following/box_follower.h"
#include "tracking/finishing/track_occupancy.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

double fromEnvironment(const char* name, double otherwise) {
    const char* text = std::getenv(name);
    return text ? std::atof(text) : otherwise;
}
const double kSureScore = fromEnvironment("E_SCORE", 0.5);
const double kLeastCertainty = fromEnvironment("E_CERT", 0.7);
const double kFollowedInImage = 0.9;
const double kLeastSpeedShare = fromEnvironment("E_SPEED", 0.4);
const double kFewestDetected = fromEnvironment("E_HITS", 6);
const double kLeastSide = fromEnvironment("E_SIDE", 0);
const double kHeldBytes = 200e6;

bool isSeen(const TimedPathState& state) {
    return state.second.origin == StateOrigin::detected || state.second.origin == StateOrigin::reconstructed;
}

class Following {
 public:
    Following(const TimedPathState& from, const cv::Mat& gray)
        : state_(from.second),
          frame_(from.first),
          follower_(from.second.box, gray),
          least_speed_(kLeastSpeedShare * std::hypot(from.second.velocity.x, from.second.velocity.y)) {}

    std::optional<TimedPathState> next(const cv::Mat& current, const cv::Mat& picture, FrameIndex to,
                                       const GroundMotion& ground, const TrackOccupancy& taken) {
        const cv::Matx33d* step = ground.step(frame_, to, false);
        if (!step || current.empty() || picture.empty() || current.size() != picture.size()) return why("map");
        Homography map;
        map.matrix = *step;
        const auto moved = follower_.advance(current, picture, map);
        if (moved.end || moved.hidden) return why("end", moved.end ? static_cast<int>(*moved.end) : -1);
        if (moved.certainty < kLeastCertainty) return why("certainty", moved.certainty);
        if (areaInImage(moved.box, picture.size()) < kFollowedInImage * moved.box.area()) return why("border");
        if (!taken.isFree(to, moved.box)) return why("taken");
        const cv::Point2d velocity = follower_.usualVelocity() * (to > frame_ ? 1.0 : -1.0);
        if (std::hypot(velocity.x, velocity.y) < least_speed_) return why("slow");
        state_.box = moved.box;
        state_.velocity = velocity;
        state_.origin = StateOrigin::reconstructed;
        state_.hits = to > frame_ ? state_.hits : 0;
        frame_ = to;
        return TimedPathState{to, state_};
    }
    const char* reason = "length";
    double value = 0;

 private:
    std::optional<TimedPathState> why(const char* text, double v = 0) {
        reason = text;
        value = v;
        return std::nullopt;
    }
    PathState state_;
    FrameIndex frame_;
    BoxFollower follower_;
    double least_speed_;
};

class EndFollowing {
 public:
    EndFollowing(std::vector<TrackPath>& paths, const GroundMotion& ground, const GrayOfFrame& gray, int frames)
        : paths_(paths), ground_(ground), gray_(gray), frames_(frames), taken_(paths) {
        for (std::size_t i = 0; i < paths.size(); ++i) {
            const TrackPath& path = paths[i];
            if (!sure(path)) continue;
            const auto first = std::find_if(path.states.begin(), path.states.end(), isSeen);
            if (!ground.cutByBorder(first->second.box, first->first)) begins_[first->first].push_back(i);
            const TimedPathState& last = path.states.back();
            if (isSeen(last) && !ground.cutByBorder(last.second.box, last.first)) ends_[last.first].push_back(i);
        }
    }

    int run() {
        std::map<FrameIndex, bool> wanted;  // prototype: all at once
        for (const auto& [frame, tracks] : begins_)
            for (int back = 0; back <= frames_ && back <= frame; ++back) wanted[frame - back] = true;
        for (const auto& [frame, tracks] : ends_) wanted[frame] = true;
        int gained = 0, reads = 0;
        FrameIndex before = -2;
        while (!wanted.empty()) {
            const FrameIndex frame = wanted.begin()->first;
            wanted.erase(wanted.begin());
            if (frame != before + 1) { held_.clear(); active_.clear(); }
            before = frame;
            held_.emplace_back(frame, gray_(frame));
            ++reads;
            const cv::Mat& picture = held_.back().second;
            const std::size_t most = picture.empty() ? 1 : std::max<std::size_t>(2, std::min<std::size_t>(
                static_cast<std::size_t>(frames_) + 1, static_cast<std::size_t>(kHeldBytes / static_cast<double>(picture.total()))));
            while (held_.size() > most) held_.pop_front();
            for (auto each = active_.begin(); each != active_.end();) {
                TrackPath& path = paths_[each->first];
                const auto state = held_.size() < 2 || frame - each->second.start > frames_ ? std::nullopt :
                    each->second.following.next(held_[held_.size() - 2].second, picture, frame, ground_, taken_);
                if (state) {
                    path.states.push_back(*state);
                    taken_.extended(path);
                    ++gained;
                    wanted[frame + 1] = true;
                    ++each;
                } else {
                    std::fprintf(stderr, "track %d fwd %d..%d %s %.2f\n", static_cast<int>(path.id), each->second.start, frame, each->second.following.reason, each->second.following.value);
                    each = active_.erase(each);
                }
            }
            if (const auto here = begins_.find(frame); here != begins_.end())
                for (const std::size_t i : here->second) gained += back(paths_[i], frame);
            if (const auto here = ends_.find(frame); here != ends_.end())
                for (const std::size_t i : here->second) {
                    if (picture.empty()) continue;
                    active_.emplace(i, Active{frame, Following(paths_[i].states.back(), picture)});
                    wanted[frame + 1] = true;
                }
        }
        std::fprintf(stderr, "follow_ends: %d gained, %d reads\n", gained, reads);
        return gained;
    }

 private:
    struct Active {
        FrameIndex start;
        Following following;
    };
    static bool sure(const TrackPath& path) {
        return path.states.back().second.score >= kSureScore && path.statesOf(StateOrigin::detected) >= kFewestDetected &&
            std::min(path.states[path.states.size() / 2].second.box.length, path.states[path.states.size() / 2].second.box.width) >= kLeastSide;
    }
    int back(TrackPath& path, FrameIndex start) {
        const auto first = std::find_if(path.states.begin(), path.states.end(), isSeen);
        if (held_.back().second.empty()) return 0;
        const std::vector<TimedPathState> guessed(path.states.begin(), first);
        path.states.erase(path.states.begin(), first);
        Following following(path.states.front(), held_.back().second);
        std::vector<TimedPathState> found;
        for (std::size_t i = held_.size() - 1; i > 0; --i) {
            const auto state = following.next(held_[i].second, held_[i - 1].second, held_[i - 1].first, ground_, taken_);
            if (!state) break;
            found.push_back(*state);
        }
        const int gained = std::max(0, static_cast<int>(found.size()) - static_cast<int>(guessed.size()));
        for (std::size_t i = found.size(); i < guessed.size(); ++i) found.push_back(guessed[guessed.size() - 1 - i]);
        std::fprintf(stderr, "track %d back %d..%d %s %.2f guessed %zu\n", static_cast<int>(path.id), start, found.empty() ? start : found.back().first, following.reason, following.value, guessed.size());
        prepend(path, found);
        taken_.extended(path);
        return gained;
    }

    std::vector<TrackPath>& paths_;
    const GroundMotion& ground_;
    const GrayOfFrame& gray_;
    int frames_;
    TrackOccupancy taken_;
    std::map<FrameIndex, std::vector<std::size_t>> begins_, ends_;
    std::map<std::size_t, Active> active_;
    std::deque<std::pair<FrameIndex, cv::Mat>> held_;
};

}  // namespace

int followEnds(std::vector<TrackPath>& paths, const GroundMotion& ground, const GrayOfFrame& gray_at, int frames) {
    if (frames < 1 || !gray_at) return 0;
    return EndFollowing(paths, ground, gray_at, frames).run();
}

}  // namespace eyrie
