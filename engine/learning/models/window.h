#pragma once

#include <opencv2/core/mat.hpp>

namespace eyrie {

/// The sliding window (Teutsch §5.4.3): 16 px wide, 32 px long, heading up, so that the vehicle's axis is vertical.
inline constexpr int kWindowWidth = 16;
inline constexpr int kWindowHeight = 32;

/// A median car in the window as our training samples show it, px; the rest is context.
inline constexpr double kCarLengthInWindow = 21.5;
inline constexpr double kCarWidthInWindow = 10;

/// What the box of a vehicle of median size takes of the window, px.
struct WindowFit {
    double length = kCarLengthInWindow;
    double width = kCarWidthInWindow;

    /// The box is the window, no ground around it (Teutsch §7.2).
    static constexpr WindowFit filled() { return {kWindowHeight, kWindowWidth}; }
    bool operator==(const WindowFit&) const = default;
};

/// Throws Error(internal) unless `window` is CV_8UC1 of 16×32.
void requireWindow(const cv::Mat& window);

}  // namespace eyrie
