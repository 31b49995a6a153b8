#pragma once

#include <array>
#include <map>
#include <vector>

#include "core/values/frame.h"
#include "events/event.h"

namespace eyrie {

/// What a vehicle looks like from above, turned so that it points up and scaled to one size. Its size itself, and the
/// light of the day, are no part of it.
struct TrackLook {
    static constexpr int kBins = 8;

    /// Histograms of lightness against the ground around the box, and of the two colour axes of CIELAB; each sums up
    /// to 1. Where the pictures are grey the two say nothing.
    std::array<std::array<double, kBins>, 3> colours{};
    std::vector<float> gradients;  ///< histograms of oriented gradients, of length 1
};
using LooksByTrack = std::map<TrackId, TrackLook>;

/// 0 … 1, 1: the same: √(exp(−4 Σ (1 − b)) · exp(−½ ((1 − cos φ) / .3)²)); b: Bhattacharyya coefficient of each
/// histogram of colours, φ: angle between the gradients.
double lookLikeness(const TrackLook& a, const TrackLook& b);

/// Looks at the tracks of a run in a few frames of each, which tracks share where they can.
class LookTaker {
 public:
    explicit LookTaker(const std::vector<EventTrack>& tracks);

    /// The frames to look at, ascending.
    std::vector<FrameIndex> frames() const;
    /// Takes what a frame shows; without colours its greys. Frames that were not asked for say nothing.
    void look(const Frame& frame);
    /// What was seen so far; nothing of tracks that no frame showed.
    LooksByTrack looks() const;

 private:
    struct Glance {
        TrackId track = 0;
        OrientedBox box;
    };
    void glanceAt(const Frame& frame, const Glance& glance);

    std::map<FrameIndex, std::vector<Glance>> glances_;
    LooksByTrack sums_;
};

}  // namespace eyrie
