#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace eyrie {

/// Pixelwise median of several layers (Teutsch eq. 5.2), exact: for an even number of layers the lower of the two
/// middle values. Stateless; the network for the last number of layers is kept. One object per thread.
class StackMedian {
 public:
    /// `layers`: pointers to `pixels` bytes each, 1 to 4096 of them; `median` receives `pixels` bytes.
    void compute(const std::vector<const std::uint8_t*>& layers, std::size_t pixels, std::uint8_t* median);

 private:
    struct Step {
        std::uint32_t low;
        std::uint32_t high;
        std::uint32_t keep;  // 1: smaller, 2: larger, 3: both
    };
    std::size_t prepared_for_ = 0;
    std::vector<Step> steps_;
};

}  // namespace eyrie
