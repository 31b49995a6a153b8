#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/geometry/homography.h"
#include "core/geometry/oriented_box.h"
#include "imaging/following/box_flow.h"
#include "imaging/following/box_patch.h"

namespace eyrie {

/// Why following a box ended.
enum class FollowEnd {
    end_of_range,  ///< the frame asked for was reached
    left_image,    ///< less than half of the box is in the image
    few_corners,   ///< hardly any corner of the object could be tracked and the template did not help
    appearance,    ///< it does not look like the object any more
    jump,          ///< it would have moved or turned as no vehicle does
    no_picture,    ///< the frame could not be read
    stopped        ///< by the caller
};

/// When following a box ends because it is no longer sure.
struct FollowOptions {
    double min_certainty = 0.45;
    double min_start_likeness = 0.3;  ///< correlation with how it looked at the start, −1 … 1
    int max_corners = 40;
    double max_forward_backward_px = 0.7;
    double max_speed_change_px = 4;     ///< px/frame, against the speed of the frames before …
    double max_speed_change_share = 0;  ///< … or that share of the box's size (the root of its area) if it is more
    double usual_share = 0.12;          ///< of each step in its usual motion, which does not change at once
    int corners_to_grow = 0;            ///< that must agree for the box to grow and shrink with them; 0: it does not
    double size_to_grow_px = 0;    ///< root of the area from which it does; little ones would only follow the noise
    double max_standing_px = 0.4;  ///< px/frame over the ground: up to that it waits
    double min_seen = 0.5;         ///< share of what waits that must be seen while others pass in front of it …
    int max_hidden_frames = 45;    ///< … but for so long, if it is seen again afterwards
};

/// Follows one box from picture to picture: by corners inside it (tracked there and back) and by how it looked at the
/// start and lately. The caller knows how the ground moved.
class BoxFollower {
 public:
    /// `gray` (CV_8UC1) shows the object in `box`.
    BoxFollower(const OrientedBox& box, const cv::Mat& gray, const FollowOptions& options = {});
    /// Says how it moves against the ground, px per step in that picture; before the first step.
    void startsWith(cv::Point2d velocity);

    struct Step {
        OrientedBox box;
        double certainty = 0;     ///< 0 … 1
        bool by_corners = false;  ///< so many agree that the box grew or shrank with them
        std::optional<FollowEnd> end;
        bool hidden = false;  ///< it ends here, unless what waited is seen again
    };

    /// Follows from `current` to `next`, whose ground `map` joins.
    Step advance(const cv::Mat& current, const cv::Mat& next, const Homography& map);
    /// How it moves against the ground, px per step in the picture reached last: over the last steps, weighted.
    cv::Point2d usualVelocity() const { return usual_velocity_; }

 private:
    /// How much a box looks like it did.
    struct Likeness {
        double start = 0;   ///< with the look at the start
        double recent = 0;  ///< with the look lately
        double score() const { return 0.4 * start + 0.6 * recent; }
    };

    void stay(Step& step, const cv::Mat& next);
    Likeness likenessOf(const cv::Mat& gray, const OrientedBox& box) const;
    OrientedBox bestMatch(const cv::Mat& gray, const BoxFlow& flow, const OrientedBox& predicted) const;
    OrientedBox refined(const cv::Mat& gray, const OrientedBox& from, double reach) const;
    double penalised(const cv::Mat& gray, const OrientedBox& box, const OrientedBox& from) const;
    cv::Point2d movementTo(const OrientedBox& box, const Homography& map) const;
    std::optional<FollowEnd> judged(const Step& step, const BoxFlow& flow, const Likeness& likeness,
                                    const Homography& map) const;
    void accept(const Step& step, const Likeness& likeness, const cv::Mat& next, const Homography& map);

    FollowOptions options_;
    OrientedBox box_;
    OrientedBox sure_box_;  ///< where it was when it last looked like itself, on the ground of the current picture
    OrientedBox home_;      ///< where it was drawn, on the same ground
    bool stood_ = false;    ///< … and whether it waited there
    cv::Size samples_;
    BoxPatch start_;
    BoxPatch recent_;
    cv::Point2d velocity_{0, 0};        ///< px per step against the ground, in the current picture
    cv::Point2d usual_velocity_{0, 0};  ///< the same over the last ten steps or so
    double growth_ = 1;                 ///< per step, beyond that of the ground
    int steps_ = 0;
};

}  // namespace eyrie
