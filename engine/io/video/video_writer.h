#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

namespace eyrie {

/// How a video is encoded.
struct VideoWriterOptions {
    double frame_rate_hz = 25;
    std::string codec;  ///< name of an encoder, e.g. "libx264"; empty: H.264, or MPEG-4 where that is missing
    int quality = 20;   ///< constant rate factor of H.264 and H.265, 0 (lossless) … 51
    int key_frame_distance = 50;
    int b_frames = -1;            ///< largest number in a row; -1: the encoder's choice
    std::string encoder_options;  ///< "name=value:name=value", passed to the encoder
};

/// Writes images as a video; the container follows from the file's extension. The file appears under its name when it
/// is complete, so a run that is killed leaves no half video there.
class VideoWriter {
 public:
    /// All frames have this size; odd sizes are grown by a row or column. Throws Error(output).
    VideoWriter(const std::filesystem::path& path, cv::Size size, const VideoWriterOptions& options = {});
    /// Completes the file unless `finish` did; what goes wrong is lost then.
    ~VideoWriter();
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    /// CV_8UC3, blue-green-red. Shown one frame after the last one, or at `time_us` if that is given (must rise, frames
    /// closer than a millisecond fall together and are refused). Throws Error(output) when the disk is full.
    void write(const cv::Mat& image, std::int64_t time_us = -1);
    /// Writes what is outstanding. Throws Error(output).
    void finish();
    /// Leaves what was there under the name as it is; nothing more can be written. Devices and pipes keep what they
    /// got.
    void abandon();

 private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace eyrie
