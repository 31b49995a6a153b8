#include "chain/repeated_pictures.h"

#include "core/measure_text.h"

namespace eyrie {
namespace {

constexpr int kMostInARow = 4;  ///< more are a stall: 60 pictures a second of 12 repeat each four times
constexpr int kFewestFrames = 20;
constexpr double kFewestShare = 0.3;

}  // namespace

void RepeatedPictures::see(RegistrationState state) {
    if (state != RegistrationState::frozen) {
        ++differing_;
        in_a_row_ = 0;
    } else if (++in_a_row_ <= kMostInARow) {
        ++repeats_;
    }
}

std::string RepeatedPictures::text(double frame_rate_hz) const {
    const int frames = differing_ + repeats_;
    if (frames < kFewestFrames || repeats_ < kFewestShare * frames) return {};
    const double differing = differing_;
    return std::to_string(repeats_) + " of " + std::to_string(frames) +
           " pictures repeat the one before, so that speeds are told " + numberText(frames / differing) +
           " times as high as they are; for true ones make the video anew without repeats, with " +
           numberText(frame_rate_hz * differing / frames) + " pictures a second";
}

}  // namespace eyrie
