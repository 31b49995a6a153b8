#include "cli/arguments/video_arguments.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "cli/reports/figure_text.h"
#include "core/error.h"
#include "core/time/utc_time.h"
#include "core/values/scene_scale.h"

namespace eyrie::cli {
namespace {

bool readFrameNumber(const std::string& text, FrameIndex& value) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stop == end && value >= 0;
}

}  // namespace

void VideoArguments::addTo(CLI::App& command) {
    command.add_option("--gsd", gsd_m_per_px, "Ground sampling distance in metres per pixel");
    addTimeTo(command);
}

void VideoArguments::addTimeTo(CLI::App& command) {
    command.add_option("--fps", frame_rate_hz, "Frames per second, where the video does not state them or is wrong");
    command.add_option("--frames", frames, "First and last frame, both included, from 0: A:B, A: or :B");
}

void VideoArguments::check() const {
    if (gsd_m_per_px) checkGsd(*gsd_m_per_px);
    if (frame_rate_hz && !(std::isfinite(*frame_rate_hz) && *frame_rate_hz > 0 && *frame_rate_hz <= 10000)) {
        throw Error(ErrorKind::parameter,
                    "--fps " + numberText(*frame_rate_hz) + ": expected frames per second above 0, e.g. 25");
    }
    range();
}

FrameRange VideoArguments::range() const {
    FrameRange range;
    if (frames.empty()) return range;
    const auto colon = frames.find(':');
    const std::string first = frames.substr(0, colon);
    const std::string last = colon == std::string::npos ? first : frames.substr(colon + 1);
    const bool good = (first.empty() || readFrameNumber(first, range.first)) &&
                      (last.empty() || readFrameNumber(last, range.last)) &&
                      (range.last < 0 || range.first <= range.last);
    if (!good) {
        throw Error(
            ErrorKind::parameter,
            "--frames " + frames + ": expected FIRST:LAST, both included and from 0, e.g. 100:249, 100: or :249");
    }
    return range;
}

std::optional<std::int64_t> startOf(const std::string& text) {
    if (text.empty()) return std::nullopt;
    if (const auto utc_us = utcOf(text)) return utc_us;
    throw Error(ErrorKind::parameter, "--start " + text + ": expected a time in UTC, e.g. 2026-11-21T08:00:00Z");
}

void checkGsd(double gsd) {
    if (const std::string why = whyNotAGsd(gsd); !why.empty())
        throw Error(ErrorKind::parameter, "--gsd " + numberText(gsd) + ": " + why + "; leave it out when unknown");
    if (const std::string doubt = doubtOfGsd(gsd); !doubt.empty())
        std::fprintf(stderr, "eyrie-cli: --gsd %s: %s\n", numberText(gsd).c_str(), doubt.c_str());
}

}  // namespace eyrie::cli
