#include "chain/parameter_stage.h"

#include <algorithm>
#include <map>

#include "core/error.h"

namespace eyrie {
namespace {

std::vector<Parameter> parametersOf(const ChainOptions& options) {
    ChainOptions copy = options;
    return listParameters(describeOf(copy));
}

/// Text of the parameters whose effect `counts` accepts.
template <class Counts>
std::string signature(const ChainOptions& options, Counts&& counts) {
    std::string text;
    for (const Parameter& parameter : parametersOf(options)) {
        if (!counts(parameter.effect)) continue;
        text += parameter.name;
        text += '=';
        text += parameter.value;
        text += '\n';
    }
    return text;
}

}  // namespace

ChainStage firstStageOf(const std::string& parameter) {
    static const std::map<std::string, ChainStage> stages = [] {
        std::map<std::string, ChainStage> declared;
        for (const Parameter& known : parametersOf({})) declared.emplace(known.name, known.effect.stage);
        return declared;
    }();
    const auto found = stages.find(parameter);
    if (found == stages.end())
        throw Error(ErrorKind::internal, "the parameter " + parameter + " belongs to no stage of the chain");
    return found->second;
}

ChainStage firstDifference(const ChainOptions& a, const ChainOptions& b) {
    const std::vector<Parameter> of_b = parametersOf(b);
    auto other = of_b.begin();
    ChainStage first = ChainStage::none;
    for (const Parameter& parameter : parametersOf(a))
        if (parameter.value != (other++)->value) first = std::min(first, parameter.effect.stage);
    return first;
}

std::string signatureOf(const ChainOptions& options, ChainStage first, ChainStage last) {
    return signature(options,
                     [&](const ParameterEffect& effect) { return effect.stage >= first && effect.stage <= last; });
}

std::string signatureUpTo(const ChainOptions& options, ChainStage last) {
    return signatureOf(options, ChainStage::registration, last);
}

std::string preparationSignature(const ChainOptions& options) {
    return signature(options, [](const ParameterEffect& effect) {
        return effect.stage <= ChainStage::motion || (effect.stage == ChainStage::detection && !effect.decision_only);
    });
}

std::string areaSignature(const ChainOptions& options) {
    return signature(options, [](const ParameterEffect& effect) {
        return effect.stage <= ChainStage::motion || effect.stage == ChainStage::detection;
    });
}

}  // namespace eyrie
