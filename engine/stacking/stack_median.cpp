#include "stacking/stack_median.h"

#include <algorithm>
#include <cstring>

#include "stacking/selection_network.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stacking/stack_median.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace eyrie::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Selects the middle of `count` layers for all pixels. `steps` are triples low, high, keep; `work` holds `count`
/// vectors.
void selectMiddle(const std::uint8_t* const* layers, std::size_t count, const std::uint32_t* steps,
                  std::size_t step_count, std::size_t middle, std::size_t pixels, std::uint8_t* work,
                  std::uint8_t* median) {
    const hn::ScalableTag<std::uint8_t> tag;
    const std::size_t lanes = hn::Lanes(tag);
    for (std::size_t at = 0; at < pixels; at += lanes) {
        const std::size_t wanted = std::min(lanes, pixels - at);
        for (std::size_t h = 0; h < count; ++h) std::memcpy(work + h * lanes, layers[h] + at, wanted);
        for (std::size_t i = 0; i < step_count; ++i) {
            std::uint8_t* low = work + steps[3 * i] * lanes;
            std::uint8_t* high = work + steps[3 * i + 1] * lanes;
            const auto a = hn::Load(tag, low);
            const auto b = hn::Load(tag, high);
            if (steps[3 * i + 2] & 1U) hn::Store(hn::Min(a, b), tag, low);
            if (steps[3 * i + 2] & 2U) hn::Store(hn::Max(a, b), tag, high);
        }
        std::memcpy(median + at, work + middle * lanes, wanted);
    }
}

std::size_t vectorBytes() {
    return hn::Lanes(hn::ScalableTag<std::uint8_t>());
}

}  // namespace eyrie::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <hwy/aligned_allocator.h>

namespace eyrie {

HWY_EXPORT(selectMiddle);
HWY_EXPORT(vectorBytes);

void StackMedian::compute(const std::vector<const std::uint8_t*>& layers, std::size_t pixels, std::uint8_t* median) {
    const std::size_t count = layers.size();
    const std::size_t middle = (count - 1) / 2;
    if (prepared_for_ != count) {
        steps_.clear();
        for (const auto& c : selectionNetwork(static_cast<int>(count), static_cast<int>(middle))) {
            steps_.push_back({c.low, c.high, (c.keep_low ? 1U : 0U) | (c.keep_high ? 2U : 0U)});
        }
        prepared_for_ = count;
    }
    static_assert(sizeof(Step) == 3 * sizeof(std::uint32_t));
    const auto work = hwy::AllocateAligned<std::uint8_t>(count * HWY_DYNAMIC_DISPATCH(vectorBytes)());
    const std::uint32_t* steps = steps_.empty() ? nullptr : &steps_.front().low;
    HWY_DYNAMIC_DISPATCH(selectMiddle)(layers.data(), count, steps, steps_.size(), middle, pixels, work.get(), median);
}

}  // namespace eyrie
#endif
