#pragma once

#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

namespace cv {
class VideoCapture;
}

namespace eyrie {

/// A camera of this machine that is open.
class CameraDevice {
 public:
    CameraDevice() = default;
    virtual ~CameraDevice() = default;
    CameraDevice(const CameraDevice&) = delete;
    CameraDevice& operator=(const CameraDevice&) = delete;

    /// Waits for the next picture, CV_8UC3, blue-green-red; false when none came in some seconds, as when it was pulled
    /// out.
    virtual bool read(cv::Mat& picture) = 0;
    /// Pictures a second as the camera says, Hz; 0: it says nothing.
    virtual double frameRate() const = 0;
};

/// Opens a device by its path. Throws Error(input).
using CameraOpener = std::function<std::unique_ptr<CameraDevice>(const std::string& device)>;

/// Opens a camera, such as /dev/video0, by Video4Linux, and asks for pictures as askForPictures() does. Throws
/// Error(input) with the device and the remedy, where there is none, it is no camera, belongs to others, is in use or
/// sends no pictures.
std::unique_ptr<CameraDevice> openCamera(const std::string& device);

/// Asks an open camera for JPEG of 1920×1080 px, of which it sends what is nearest; where it has no JPEG, for pictures
/// of its own size, `own` px (empty: not known), since large ones without compression come a few a second only.
void askForPictures(cv::VideoCapture& camera, cv::Size own);

/// Why a device could not be opened as a camera, and what to do about it, for people; `reason`: as the system says
/// (errno).
std::string whyNoCamera(int reason);

}  // namespace eyrie
