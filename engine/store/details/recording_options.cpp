#include "store/details/recording_options.h"

#include "core/error.h"

namespace eyrie {

const char* nameOf(KeptDetails kept) {
    switch (kept) {
        case KeptDetails::automatic:
            return "automatic";
        case KeptDetails::all:
            return "all";
        case KeptDetails::sampled:
            return "sampled";
        case KeptDetails::none:
            return "none";
    }
    return "";
}

bool RecordingOptions::keepsDetailsOf(FrameIndex frame, FrameIndex first, FrameIndex last) const {
    switch (details) {
        case KeptDetails::automatic:
            return last - first < details_up_to;
        case KeptDetails::all:
            return true;
        case KeptDetails::sampled:
            return (frame - first) % details_every == 0;
        case KeptDetails::none:
            return false;
    }
    return true;
}

bool RecordingOptions::keepsAllDetails(FrameIndex first, FrameIndex last) const {
    return keepsDetailsOf(first, first, last) && (details != KeptDetails::sampled || details_every == 1);
}

void RecordingOptions::describe(ParameterVisitor& v) {
    const ParameterDeclarer declare(v, ChainStage::none);
    std::vector<std::string> names;
    for (const KeptDetails known : {KeptDetails::automatic, KeptDetails::all, KeptDetails::sampled, KeptDetails::none})
        names.emplace_back(nameOf(known));
    declare.choice("recording.details", details, names,
                   {"",
                    "Of which frames the project keeps what is behind the tracks: motion vectors, corners, clusters, "
                    "search areas and detections, some 30 to 60 kB a frame, without which Tune, Why? and sweeps cannot "
                    "look into a frame. automatic: of all frames of short runs, of none of long ones. What is found is "
                    "the same.",
                    ""});
    declare.integer("recording.details_every", details_every, 1, 1000000,
                    {"frames", "With recording.details=sampled: every so many frames are kept.", ""});
    declare.integer("recording.details_up_to", details_up_to, 0, 10000000,
                    {"frames",
                     "With recording.details=automatic: runs over no more frames are short ones. The default is five "
                     "minutes at 25 Hz.",
                     ""});
}

std::vector<std::pair<std::string, std::string>> RecordingOptions::changed() const {
    RecordingOptions own = *this, usual;
    const std::vector<Parameter> values = listParameters(describeOf(own)), defaults = listParameters(describeOf(usual));
    std::vector<std::pair<std::string, std::string>> changed;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i].value != defaults[i].value) changed.emplace_back(values[i].name, values[i].value);
    return changed;
}

RecordingOptions RecordingOptions::among(const std::vector<std::pair<std::string, std::string>>& parameters) {
    RecordingOptions options;
    for (const auto& [name, value] : parameters) {
        if (!isOfRecording(name)) continue;
        try {
            setParameter(describeOf(options), name, value);
        } catch (const Error&) {
            // written by a version that knows more
        }
    }
    return options;
}

bool isOfRecording(const std::string& name) {
    return name.starts_with("recording.");
}

}  // namespace eyrie
