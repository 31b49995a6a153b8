#pragma once

#include "tracking/finishing/track_finishing.h"
#include "tracking/ground_motion.h"

namespace eyrie {

/// What finishing takes from the pictures of a run, once its tracks and their scores are known: sure tracks are
/// followed on where they begin or end in mid-picture and joined where they meet; tracks of mere shadows are dropped,
/// boxes that hold a part of a lorry reach all of it, and shadows, or what headlights light ahead at night, are taken
/// out of those of the others. Reads each picture that is needed once, in ascending order. What is told of light and
/// shadow goes to `finished.light`; nothing else happens without pictures.
void finishByPictures(FinishedTracks& finished, const GroundMotion& ground, const FinishingOptions& options,
                      const SceneScale& scale, const GrayOfFrame& gray_at);

}  // namespace eyrie
