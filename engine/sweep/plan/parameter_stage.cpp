#include "sweep/plan/parameter_stage.h"

#include <map>

#include "core/error.h"
#include "detection/detector.h"

namespace eyrie {
namespace {

/// Text of the parameters that `counts` accepts.
template <class Counts>
std::string textOf(const ChainOptions& options, Counts&& counts) {
    std::string text;
    for (const auto& [name, value] : parameterValues(options)) {
        if (!counts(name)) continue;
        text += name;
        text += '=';
        text += value;
        text += '\n';
    }
    return text;
}

}  // namespace

const char* nameOf(SweepStage stage) {
    switch (stage) {
        case SweepStage::registration:
            return "registration";
        case SweepStage::motion:
            return "independent motion";
        case SweepStage::clustering:
            return "clustering";
        case SweepStage::stacking:
            return "stacking";
        case SweepStage::detection:
            return "detection";
        case SweepStage::removal:
            return "duplicates and outliers";
        case SweepStage::tracking:
            return "tracking";
        case SweepStage::finishing:
            return "finishing";
    }
    return "";
}

SweepStage firstStageOf(const std::string& parameter) {
    static const std::map<std::string, SweepStage> stages{
        {"registration", SweepStage::registration}, {"motion", SweepStage::motion},
        {"difference", SweepStage::clustering},     {"clustering", SweepStage::clustering},
        {"stacking", SweepStage::stacking},         {"detection", SweepStage::detection},
        {"gradient", SweepStage::detection},        {"relative_connectivity", SweepStage::detection},
        {"sliding_window", SweepStage::detection},  {"window_and_gradient", SweepStage::detection},
        {"tophat_otsu", SweepStage::detection},     {"mser", SweepStage::detection},
        {"canny_harris", SweepStage::detection},    {"duplicates", SweepStage::removal},
        {"outliers", SweepStage::removal},          {"tracking", SweepStage::tracking},
        {"finishing", SweepStage::finishing},
    };
    // It says where clusters come from; motion vectors are the same for all.
    if (parameter == "motion.method") return SweepStage::clustering;
    const auto found = stages.find(parameter.substr(0, parameter.find('.')));
    if (found == stages.end() || parameter.find('.') == std::string::npos) {
        throw Error(ErrorKind::internal, "the parameter " + parameter + " belongs to no stage of the chain");
    }
    return found->second;
}

std::string signatureUpTo(const ChainOptions& options, SweepStage last) {
    return textOf(options, [&](const std::string& name) { return firstStageOf(name) <= last; });
}

std::string preparationSignature(const ChainOptions& options) {
    return textOf(options, [](const std::string& name) {
        const SweepStage stage = firstStageOf(name);
        return stage <= SweepStage::motion || (stage == SweepStage::detection && !changesDecisionOnly(name));
    });
}

std::string areaSignature(const ChainOptions& options) {
    return textOf(options, [](const std::string& name) {
        const SweepStage stage = firstStageOf(name);
        return stage <= SweepStage::motion || stage == SweepStage::detection;
    });
}

}  // namespace eyrie
