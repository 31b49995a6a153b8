#include "rerun/method_variants.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "core/error.h"

namespace eyrie {
namespace {

constexpr const char* kGlobalWindow = "global_sliding_window";
constexpr const char* kPeer = "three_frame_difference_sort";

struct NamedChange {
    std::string name;
    std::string group;
    std::function<void(ChainOptions&)> apply;
};

NamedChange gradientBy(const char* name, GradientMethod method) {
    return {name, "gradients", [method](ChainOptions& options) {
                options.detection.method = DetectionMethod::gradient;
                options.detection.gradient.method = method;
                // Each at its own optimum of table 7.3; the LBP gradient at ours, relative to the thesis'. 0 follows.
                const double ratio = GradientOptions::thesis(method).effectiveQuantile() /
                                     GradientOptions::thesis(GradientMethod::lbp).effectiveQuantile();
                options.detection.gradient.quantile = std::min(1.0, options.detection.gradient.quantile * ratio);
            }};
}

NamedChange rescaledBy(const char* name, WindowRescaling rescaling) {
    return {name, "rescaling", [rescaling](ChainOptions& options) {
                options.detection.method = DetectionMethod::sliding_window;
                options.detection.sliding_window.rescaling = rescaling;
            }};
}

/// The peer's tracks from their first box to their last, and nothing else done to them.
void leaveTracksAlone(ChainOptions& options) {
    options.finishing = FinishingOptions::thesis();
    options.finishing.trim_predicted = true;
    options.finishing.stop_speed_m_s = 0;
    // For those who read the stored parameters, and because tracks of classifiers are scored.
    options.difference.method = MotionMethod::three_frame_difference;
    options.detection.method = DetectionMethod::clusters;
}

const std::vector<NamedChange>& changes() {
    static const std::vector<NamedChange> all = [] {
        std::vector<NamedChange> list;
        for (const DetectionMethod method : allDetectionMethods()) {
            list.push_back(
                {nameOf(method), "detectors", [method](ChainOptions& options) { options.detection.method = method; }});
        }
        list.push_back(gradientBy("gradient_lbp", GradientMethod::lbp));
        list.push_back(gradientBy("gradient_simple", GradientMethod::simple));
        list.push_back(gradientBy("gradient_canny", GradientMethod::canny));
        list.push_back(gradientBy("gradient_morphological", GradientMethod::morphological));
        list.push_back(rescaledBy("sliding_window_joint_11", WindowRescaling::joint_11));
        list.push_back(rescaledBy("sliding_window_length_11", WindowRescaling::length_11));
        list.push_back(rescaledBy("sliding_window_length_3", WindowRescaling::length_3));
        for (const MotionMethod method : allMotionMethods()) {
            if (method == MotionMethod::vectors) continue;
            list.push_back({nameOf(method), "motion", [method](ChainOptions& options) {
                                // As in the literature: the areas themselves, confirmed by no motion vector.
                                options.difference.method = method;
                                options.detection.method = DetectionMethod::clusters;
                                options.outliers.min_vectors = 0;
                                options.outliers.min_density_share = 0;
                            }});
        }
        list.push_back({kGlobalWindow, "",
                        [](ChainOptions& options) { options.detection.method = DetectionMethod::sliding_window; }});
        list.push_back({kPeer, "peer", leaveTracksAlone});
        return list;
    }();
    return all;
}

}  // namespace

std::vector<std::string> methodWords() {
    std::vector<std::string> words;
    for (const NamedChange& change : changes()) words.push_back(change.name);
    return words;
}

std::vector<std::string> methodsNamed(const std::string& word) {
    std::vector<std::string> members;
    for (const NamedChange& change : changes()) {
        if (change.group == word && !word.empty()) members.push_back(change.name);
    }
    return members.empty() ? std::vector<std::string>{word} : members;
}

MethodVariant methodVariant(const std::string& word, const ChainOptions& base, const PeerOptions& peer) {
    for (const NamedChange& change : changes()) {
        if (change.name != word) continue;
        MethodVariant variant{word, base, word == kGlobalWindow};
        change.apply(variant.options);
        if (word == kPeer) variant.peer = peer;
        return variant;
    }
    std::string known = "the groups detectors, gradients, rescaling, motion, peer, and the methods ";
    bool first = true;
    for (const std::string& name : methodWords()) known += (std::exchange(first, false) ? "" : ", ") + name;
    throw Error(ErrorKind::parameter, "there is no method \"" + word + "\"; known are " + known);
}

MethodVariant withStacking(MethodVariant variant, bool stacking) {
    variant.options.stacking.enabled = stacking;
    if (stacking) variant.name += " + stacking";
    return variant;
}

}  // namespace eyrie
