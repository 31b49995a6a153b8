#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <set>

#include "tracking/finishing/track_occupancy.h"
#include "tracking/finishing/track_paths.h"
#include "tracking/pictures/end_follower.h"
#include "tracking/pictures/held_pictures.h"

namespace eyrie {
namespace {

constexpr int kSurelyDetected = 6;      ///< states in which a track was detected, at least, that is followed on
constexpr double kSlowestFollowed = 1;  ///< m/s at the end it is followed on from; what stands is known otherwise
constexpr std::size_t kLastStates = 5;  ///< of an end, in which it was seen without a gap
constexpr int kMostGuessed = 8;         ///< frames of a guessed beginning; longer ones tell where it stood

bool wasSeen(const TimedPathState& state) {
    return state.second.origin == StateOrigin::detected || state.second.origin == StateOrigin::reconstructed;
}

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
        return path.states.back().second.score >= kSurelyVehicle &&
               path.statesOf(StateOrigin::detected) >= kSurelyDetected;
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
        return std::hypot(velocity.x, velocity.y) >=
               scale_.at(state.first, state.second.box.centre).pxPerFrame(kSlowestFollowed);
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
