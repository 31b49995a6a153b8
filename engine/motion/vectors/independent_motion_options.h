#pragma once

#include "core/parameter.h"
#include "motion/differences/moving_areas.h"
#include "motion/differences/silhouettes.h"
#include "motion/vectors/local_background.h"
#include "motion/vectors/parallax_test.h"
#include "motion/vectors/shadow_test.h"

namespace eyrie {

/// Parameters of independent motion detection (Teutsch §4.2).
struct IndependentMotionOptions {
    int min_age = 5;             ///< frames a corner must have been tracked
    int baseline = 16;           ///< frames over which the velocity is measured, as far as the corner is that old
    double min_speed_m_s = 1.0;  ///< lowest speed of a moving object
    double min_speed_px = 0.05;  ///< px/frame, lowest threshold whatever the scale
    double sigma_factor = 4;     ///< threshold in deviations of the background's residual speed; 0: not used
    double noise_cell = 0.0625;  ///< side of the cells of that residual, share of the picture's width; 0: not by place
    double max_speed_m_s = 70;   ///< faster corners are tracking errors; only where GSD is known; 0: no limit
    bool follow_rate = true;     ///< fewer frames where the video has fewer a second, see atRate()
    bool follow_turns = true;    ///< the velocity of corners whose path bends is carried on to the present
    bool find_slow = false;      ///< second test over a longer baseline
    int slow_baseline = 15;      ///< frames of the second test
    int slow_min_age = 10;       ///< frames a corner must have been tracked for it
    double slow_min_speed_m_s = 0.7;
    ShadowTestOptions shadow;
    SilhouetteOptions silhouettes;
    MovingAreaOptions areas;
    LocalBackgroundOptions local_background;
    ParallaxTestOptions parallax;

    /// The text to the letter: one threshold on the speed of corners at least 5 frames old.
    static IndependentMotionOptions thesis();
    /// What holds for a video: below 10 frames per second `min_age` and `baseline` shrink with the rate, to 2 and 3
    /// frames at the least, where `follow_rate` says so.
    IndependentMotionOptions atRate(double frame_rate_hz) const;
    void describe(ParameterVisitor& visitor);
};

}  // namespace eyrie
