#pragma once

#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "learning/training/sample_set.h"

namespace eyrie::cli {

/// The single folders of a list: an entry may hold several, divided by commas.
std::vector<std::string> sampleFolders(const std::vector<std::string>& lists);

/// Folders of patch sheets, one after the other, cut for `fit`; an entry may list several, divided by commas. Throws
/// Error(input).
SampleSet readSampleFolders(const std::vector<std::string>& folders, const WindowFit& fit);

/// Paints `frames` frames of the built-in kinds of scenes, but of other scenes than those that one evaluates on:
/// `seed` and the frame choose them. All vehicles that are clearly seen are labelled; parked ones, persons and
/// two-wheelers count neither way. Ends early when stopped.
std::vector<LabelledImage> renderLabelledImages(int frames, std::uint64_t seed, bool show_progress,
                                                std::stop_token stop);

/// Frames of a video or image folder with its table of boxes, every `step`-th frame. Boxes to be ignored and those
/// that are no vehicles count neither way. Throws Error(input).
std::vector<LabelledImage> readLabelledFrames(const std::string& input, const std::string& ground_truth, int step,
                                              bool show_progress, std::stop_token stop);

}  // namespace eyrie::cli
