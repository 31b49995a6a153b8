#include "formats/frame_offset.h"

#include <algorithm>
#include <vector>

namespace eyrie {
namespace {

constexpr std::size_t kFramesLookedAt = 200;
constexpr std::size_t kFewestPairs = 20;
constexpr double kLeastOverlap = 0.2;

/// Mean over the boxes that move or stand: each with the label that fits it best. From the boxes' side, as labels may
/// hold objects that nobody else has.
std::optional<double> meanOverlap(const BoxesByFrame& labels, const BoxesByFrame& boxes,
                                  const std::vector<FrameIndex>& frames, int shift) {
    double sum = 0;
    std::size_t count = 0;
    for (const FrameIndex frame : frames) {
        const auto labelled = labels.find(frame - shift);
        if (labelled == labels.end()) continue;
        for (const BoxRecord& box : boxes.at(frame)) {
            double best = 0;
            for (const BoxRecord& label : labelled->second) {
                best = std::max(best, overlap(box.box.upright(), label.box.upright()));
            }
            sum += best;
            ++count;
        }
    }
    if (count < kFewestPairs) return std::nullopt;
    return sum / static_cast<double>(count);
}

}  // namespace

std::optional<OffsetGuess> guessFrameOffset(const BoxesByFrame& labels, const BoxesByFrame& boxes, int reach) {
    std::vector<FrameIndex> frames;
    const std::size_t step = std::max<std::size_t>(1, boxes.size() / kFramesLookedAt);
    std::size_t place = 0;
    for (const auto& [frame, records] : boxes) {
        if (place++ % step == 0) frames.push_back(frame);
    }
    OffsetGuess guess;
    guess.overlap_as_is = meanOverlap(labels, boxes, frames, 0).value_or(0);
    guess.overlap = guess.overlap_as_is;
    for (int distance = 1; distance <= reach; ++distance) {
        for (const int shift : {-distance, distance}) {
            const double found = meanOverlap(labels, boxes, frames, shift).value_or(0);
            if (found <= guess.overlap + 1e-9) continue;
            guess.overlap = found;
            guess.shift = shift;
        }
    }
    if (guess.overlap < kLeastOverlap) return std::nullopt;
    return guess;
}

}  // namespace eyrie
