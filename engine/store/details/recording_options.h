#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/parameter.h"
#include "core/values/ids.h"

namespace eyrie {

/// Of which frames a run keeps what is behind its tracks: motion vectors, corners, clusters, search areas, detections.
enum class KeptDetails {
    automatic,  ///< all of short runs, none of long ones
    all,
    sampled,  ///< every n-th frame
    none
};
const char* nameOf(KeptDetails kept);

/// What a run keeps beside its tracks. Changes nothing of what is found.
struct RecordingOptions {
    KeptDetails details = KeptDetails::automatic;
    int details_every = 25;    ///< frames, of `sampled`
    int details_up_to = 7500;  ///< frames; runs of no more are short for `automatic`

    /// Whether the details of `frame` are kept, of a run from frame `first` to frame `last`.
    bool keepsDetailsOf(FrameIndex frame, FrameIndex first, FrameIndex last) const;

    /// Whether those of all its frames are.
    bool keepsAllDetails(FrameIndex first, FrameIndex last) const;

    void describe(ParameterVisitor& visitor);

    /// Those of the parameters that are no default, as a run stores them beside those of the chain.
    std::vector<std::pair<std::string, std::string>> changed() const;
    /// As a run stored them, among others; what cannot be read is the default.
    static RecordingOptions among(const std::vector<std::pair<std::string, std::string>>& parameters);
};

/// Whether a parameter, or what is meant for one, is of these and not of the chain.
bool isOfRecording(const std::string& name);

}  // namespace eyrie
