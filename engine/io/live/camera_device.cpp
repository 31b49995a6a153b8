#include "io/live/camera_device.h"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>
#include <vector>

#include "core/error.h"

namespace eyrie {
namespace {

const cv::Size kWantedSize(1920, 1080);  ///< px
constexpr int kMostDamaged = 10;         ///< pictures in a row

/// A device that is open for as long as something is asked of it.
class AskedDevice {
 public:
    explicit AskedDevice(const std::string& path) : file_(::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)) {
        if (file_ < 0) reason_ = errno;
    }
    ~AskedDevice() {
        if (file_ >= 0) ::close(file_);
    }
    AskedDevice(const AskedDevice&) = delete;
    AskedDevice& operator=(const AskedDevice&) = delete;

    /// Why it was not opened, or the last request was refused (errno).
    int reason() const { return reason_; }
    bool isOpen() const { return file_ >= 0; }
    template <class Question>
    bool ask(unsigned long request, Question& question) {
        if (::ioctl(file_, request, &question) >= 0) return true;
        reason_ = errno;
        return false;
    }

 private:
    int file_;
    int reason_ = 0;
};

/// Whether a device that answered says that pictures come from it.
bool givesPictures(const v4l2_capability& says) {
    const unsigned can = (says.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? says.device_caps : says.capabilities;
    return (can & V4L2_CAP_VIDEO_CAPTURE) != 0;
}

/// "cameras that are here: /dev/video0, /dev/video2".
std::string camerasThatAreHere() {
    std::vector<std::string> found;
    std::error_code unreadable;
    for (const auto& entry : std::filesystem::directory_iterator("/dev", unreadable)) {
        const std::string path = entry.path().string();
        if (!path.starts_with("/dev/video")) continue;
        AskedDevice device(path);
        v4l2_capability says{};
        if (device.isOpen() && device.ask(VIDIOC_QUERYCAP, says) && givesPictures(says)) found.push_back(path);
    }
    if (found.empty()) return "no camera that may be used is connected; connect one and try again";
    std::sort(found.begin(), found.end());
    std::string text = "cameras that are here: ";
    for (const std::string& path : found) text += (path == found.front() ? "" : ", ") + path;
    return text;
}

[[noreturn]] void refuseCamera(const std::string& device, const std::string& why) {
    throw Error(ErrorKind::input, device + ": " + why);
}

/// OpenCV says only that a camera was not opened; the device itself says why. Answers the size of the pictures that it
/// would send, px; empty where it does not say.
cv::Size checkedCamera(const std::string& path) {
    std::error_code unknown;
    const auto status = std::filesystem::status(path, unknown);
    if (std::filesystem::exists(status) && !std::filesystem::is_character_file(status))
        refuseCamera(path, "this is no camera, nor any other device; " + camerasThatAreHere());
    AskedDevice device(path);
    if (!device.isOpen()) refuseCamera(path, whyNoCamera(device.reason()));
    v4l2_capability says{};
    if (!device.ask(VIDIOC_QUERYCAP, says)) {
        if (device.reason() == EBUSY || device.reason() == ENODEV) refuseCamera(path, whyNoCamera(device.reason()));
        refuseCamera(path, "this device is no camera; " + camerasThatAreHere());
    }
    if (!givesPictures(says))
        refuseCamera(
            path, "no pictures come from this device, as from the second one of many cameras; " + camerasThatAreHere());
    // Setting what is set already changes nothing, and is refused where somebody else receives pictures.
    v4l2_format format{};
    format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (!device.ask(VIDIOC_G_FMT, format)) return {};
    const cv::Size own(static_cast<int>(format.fmt.pix.width), static_cast<int>(format.fmt.pix.height));
    if (!device.ask(VIDIOC_S_FMT, format) && device.reason() == EBUSY) refuseCamera(path, whyNoCamera(EBUSY));
    return own;
}

class OpenCvCamera : public CameraDevice {
 public:
    OpenCvCamera(const std::string& device, cv::Size own) {
        cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
        if (!capture_.open(device, cv::CAP_V4L2))
            refuseCamera(device,
                         "no pictures that can be read come from this camera, or another program uses it; close "
                         "programs that show it and try again");
        askForPictures(capture_, own);
    }
    bool read(cv::Mat& picture) override {
        try {
            // A JPEG that was damaged on the way is left out; the camera is still there.
            for (int damaged = 0; damaged <= kMostDamaged && capture_.grab(); ++damaged)
                if (capture_.retrieve(picture) && !picture.empty()) return picture.type() == CV_8UC3;
        } catch (const cv::Exception&) {
            // It was pulled out while it was asked.
        }
        return false;
    }
    double frameRate() const override { return std::max(0.0, capture_.get(cv::CAP_PROP_FPS)); }

 private:
    cv::VideoCapture capture_;
};

}  // namespace

void askForPictures(cv::VideoCapture& camera, cv::Size own) {
    const int jpeg = cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
    // What is set is not always what is granted; the device says what it sends.
    camera.set(cv::CAP_PROP_FOURCC, jpeg);
    const bool granted = static_cast<int>(camera.get(cv::CAP_PROP_FOURCC)) == jpeg;
    const cv::Size size = granted ? kWantedSize : own;
    if (size.empty()) return;
    camera.set(cv::CAP_PROP_FRAME_WIDTH, size.width);
    camera.set(cv::CAP_PROP_FRAME_HEIGHT, size.height);
}

std::string whyNoCamera(int reason) {
    switch (reason) {
        case ENOENT:
        case ENODEV:
        case ENXIO:
            return "there is no such camera; " + camerasThatAreHere();
        case EACCES:
        case EPERM:
            return "you may not use this camera; have yourself added to the group video (sudo usermod -aG video NAME) "
                   "and log in again";
        case EBUSY:
            return "another program uses this camera; close it and try again";
        default:
            return std::string("the camera cannot be opened (") + std::strerror(reason) +
                   "); disconnect it, connect it again and try once more";
    }
}

std::unique_ptr<CameraDevice> openCamera(const std::string& device) {
    const cv::Size own = checkedCamera(device);
    return std::make_unique<OpenCvCamera>(device, own);
}

}  // namespace eyrie
