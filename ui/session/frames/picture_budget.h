#pragma once

#include <cstddef>
#include <cstdint>

namespace eyrie::ui {

/// Who keeps pictures of a video.
enum class PictureUse {
    review,     ///< the video in the window
    comparison  ///< the dock that holds two runs beside each other
};

/// Bytes of pictures that may be kept on a machine with so much memory (bytes; 0: not known): a share of it, between
/// what a window needs to be smooth and what more does not help.
std::size_t pictureBudget(PictureUse use, std::uint64_t memory);

/// The same on this machine.
std::size_t pictureBudget(PictureUse use);

}  // namespace eyrie::ui
