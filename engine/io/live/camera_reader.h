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

/// How long a camera may take before it counts as one that hangs.
struct CameraPatience {
    /// For the first picture, and as long before for a former reader of it that is not done yet.
    double connect_s = 10;
    double close_s = 0.5;  ///< to end the picture it is at, and to be closed
};

/// Opens and reads a camera on a thread of its own, so that nobody has to wait for one that hangs: neither opening nor
/// reading can be ended from outside. A thread that hangs is left to itself, with its camera, and ends when the
/// camera's driver gives up. Until then the device cannot be opened again, which the next reader of it waits for.
class CameraReader {
 public:
    /// Begins to open a device; `open` must stay of use until the camera is open, also when the reader is gone. Waits
    /// for a former reader of it in this program; throws Error(input) where that one hangs or is still in use. At
    /// `stop` it opens nothing and has no pictures.
    CameraReader(const std::string& device, const CameraOpener& open, const CameraPatience& patience,
                 const std::stop_token& stop);
    /// Waits for the camera to be closed, but not for one that hangs.
    ~CameraReader();
    CameraReader(const CameraReader&) = delete;
    CameraReader& operator=(const CameraReader&) = delete;

    /// The next picture; nothing when none came for `seconds`, the camera sends no more or failed, or at `stop`.
    /// Throws what opening threw.
    std::optional<CameraPicture> next(double seconds, const std::stop_token& stop);
    /// As CameraDevice::frameRate(), once a picture came; before that 0.
    double frameRate() const;

 private:
    struct Shared;
    CameraPatience patience_;
    std::shared_ptr<Shared> shared_;  ///< with the thread
};

}  // namespace eyrie
