#include "chain/scale_estimation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <map>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "chain/chain.h"
#include "chain/look_progress.h"
#include "chain/slope_estimation.h"
#include "core/error.h"
#include "detection/detector_factory.h"

namespace eyrie {
namespace {

constexpr double kFinest = 0.04;  ///< m/px, first assumption
constexpr int kAssumptions = 9;
constexpr double kStep = 1.4;       ///< from one assumption to the next
constexpr int kSettledFrames = 14;  ///< until tracks have formed
constexpr std::size_t kFewestStates = 8;
constexpr double kFewestLooks = 8;  ///< sure windows under the best assumption; fewer are chance
constexpr int kReach = 2;           ///< assumptions on both sides of the best one that have a say
constexpr int kPlenty = 10;         ///< vehicles; where fewer drive, later frames are looked at, too
constexpr double kOwnError = 0.11;  ///< standard error of the logarithm where very many vehicles drive
/// Of the logarithm within one step of the assumptions.
const double kStepVariance = std::log(kStep) * std::log(kStep) / 12;
constexpr double kSure = 1.645;  ///< standard errors that hold 90 %

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The i-th assumption, m/px.
double assumption(int i) {
    return kFinest * std::pow(kStep, i);
}

/// What the chain found under one assumption.
struct Outcome {
    double detections = 0;
    double looks = 0;     ///< detections that the classifier took for whole vehicles
    double decision = 0;  ///< sum of its decision values there
    double tracks = 0;
    double cars = 0;  ///< tracks of a car's size
    /// Much that looks like vehicles, and little that does not: where the assumption is too fine cars do not fit the
    /// window, where it is too coarse they fall into pieces, and neither relief nor glare looks like a car at any.
    double score() const {
        if (looks <= 0) return 0;
        const double alike = looks / detections;
        const double car_sized = (cars + 1) / (tracks + 2);
        return decision * alike * alike * car_sized * car_sized;
    }
};

Outcome operator+(const Outcome& a, const Outcome& b) {
    return {a.detections + b.detections, a.looks + b.looks, a.decision + b.decision, a.tracks + b.tracks,
            a.cars + b.cars};
}

Outcome outcomeUnder(const std::vector<Frame>& frames, const ChainOptions& options, const SceneScale& scale,
                     const std::stop_token& stop, const std::function<void()>& tell) {
    struct Sizes {
        std::vector<double> lengths, widths;
    };
    Outcome outcome;
    Chain chain(options, scale);
    std::map<TrackId, Sizes> sizes;
    for (std::size_t i = 0; i < frames.size() && !stop.stop_requested(); ++i) {
        const FrameResult result = chain.next(frames[i]);
        tell();
        for (const Detection& detection : result.detections) {
            ++outcome.detections;
            if (!detection.complete) continue;
            ++outcome.looks;
            outcome.decision += detection.score;
        }
        if (i < kSettledFrames) continue;
        for (const auto& track : result.tracks) {
            if (track.status != TrackStatus::confirmed) continue;
            sizes[track.id].lengths.push_back(scale.metres(track.box.length));
            sizes[track.id].widths.push_back(scale.metres(track.box.width));
        }
    }
    for (auto& [id, seen] : sizes) {
        if (seen.lengths.size() < kFewestStates) continue;
        ++outcome.tracks;
        const double length = medianOf(seen.lengths);
        const double width = medianOf(seen.widths);
        if (length > 3.6 && length < 6.6 && width > 1.5 && width < 3.8) ++outcome.cars;
    }
    return outcome;
}

/// The middle of the scores around the best one. On twelve clips it lay between .82 and 1.06 of the truth; rather too
/// fine than too coarse, since a scale too coarse by a tenth costs more.
std::optional<ScaleEstimate> estimateFrom(const std::vector<Outcome>& outcomes) {
    int best = 0;
    for (int i = 0; i < kAssumptions; ++i) {
        const double score = outcomes[static_cast<std::size_t>(i)].score();
        if (score > outcomes[static_cast<std::size_t>(best)].score()) best = i;
    }
    const Outcome& peak = outcomes[static_cast<std::size_t>(best)];
    if (peak.looks < kFewestLooks || peak.cars < 1) return std::nullopt;
    double weights = 0;
    double sum = 0;
    double squares = 0;
    for (int i = std::max(0, best - kReach); i <= std::min(kAssumptions - 1, best + kReach); ++i) {
        const double share = outcomes[static_cast<std::size_t>(i)].score() / peak.score();
        const double weight = share * share;
        const double place = std::log(assumption(i));
        weights += weight;
        sum += weight * place;
        squares += weight * place * place;
    }
    const double middle = sum / weights;
    const double spread = squares / weights - middle * middle + kStepVariance;
    ScaleEstimate estimate;
    estimate.gsd_m_per_px = std::exp(middle);
    estimate.vehicles = static_cast<int>(peak.cars);
    estimate.uncertainty = std::exp(kSure * std::sqrt(kOwnError * kOwnError + spread / peak.cars));
    return estimate;
}

/// The chain that looks: whatever detector the run is to use, here the classifier has to say what is a vehicle.
ChainOptions lookingOptions(const ChainOptions& options) {
    ChainOptions looking = options;
    looking.detection = DetectionOptions{};
    looking.detection.sliding_window.model = options.detection.sliding_window.model;
    return looking;
}

/// Why nobody can say what is a vehicle; empty where the classifier is there.
std::string missingClassifier(const ChainOptions& options, const SceneScale& scale) {
    try {
        makeDetector(lookingOptions(options).detection, scale);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

/// What every assumption gives on the frames from `first` on; nothing when a stop is requested.
std::vector<Outcome> outcomesOf(FrameSource& source, FrameIndex first, FrameIndex last, const ChainOptions& options,
                                double frame_rate_hz, const std::stop_token& stop, const ScaleProgress& told) {
    const ChainOptions looking = lookingOptions(options);
    std::vector<Frame> frames;
    for (FrameIndex i = first; i <= last && i < first + kFramesOfLook && !stop.stop_requested(); ++i) {
        try {
            frames.push_back(source.read(i, false));
        } catch (const Error&) {
            break;  // the run will come to this frame and report it
        }
    }
    SceneScale scale;
    scale.frame_rate_hz = frame_rate_hz;
    LookProgress progress(told, kAssumptions * static_cast<int>(frames.size()));
    std::mutex telling;
    const auto tell = [&] {
        const std::scoped_lock lock(telling);
        progress.step();
    };
    std::vector<Outcome> outcomes(kAssumptions);
    std::atomic<int> next{0};
    const auto look = [&] {
        for (int i = next++; i < kAssumptions; i = next++) {
            SceneScale assumed = scale;
            assumed.gsd_m_per_px = assumption(i);
            outcomes[static_cast<std::size_t>(i)] = outcomeUnder(frames, looking, assumed, stop, tell);
        }
    };
    // One chain leaves processors idle. Threads of their own: what waits in a pool for a part of one chain would begin
    // another chain meanwhile, and all would be held at once.
    std::vector<std::future<void>> others;
    for (int i = 1; i < std::min(kAssumptions, cv::getNumThreads()); ++i)
        others.push_back(std::async(std::launch::async, look));
    look();
    for (auto& other : others) other.get();
    if (stop.stop_requested()) return {};
    return outcomes;
}

ScaleBasis basisOfChoice(const SceneScale& scale, const StatedScale& stated,
                         const std::optional<ScaleEstimate>& estimate) {
    if (scale.gsd_known) return {stated.origin};
    if (!estimate) return {ScaleOrigin::assumed};
    return {ScaleOrigin::estimated, estimate->uncertainty, estimate->vehicles};
}

/// What the traffic says of the scale at the middle of the picture.
std::optional<ScaleEstimate> estimateMiddle(FrameSource& source, FrameRange range, const ChainOptions& options,
                                            double frame_rate_hz, const std::stop_token& stop,
                                            const ScaleProgress& told) {
    const FrameIndex end = source.info().frame_count - 1;
    const FrameIndex last = range.last < 0 ? end : std::min(range.last, end);
    if (range.first < 0 || range.first > last) return std::nullopt;
    const FrameIndex farthest = std::max(range.first, last - kFramesOfLook + 1);
    FrameIndex looked_to = range.first - 1;
    std::vector<Outcome> together(kAssumptions);
    std::optional<ScaleEstimate> found;
    for (const FrameIndex first : {range.first, range.first + (farthest - range.first) / 2, farthest}) {
        if (first <= looked_to || stop.stop_requested()) continue;
        looked_to = first + kFramesOfLook - 1;
        const auto outcomes = outcomesOf(source, first, last, options, frame_rate_hz, stop, told);
        // What looks like a vehicle by chance must not add up to traffic.
        if (outcomes.empty() || !estimateFrom(outcomes)) continue;
        for (std::size_t i = 0; i < outcomes.size(); ++i) together[i] = together[i] + outcomes[i];
        const auto estimate = estimateFrom(together);
        if (!estimate) continue;
        found = estimate;
        if (estimate->vehicles >= kPlenty) break;
    }
    return found;
}

}  // namespace

ChosenScale chooseScale(FrameSource& source, FrameRange range, const ChainOptions& options, const StatedScale& stated,
                        const std::stop_token& stop, const ScaleProgress& told) {
    ChosenScale chosen;
    SceneScale& scale = chosen.scale;
    scale = sceneScale(source.info(), stated.gsd_m_per_px);
    if (!scale.gsd_known) {
        if (!looksThroughWindows(options.detection.method)) chosen.why_not = missingClassifier(options, scale);
        if (chosen.why_not.empty())
            chosen.estimate = estimateMiddle(source, range, options, scale.frame_rate_hz, stop, told);
        if (chosen.estimate) scale.gsd_m_per_px = chosen.estimate->gsd_m_per_px;
    }
    scale.slope = slopeFor(source, range, options, scale, stop, told);
    chosen.basis = basisOfChoice(scale, stated, chosen.estimate);
    return chosen;
}

ScaleSlope slopeFor(FrameSource& source, FrameRange range, const ChainOptions& options, const SceneScale& scale,
                    const std::stop_token& stop, const ScaleProgress& told) {
    // Where nothing is known of the scale, nothing looked like vehicles either. What knows its own scale is a rendered
    // scene, which is seen from above; its later frames are dear to come by.
    if (!options.view.oblique || !hasMetricLimits(scale) || source.info().gsd_m_per_px > 0) return {};
    return estimateSlope(source, range, options, scale, stop, told);
}

}  // namespace eyrie
