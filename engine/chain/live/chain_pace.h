#pragma once

namespace eyrie {

/// Whether a chain that works as frames come is to be made lighter: while it is behind, and then until it has kept pace
/// for a while, which is twice as long every time.
class ChainPace {
 public:
    explicit ChainPace(double frame_rate_hz) : frame_rate_hz_(frame_rate_hz) {}

    /// Before each frame, whether it is to be worked on by the lighter chain. `backlog`: share of the frames that may
    /// wait which do so, 0 … 1.
    bool isLighter(double backlog);

 private:
    double frame_rate_hz_;
    bool lighter_ = false;
    int frames_in_pace_ = 0;
    double patience_ = 1;
};

}  // namespace eyrie
