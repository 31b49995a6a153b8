#pragma once

#include <chrono>
#include <string>

namespace eyrie::cli {

/// A progress line on standard error: a bar that rewrites itself on a terminal, a line every few seconds otherwise.
class ConsoleProgress {
 public:
    /// `unit`: what is counted, e.g. "frames".
    explicit ConsoleProgress(std::string unit);
    ~ConsoleProgress();
    ConsoleProgress(const ConsoleProgress&) = delete;
    ConsoleProgress& operator=(const ConsoleProgress&) = delete;

    void show(int done, int total, double per_second, double seconds_left);
    /// For work that has no frames to count, of which `share` is done: shown in per cent once it takes longer than a
    /// second. The unit says what of, e.g. "% copied".
    void showShare(double share);

 private:
    std::string unit_;
    bool terminal_;
    bool drawn_ = false;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point last_{};
};

/// "1:05:09", "3:07".
std::string clockText(double seconds);

}  // namespace eyrie::cli
