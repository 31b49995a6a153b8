#pragma once

#include <chrono>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <stop_token>
#include <string>

#include "io/live/camera_device.h"

namespace eyrie {

/// A picture of a camera.
struct CameraPicture {
    cv::Mat pixels;  ///< CV_8UC3, blue-green-red
    std::chrono::steady_clock::time_point came;
};

/// Opens and reads a camera on a thread of its own, so that nobody has to wait for one that hangs: neither opening nor
/// reading can be ended from outside. A thread that hangs is left to itself, with its camera, and ends when the
/// camera's driver gives up.
class CameraReader {
 public:
    /// Begins to open a device; `open` must stay of use until the camera is open, also when the reader is gone.
    CameraReader(const std::string& device, const CameraOpener& open);
    /// Waits for a camera that works to be closed, for one that hangs half a second.
    ~CameraReader();
    CameraReader(const CameraReader&) = delete;
    CameraReader& operator=(const CameraReader&) = delete;

    /// The next picture; nothing when none came for `seconds`, the camera sends no more, or at `stop`. Throws what
    /// opening threw.
    std::optional<CameraPicture> next(double seconds, const std::stop_token& stop);
    /// As CameraDevice::frameRate(), once a picture came; before that 0.
    double frameRate() const;

 private:
    struct Shared;
    std::shared_ptr<Shared> shared_;  ///< with the thread
};

}  // namespace eyrie
