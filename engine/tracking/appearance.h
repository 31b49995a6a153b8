#pragma once

#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/geometry/oriented_box.h"
#include "core/values/ids.h"

namespace eyrie {

/// What tracked objects looked like when they were last detected, to find them again where motion says nothing: at
/// vehicles that stopped (Teutsch §8.2 names it as missing). Templates are upright grey chips of the object alone.
class AppearanceMemory {
 public:
    /// Normalised correlation from which an object is taken for found, 0 … 1.
    explicit AppearanceMemory(double agreement) : agreement_(agreement) {}

    /// Remembers the object as it looks in `box`. Boxes that leave the image are not remembered. `gray`: CV_8UC1.
    void remember(TrackId track, const cv::Mat& gray, const OrientedBox& box);
    /// Where the object is now, at most `reach` px from `expected` along each of its axes; size and heading are those
    /// of `expected`. Nothing when it is not remembered, not there, or has no contrast.
    std::optional<OrientedBox> find(TrackId track, const cv::Mat& gray, const OrientedBox& expected,
                                    double reach) const;
    void forget(TrackId track) { templates_.erase(track); }
    void clear() { templates_.clear(); }

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    struct Template {
        cv::Mat chip;  ///< CV_8UC1, length × width at one chip pixel per image pixel
        OrientedBox box;

        template <class Archive>
        void transfer(Archive& archive);
    };

    double agreement_;
    std::map<TrackId, Template> templates_;
};

}  // namespace eyrie
