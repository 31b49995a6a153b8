#include "session/frames/picture_budget.h"

#include <unistd.h>

#include <algorithm>

namespace eyrie::ui {

namespace {

constexpr std::uint64_t kMegabyte = std::uint64_t{1} << 20U;
constexpr std::uint64_t kLeast = 48 * kMegabyte;  // some twenty frames of 1024 × 540

/// Bytes of physical memory; 0 where the system does not tell.
std::uint64_t memoryOfMachine() {
    const auto pages = ::sysconf(_SC_PHYS_PAGES);
    const auto page = ::sysconf(_SC_PAGESIZE);
    return pages > 0 && page > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page) : 0;
}

}  // namespace

std::size_t pictureBudget(PictureUse use, std::uint64_t memory) {
    const bool review = use == PictureUse::review;
    const std::uint64_t most = (review ? 384 : 256) * kMegabyte;
    const std::uint64_t share = memory / (review ? 8 : 12);
    return static_cast<std::size_t>(std::clamp(share, kLeast, most));
}

std::size_t pictureBudget(PictureUse use) {
    return pictureBudget(use, memoryOfMachine());
}

}  // namespace eyrie::ui
