#include "chain/live/chain_pace.h"

namespace eyrie {
namespace {

constexpr double kBehind = 0.5;      ///< share of the waiting frames from which the chain is made lighter
constexpr double kInPace = 0.1;      ///< and below which it keeps pace again …
constexpr double kPaceBefore_s = 2;  ///< … for so long, before it is the whole chain again

}  // namespace

bool ChainPace::isLighter(double backlog) {
    if (backlog > kBehind) lighter_ = true;
    if (backlog > kInPace) frames_in_pace_ = 0;
    if (lighter_ && ++frames_in_pace_ > kPaceBefore_s * patience_ * frame_rate_hz_) {
        lighter_ = false;
        patience_ *= 2;
    }
    return lighter_;
}

}  // namespace eyrie
