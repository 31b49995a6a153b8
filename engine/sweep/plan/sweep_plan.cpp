#include "sweep/plan/sweep_plan.h"

#include <algorithm>
#include <numeric>

#include "chain/parameter_stage.h"
#include "core/error.h"
#include "detection/detector_factory.h"
#include "evaluation/evaluate.h"

namespace eyrie {
namespace {

constexpr std::int64_t kMostPoints = 10'000'000;

std::int64_t productOf(const std::vector<SweepAxis>& axes) {
    std::int64_t product = axes.empty() ? 0 : 1;
    for (const SweepAxis& axis : axes) product *= static_cast<std::int64_t>(axis.values.size());
    return product;
}

/// The axes of which a value may need a model file.
std::vector<SweepAxis> modelAxes(const SweepPlan& plan) {
    ChainOptions options;
    const std::vector<Parameter> parameters = listParameters(describeOf(options));
    std::vector<SweepAxis> axes = plan.axes;
    std::erase_if(axes, [&](const SweepAxis& axis) {
        return std::none_of(parameters.begin(), parameters.end(), [&](const Parameter& parameter) {
            return parameter.name == axis.name && parameter.effect.chooses_model;
        });
    });
    return axes;
}

/// Shows early which models cannot be used.
void checkModels(const SweepPlan& plan) {
    const auto tried = [&](const ChainOptions& options) { makeDetector(options.detection, plan.clips.front().scale); };
    const std::vector<SweepAxis> axes = modelAxes(plan);
    if (axes.empty()) tried(plan.baseOptions());
    for (const SweepAxis& axis : axes) {
        for (const std::string& value : axis.values) {
            ChainOptions options = plan.baseOptions();
            setParameter(describeOf(options), axis.name, value);
            try {
                tried(options);
            } catch (const Error& error) {
                throw Error(error.kind(), axis.name + " = " + value + ": " + error.what());
            }
        }
    }
}

}  // namespace

int SweepPlan::pointCount() const {
    return static_cast<int>(std::min(productOf(axes), kMostPoints));
}

std::vector<int> SweepPlan::indicesOf(int position) const {
    std::vector<int> indices(axes.size());
    for (std::size_t a = axes.size(); a-- > 0;) {
        const int count = static_cast<int>(axes[a].values.size());
        indices[a] = position % count;
        position /= count;
    }
    return indices;
}

int SweepPlan::positionOf(const std::vector<int>& indices) const {
    int position = 0;
    for (std::size_t a = 0; a < axes.size(); ++a)
        position = position * static_cast<int>(axes[a].values.size()) + indices.at(a);
    return position;
}

std::vector<std::string> SweepPlan::valuesOf(int position) const {
    const std::vector<int> indices = indicesOf(position);
    std::vector<std::string> values;
    for (std::size_t a = 0; a < axes.size(); ++a)
        values.push_back(axes[a].values[static_cast<std::size_t>(indices[a])]);
    return values;
}

ChainOptions SweepPlan::baseOptions() const {
    ChainOptions options;
    setParameters(describeOf(options), base);
    return options;
}

ChainOptions SweepPlan::optionsOf(int position) const {
    ChainOptions options = baseOptions();
    const std::vector<std::string> values = valuesOf(position);
    for (std::size_t a = 0; a < axes.size(); ++a) setParameter(describeOf(options), axes[a].name, values[a]);
    return options;
}

EvaluationOptions SweepPlan::evaluationOf(const SweepClip& clip) const {
    EvaluationOptions options;
    options.vehicles_only = vehicles_only;
    options.one_class = one_class;
    options.upright = clip.upright;
    options.border = border;
    options.image_size = clip.size;
    return options;
}

std::string SweepPlan::describe(int position) const {
    const std::vector<std::string> values = valuesOf(position);
    std::string text;
    for (std::size_t a = 0; a < axes.size(); ++a) text += (a > 0 ? ", " : "") + axes[a].name + " = " + values[a];
    return text;
}

void check(const SweepPlan& plan) {
    if (plan.axes.empty() || plan.axes.size() > 2) {
        throw Error(ErrorKind::parameter,
                    "a sweep changes one or two parameters, not " + std::to_string(plan.axes.size()));
    }
    if (plan.axes.size() == 2 && plan.axes[0].name == plan.axes[1].name)
        throw Error(ErrorKind::parameter, plan.axes[0].name + " is to be swept twice; name another parameter");
    for (const SweepAxis& axis : plan.axes) {
        if (axis.values.empty()) throw Error(ErrorKind::parameter, axis.name + ": there is no value to try");
    }
    if (productOf(plan.axes) > kMostPoints) {
        throw Error(ErrorKind::parameter, "the sweep has " + std::to_string(productOf(plan.axes)) +
                                              " points; at most " + std::to_string(kMostPoints) + " are possible");
    }
    if (plan.clips.empty()) throw Error(ErrorKind::parameter, "there is no sequence to sweep over");
    if (plan.overlaps.empty()) throw Error(ErrorKind::parameter, "there is no overlap to measure at");
    for (const double overlap : plan.overlaps) {
        EvaluationOptions options = plan.evaluationOf(plan.clips.front());
        options.overlap = overlap;
        check(options);
    }
    checkModels(plan);
}

std::vector<int> workOrder(const SweepPlan& plan) {
    std::vector<int> order(static_cast<std::size_t>(plan.pointCount()));
    std::iota(order.begin(), order.end(), 0);
    if (plan.axes.size() != 2 || firstStageOf(plan.axes[0].name) <= firstStageOf(plan.axes[1].name)) return order;
    const int inner = static_cast<int>(plan.axes[0].values.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const int at = static_cast<int>(i);
        order[i] = plan.positionOf({at % inner, at / inner});
    }
    return order;
}

std::vector<int> shardOf(const std::vector<int>& order, int number, int count) {
    if (count < 1 || number < 1 || number > count) {
        throw Error(ErrorKind::parameter, "shard " + std::to_string(number) + "/" + std::to_string(count) +
                                              ": expected PART/PARTS with PART from 1 to PARTS, e.g. 3/8");
    }
    const auto cut = [&](int at) {
        return static_cast<std::ptrdiff_t>(static_cast<std::int64_t>(order.size()) * at / count);
    };
    return {order.begin() + cut(number - 1), order.begin() + cut(number)};
}

}  // namespace eyrie
