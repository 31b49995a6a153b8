#pragma once

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "tracking/finishing/track_paths.h"
#include "tracking/ground_motion.h"

namespace eyrie {

/// Calls `visit(frame, a, b)` with where both are and how they move, for every frame that both tracks have, in order.
template <typename Visit>
void forSharedFrames(const TrackPath& a, const TrackPath& b, Visit visit) {
    auto at_a = a.states.begin();
    auto at_b = b.states.begin();
    while (at_a != a.states.end() && at_b != b.states.end()) {
        if (at_a->first < at_b->first) {
            ++at_a;
        } else if (at_b->first < at_a->first) {
            ++at_b;
        } else {
            visit(at_a->first, movingOf(at_a->second), movingOf(at_b->second));
            ++at_a;
            ++at_b;
        }
    }
}

/// Which of many tracks live at one time with another. An hour has hundreds of thousands, most of which never meet.
class LivingTracks {
 public:
    LivingTracks() = default;
    /// All of them, by their place; none without states.
    explicit LivingTracks(const std::vector<TrackPath>& paths) {
        for (std::size_t i = 0; i < paths.size(); ++i) add(i, paths[i].firstFrame(), paths[i].lastFrame());
    }
    /// `track`: the number by which it is told again; `first` … `last`: its frames, both included.
    void add(std::size_t track, FrameIndex first, FrameIndex last) {
        for (FrameIndex span = first / kSpan; span <= last / kSpan; ++span)
            spans_[span].push_back({track, first, last});
    }
    /// Those that live in one of these frames, by ascending number.
    std::vector<std::size_t> during(FrameIndex first, FrameIndex last) const {
        std::vector<std::size_t> found;
        for (FrameIndex span = first / kSpan; span <= last / kSpan; ++span) {
            const auto there = spans_.find(span);
            if (there == spans_.end()) continue;
            for (const Life& life : there->second) {
                // Told once, in the first span that both have.
                const bool meets = life.first <= last && life.last >= first;
                if (meets && std::max(life.first, first) / kSpan == span) found.push_back(life.track);
            }
        }
        std::sort(found.begin(), found.end());
        return found;
    }

 private:
    static constexpr FrameIndex kSpan = 64;  ///< frames
    struct Life {
        std::size_t track = 0;
        FrameIndex first = 0, last = 0;
    };
    std::unordered_map<FrameIndex, std::vector<Life>> spans_;
};

}  // namespace eyrie
