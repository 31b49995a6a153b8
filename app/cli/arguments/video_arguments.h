#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "chain/chain_run.h"

namespace CLI {
class App;
}

namespace eyrie::cli {

/// The arguments --gsd, --fps and --frames, shared by all commands that run the chain over a video.
struct VideoArguments {
    std::optional<double> gsd_m_per_px;
    std::optional<double> frame_rate_hz;
    std::string frames;

    void addTo(CLI::App& command);
    /// Without --gsd, for commands that take several videos.
    void addTimeTo(CLI::App& command);
    /// Throws Error(parameter) for a number that cannot be meant.
    void check() const;
    /// "A:B", "A:", ":B" or "A" as first and last frame; all frames where nothing is said. Throws Error(parameter).
    FrameRange range() const;
};

/// What --start says: µs since 1970-01-01; nothing for an empty text. Throws Error(parameter).
std::optional<std::int64_t> startOf(const std::string& text);

/// Throws Error(parameter) unless `gsd` is a usable number of metres per pixel, and warns of one with which nothing can
/// be found.
void checkGsd(double gsd_m_per_px);

}  // namespace eyrie::cli
