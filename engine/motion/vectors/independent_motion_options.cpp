#include "motion/vectors/independent_motion_options.h"

#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

constexpr double kUsualRate_hz = 10;  ///< the counts of frames are meant for this rate and more

}  // namespace

IndependentMotionOptions IndependentMotionOptions::atRate(double frame_rate_hz) const {
    IndependentMotionOptions here = *this;
    if (!follow_rate || !(frame_rate_hz < kUsualRate_hz)) return here;
    const auto fewer = [&](int frames, int least) {
        const int by_time = static_cast<int>(std::lround(frames * frame_rate_hz / kUsualRate_hz));
        return std::max(by_time, std::min(frames, least));
    };
    here.min_age = fewer(min_age, 2);
    here.baseline = fewer(baseline, 3);
    return here;
}

IndependentMotionOptions IndependentMotionOptions::thesis() {
    IndependentMotionOptions options;
    options.min_age = 5;
    options.baseline = 5;
    options.follow_rate = false;
    options.follow_turns = false;
    options.find_slow = false;
    options.min_speed_px = 0;  // one threshold
    options.sigma_factor = 0;
    options.noise_cell = 0;
    options.max_speed_m_s = 0;
    options.shadow.shadow_test = false;
    options.silhouettes.silhouettes = false;
    options.areas.areas = false;
    options.parallax.parallax_test = false;
    options.local_background.local_background = false;
    return options;
}

void IndependentMotionOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::motion);
    declare.integer("motion.min_age", min_age, 1, 30,
                    {"frames",
                     "A corner counts once it has been tracked this long. Larger: fewer false vectors, later "
                     "detections.",
                     "Teutsch §4.2"});
    declare.integer("motion.baseline", baseline, 1, 60,
                    {"frames",
                     "The velocity is the displacement over this many frames, end points only, as far as the "
                     "corner is that old. Larger: less noise, but turning vehicles lag.",
                     ""});
    declare.real("motion.min_speed", min_speed_m_s, 0, 50,
                 {"m/s", "Corners that move slower belong to the background.", "Teutsch §4.2"});
    declare.real("motion.min_speed_px", min_speed_px, 0, 10,
                 {"px/frame", "Lowest speed threshold, whatever the ground sampling distance.", ""});
    declare.real("motion.sigma_factor", sigma_factor, 0, 20,
                 {"",
                  "The speed must also exceed this many deviations of the background's residual speed, measured in "
                  "every frame. 0 switches it off.",
                  ""});
    declare.real(
        "motion.noise_cell", noise_cell, 0, 1,
        {"widths",
         "The background's residual speed is also measured in cells of this side, a share of the picture's "
         "width: where the ground is stiller than elsewhere, slower vehicles are found. 0: the same everywhere.",
         ""});
    declare.real("motion.max_speed", max_speed_m_s, 0, 500,
                 {"m/s",
                  "Faster corners are tracking errors. Used where the ground sampling distance is known; 0: no "
                  "limit.",
                  ""});
    declare.flag(
        "motion.follow_rate", follow_rate,
        {"",
         "min_age and baseline are meant for 10 frames per second and more. Where there are fewer, both are as "
         "much shorter: what matters is the time that a vehicle is seen.",
         ""});
    declare.flag("motion.follow_turns", follow_turns,
                 {"",
                  "A velocity over the baseline lags by half of it. Where the path clearly bends, extrapolate the "
                  "velocity to the present.",
                  ""});
    declare.flag("motion.find_slow", find_slow,
                 {"", "Test corners that seem to stand still again over a longer baseline.", ""});
    declare.integer("motion.slow_baseline", slow_baseline, 2, 60,
                    {"frames", "Displacement of slow corners is measured over this many frames.", ""});
    declare.integer("motion.slow_min_age", slow_min_age, 2, 60,
                    {"frames", "A corner must have been tracked this long for the slow test.", ""});
    declare.real("motion.slow_min_speed", slow_min_speed_m_s, 0, 50, {"m/s", "Lowest speed in the slow test.", ""});
    shadow.describe(visitor);
    silhouettes.describe(visitor);
    areas.describe(visitor);
    local_background.describe(visitor);
    parallax.describe(visitor);
}

}  // namespace eyrie
