#include "chain/scale_estimation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <vector>

#include "chain/chain.h"
#include "core/error.h"

namespace eyrie {
namespace {

constexpr double kFinest = 0.04;  ///< m/px, first assumption
constexpr int kAssumptions = 9;
constexpr double kStep = 1.4;  ///< from one assumption to the next
constexpr int kPilotFrames = 40;
constexpr int kSettledFrames = 14;  ///< until tracks have formed
constexpr std::size_t kFewestStates = 8;
constexpr std::size_t kFewestCars = 3;
constexpr double kGoodEnough = 0.55;  ///< of the best score: too coarse assumptions cut vehicles into car-sized pieces
constexpr double kCarLength = 4.6;    ///< m, of the boxes that the chain puts around usual cars

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
    int tracks = 0;
    std::vector<double> car_lengths;  ///< m, of the tracks that look like cars
    /// Many cars, and few tracks that are none.
    double score() const {
        const auto cars = static_cast<double>(car_lengths.size());
        return car_lengths.size() < kFewestCars ? 0 : cars * (cars / tracks) * (cars / tracks);
    }
};

Outcome outcomeUnder(const std::vector<Frame>& frames, const ChainOptions& options, const SceneScale& scale,
                     const std::stop_token& stop, const std::function<void()>& tell) {
    struct Sizes {
        std::vector<double> lengths, widths;
    };
    Chain chain(options, scale);
    std::map<TrackId, Sizes> sizes;
    for (std::size_t i = 0; i < frames.size() && !stop.stop_requested(); ++i) {
        const FrameResult result = chain.next(frames[i]);
        tell();
        if (i < kSettledFrames) continue;
        for (const auto& track : result.tracks) {
            if (track.status != TrackStatus::confirmed) continue;
            sizes[track.id].lengths.push_back(scale.metres(track.box.length));
            sizes[track.id].widths.push_back(scale.metres(track.box.width));
        }
    }
    Outcome outcome;
    for (auto& [id, seen] : sizes) {
        if (seen.lengths.size() < kFewestStates) continue;
        ++outcome.tracks;
        const double length = medianOf(seen.lengths);
        const double width = medianOf(seen.widths);
        if (length > 3.6 && length < 6.6 && width > 1.5 && width < 3.8) outcome.car_lengths.push_back(length);
    }
    return outcome;
}

}  // namespace

std::optional<ScaleEstimate> estimateScale(FrameSource& source, FrameIndex first, FrameIndex last,
                                           const ChainOptions& options, double frame_rate_hz,
                                           const std::stop_token& stop, const ScaleProgress& told) {
    std::vector<Frame> frames;
    for (FrameIndex i = first; i <= last && i < first + kPilotFrames && !stop.stop_requested(); ++i) {
        try {
            frames.push_back(source.read(i, false));
        } catch (const Error&) {
            break;  // the run will come to this frame and report it
        }
    }
    SceneScale scale;
    scale.frame_rate_hz = frame_rate_hz;
    RunProgress progress;
    progress.estimating_scale = true;
    progress.frames_total = kAssumptions * static_cast<int>(frames.size());
    const auto begin = std::chrono::steady_clock::now();
    const auto tell = [&] {
        if (!told) return;
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
        ++progress.frames_done;
        progress.frames_per_second = progress.frames_done / std::max(passed.count(), 1e-6);
        progress.seconds_left = (progress.frames_total - progress.frames_done) / progress.frames_per_second;
        told(progress);
    };
    std::vector<Outcome> outcomes;
    for (int i = 0; i < kAssumptions; ++i) {
        scale.gsd_m_per_px = assumption(i);
        outcomes.push_back(outcomeUnder(frames, options, scale, stop, tell));
        if (stop.stop_requested()) return std::nullopt;
    }
    double best = 0;
    for (const auto& outcome : outcomes) best = std::max(best, outcome.score());
    const auto scoreAt = [&](int i) {
        return i < 0 || i >= kAssumptions ? 0.0 : outcomes[static_cast<std::size_t>(i)].score();
    };
    // The finest assumption that stands out: coarser ones may cut large vehicles into pieces of a car's size.
    for (int i = 0; i < kAssumptions; ++i) {
        const double score = scoreAt(i);
        if (score <= 0 || score < kGoodEnough * best || score < scoreAt(i - 1) || score < scoreAt(i + 1)) continue;
        const auto& lengths = outcomes[static_cast<std::size_t>(i)].car_lengths;
        return ScaleEstimate{assumption(i) * kCarLength / medianOf(lengths), static_cast<int>(lengths.size())};
    }
    return std::nullopt;
}

bool isFallbackScale(const SceneScale& scale) {
    return !scale.gsd_known && scale.gsd_m_per_px == SceneScale().gsd_m_per_px;
}

SceneScale chooseScale(FrameSource& source, FrameRange range, const ChainOptions& options, double gsd_m_per_px,
                       const std::stop_token& stop, const ScaleProgress& told) {
    SceneScale scale = sceneScale(source.info(), gsd_m_per_px);
    if (scale.gsd_known) return scale;
    const FrameIndex end = source.info().frame_count - 1;
    const FrameIndex last = range.last < 0 ? end : std::min(range.last, end);
    if (range.first < 0 || range.first > last) return scale;
    const auto estimate = estimateScale(source, range.first, last, options, scale.frame_rate_hz, stop, told);
    if (estimate) scale.gsd_m_per_px = estimate->gsd_m_per_px;
    return scale;
}

}  // namespace eyrie
