#include "cli/reports/console_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace eyrie::cli {

ConsoleProgress::ConsoleProgress(std::string unit) : unit_(std::move(unit)), terminal_(isatty(STDERR_FILENO) != 0) {}

ConsoleProgress::~ConsoleProgress() {
    if (drawn_ && terminal_) std::fputc('\n', stderr);
}

void ConsoleProgress::show(int done, int total, double per_second, double seconds_left) {
    const auto now = std::chrono::steady_clock::now();
    const auto interval = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(5000);
    if (drawn_ && done < total && now - last_ < interval) return;
    last_ = now;
    drawn_ = true;
    const double share = total > 0 ? static_cast<double>(done) / total : 0;
    char text[160];
    std::snprintf(text, sizeof text, "%3.0f %%  %d/%d %s  %.1f/s  %s left", share * 100, done, total, unit_.c_str(),
                  per_second, clockText(seconds_left).c_str());
    if (terminal_) {
        const int width = 24;
        const int filled = std::clamp(static_cast<int>(share * width), 0, width);
        std::fprintf(stderr, "\r[%s%s] %s\033[K", std::string(static_cast<std::size_t>(filled), '#').c_str(),
                     std::string(static_cast<std::size_t>(width - filled), '.').c_str(), text);
    } else {
        std::fprintf(stderr, "%s\n", text);
    }
}

void ConsoleProgress::showShare(double share) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    if (seconds <= 1 || !(share > 0)) return;
    show(static_cast<int>(share * 100), 100, share * 100 / seconds, seconds * (1 - share) / share);
}

std::string clockText(double seconds) {
    const int whole = static_cast<int>(std::max(seconds, 0.0) + 0.5);
    char text[32];
    if (whole >= 3600) {
        std::snprintf(text, sizeof text, "%d:%02d:%02d", whole / 3600, whole / 60 % 60, whole % 60);
    } else {
        std::snprintf(text, sizeof text, "%d:%02d", whole / 60, whole % 60);
    }
    return text;
}

}  // namespace eyrie::cli
