#pragma once

#include "registration/pictures/padded_picture.h"

namespace eyrie {

/// How far two pictures of one size differ, in grey levels.
struct PictureDifference {
    double mean = 0;        ///< mean absolute difference
    double worst_tile = 0;  ///< the largest mean absolute difference of any 16×16 tile
};

/// Of two pictures of one size.
PictureDifference difference(const PaddedPicture& a, const PaddedPicture& b);

/// Tells a repeated picture from a camera that stands still: noise changes between real exposures, and a repeated
/// picture differs from its predecessor far less than pictures of this video usually do.
class RepetitionDetector {
 public:
    /// Whether the newer picture repeats the older one. Learns the video's usual difference from those that do not.
    bool repeats(const PictureDifference& difference);
    void reset() { usual_mean_ = -1; }

    /// What it remembers, written or read; see core/state_archive.h.
    template <class Archive>
    void transfer(Archive& archive) {
        archive(usual_mean_);
    }

 private:
    double usual_mean_ = -1;
};

}  // namespace eyrie
