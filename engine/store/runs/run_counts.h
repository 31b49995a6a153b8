#pragma once

#include <vector>

#include "core/values/registration_failure.h"
#include "store/project/project_file.h"

namespace eyrie {

/// Frames that could not be registered for one reason.
struct ReasonCount {
    RegistrationFault fault = RegistrationFault::none;
    PictureQuality picture = PictureQuality::clear;
    int frames = 0;
};

/// What a run has stored, counted.
struct RunCounts {
    int frames = 0;
    int unregistered = 0;              ///< frames whose registration failed
    std::vector<ReasonCount> reasons;  ///< of these, the most frequent first
    long motion_vectors = 0;           ///< over all frames
    bool any_detection = false;        ///< rejected ones, too
    long detections = 0;               ///< kept ones, over all frames
    int tracks = 0;                    ///< confirmed ones
    int dropped_tracks = 0;            ///< confirmed, but left out when the tracks were finished
};

/// Counts a run in the file itself, without reading its frames into memory. A run that is not there counts as empty.
/// Throws Error(project).
RunCounts countRun(ProjectFile& project, int run_id);

}  // namespace eyrie
