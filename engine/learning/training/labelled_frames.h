#pragma once

#include <functional>
#include <map>
#include <stop_token>
#include <string>
#include <vector>

#include "core/labels/box_record.h"
#include "learning/training/sample_set.h"

namespace eyrie {

/// A labelled box as training sees it.
struct TrainingBox {
    OrientedBox box;
    bool clear = true;  ///< a vehicle in full view; otherwise nothing is learned from it, nor cut where it lies
};
using TrainingBoxes = std::map<FrameIndex, std::vector<TrainingBox>>;

/// What training makes of a record: clear are vehicles that are not to be ignored. Hidden ones are told by `hidden`.
TrainingBox trainingBoxOf(const BoxRecord& record, bool hidden = false);

/// Frames of one video, as labelled images of one group: labelled ones that lie at least `step` apart, as nobody says
/// of the others that there is nothing; those outside 0 … frame_count − 1 are left out. `gray` reads a frame;
/// `progress`, if given, is told the share done. Ends early when stopped.
std::vector<LabelledImage> labelledImagesOf(const TrainingBoxes& boxes, const std::string& name, int frame_count,
                                            int step, const std::function<cv::Mat(FrameIndex)>& gray,
                                            const std::stop_token& stop,
                                            const std::function<void(double)>& progress = {});

/// Size of what is cut from images without vehicles: nothing is known of their scale but that windows fit.
OrientedBox typicalVehicle();

/// Samples from all images, four others to each vehicle.
SampleSet samplesFromImages(const std::vector<LabelledImage>& images, std::uint64_t seed,
                            const SampleCutting& cutting = {});

}  // namespace eyrie
