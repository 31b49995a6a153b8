#pragma once

#include <gtest/gtest.h>
#include <filesystem>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "io/live/live_stream.h"
#include "io/video/frame_source.h"
#include "io/video/video_writer.h"
#include "support/error_message.h"

/// Videos whose frames carry their own number as a row of black and white fields, which survives any compression: what
/// a reader delivers can be checked without another reader.
namespace eyrie::test {

inline constexpr int kNumberBits = 10;

inline cv::Mat numberedImage(int number, cv::Size size = {160, 64}) {
    cv::Mat image(size, CV_8UC3);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            image.at<cv::Vec3b>(y, x) = {static_cast<uchar>((x + 2 * number) % 200), static_cast<uchar>(2 * y + 20),
                                         90};
    const int field = size.width / kNumberBits;
    for (int bit = 0; bit < kNumberBits; ++bit)
        cv::rectangle(image, cv::Rect(bit * field, 0, field, size.height / 2),
                      (number >> bit) & 1 ? cv::Scalar(235, 235, 235) : cv::Scalar(20, 20, 20), cv::FILLED);
    return image;
}

inline int numberIn(const cv::Mat& gray) {
    const int field = gray.cols / kNumberBits;
    int number = 0;
    for (int bit = 0; bit < kNumberBits; ++bit)
        if (gray.at<uchar>(gray.rows / 4, bit * field + field / 2) > 127) number |= 1 << bit;
    return number;
}

/// The numbers of all frames of a source; of a live one until it ends.
inline std::vector<int> numbersOf(FrameSource& source) {
    std::vector<int> numbers;
    try {
        for (FrameIndex frame = 0; frame < source.info().frame_count; ++frame)
            numbers.push_back(numberIn(source.read(frame, false).gray));
    } catch (const StreamEnded&) {
    }
    return numbers;
}

inline void writeNumberedVideo(const std::filesystem::path& path, int frames, const VideoWriterOptions& options = {},
                               cv::Size size = {160, 64}, int first_number = 0) {
    VideoWriter writer(path, size, options);
    for (int i = 0; i < frames; ++i) writer.write(numberedImage(first_number + i, size));
    writer.finish();
}

inline std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void writeBytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace eyrie::test
