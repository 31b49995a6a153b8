#include "scene/painting/sensor.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "scene/random.h"

namespace eyrie {
namespace {

/// Digits of `index` in the base, mirrored at the point: evenly spread numbers in [0, 1).
double mirrored(int index, int base) {
    double value = 0;
    double digit = 1.0 / base;
    for (; index > 0; index /= base) {
        value += digit * (index % base);
        digit /= base;
    }
    return value;
}

/// From uniform to a triangle over [−radius, radius].
double triangular(double uniform, double radius) {
    return uniform < 0.5 ? radius * (std::sqrt(2 * uniform) - 1) : radius * (1 - std::sqrt(2 * (1 - uniform)));
}

/// Nearly normal with deviation 1 from 64 random bits: the sum of their bytes.
float normalFrom(std::uint32_t a, std::uint32_t b) {
    const auto bytes = [](std::uint32_t v) { return (v & 255) + ((v >> 8) & 255) + ((v >> 16) & 255) + (v >> 24); };
    return (static_cast<float>(bytes(a) + bytes(b)) - 1020.0F) * (1.0F / 209.02F);
}

cv::Mat grayOf(const cv::Mat& colour) {
    cv::Mat gray(colour.size(), CV_8UC1);
    for (int y = 0; y < colour.rows; ++y) {
        const auto* from = colour.ptr<cv::Vec3b>(y);
        auto* to = gray.ptr<std::uint8_t>(y);
        for (int x = 0; x < colour.cols; ++x) {
            to[x] = static_cast<std::uint8_t>((114 * from[x][0] + 587 * from[x][1] + 299 * from[x][2] + 500) / 1000);
        }
    }
    return gray;
}

cv::Mat compressed(const cv::Mat& image, int quality) {
    std::vector<std::uint8_t> bytes;
    if (!cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality})) {
        throw Error(ErrorKind::internal, "A rendered frame could not be compressed as JPEG.");
    }
    return cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
}

/// What sticks to the image: levels added to each pixel (columns, pixels, clouds of shading), and shares taken by dirt.
struct Sticking {
    cv::Mat levels;  ///< CV_32F, empty: none
    cv::Mat left;    ///< CV_32F, share of light that passes, empty: all

    Sticking(cv::Size size, const Sensor& sensor, std::uint32_t seed) {
        if (sensor.fixed_pattern > 0) addPattern(size, static_cast<float>(sensor.fixed_pattern), seed);
        if (sensor.smudges > 0) addSmudges(size, sensor.smudges, seed);
    }

 private:
    void addPattern(cv::Size size, float deviation, std::uint32_t seed) {
        levels.create(size, CV_32FC1);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const auto column = static_cast<std::uint32_t>(x);
                const auto row = static_cast<std::uint32_t>(y);
                const std::uint32_t a = hashOf(column, 1, seed);
                const std::uint32_t b = hashOf(column, row, seed + 1);
                levels.at<float>(y, x) =
                    deviation * (0.6F * normalFrom(a, hashOf(a, 2, seed)) + 0.5F * normalFrom(b, hashOf(b, 3, seed)) +
                                 1.6F * fractalNoise(x / 150.0, y / 150.0, seed + 2, 3));
            }
        }
    }

    void addSmudges(cv::Size size, int count, std::uint32_t seed) {
        left = cv::Mat(size, CV_32FC1, cv::Scalar(1));
        Random random(seed * 31 + 7);
        for (int i = 0; i < count; ++i) {
            const double radius = random.uniform(3, 14);
            const double x0 = random.uniform(0, size.width);
            const double y0 = random.uniform(0, size.height);
            const double dark = random.uniform(0.05, 0.22);
            for (int y = std::max(0, static_cast<int>(y0 - radius)); y < std::min<double>(size.height, y0 + radius);
                 ++y) {
                for (int x = std::max(0, static_cast<int>(x0 - radius)); x < std::min<double>(size.width, x0 + radius);
                     ++x) {
                    const double away = ((x - x0) * (x - x0) + (y - y0) * (y - y0)) / (radius * radius);
                    if (away < 1) left.at<float>(y, x) *= static_cast<float>(1 - dark * (1 - away));
                }
            }
        }
    }
};

}  // namespace

std::vector<PassSample> passesOf(const Sensor& sensor) {
    const int count = sensor.samples;
    // The pixel's own area has the variance 1/12; a triangle of radius r has r²/6.
    const double radius = std::sqrt(6 * (1.0 / 12 + sensor.blur_px * sensor.blur_px));
    std::vector<PassSample> passes;
    for (int i = 0; i < count; ++i) {
        PassSample pass;
        pass.offset.x = triangular((i + 0.5) / count, radius);
        pass.offset.y = triangular(mirrored(i, 2) + 0.5 / count, radius);
        pass.moment = sensor.exposure * (((i * 7 + 3) % count + 0.5) / count - 0.5);
        passes.push_back(pass);
    }
    return passes;
}

Frame develop(const cv::Mat& light, const Sensor& sensor, std::uint32_t seed, FrameIndex moment) {
    const int width = light.cols;
    const int height = light.rows;
    cv::Mat picture(height, width, sensor.gray ? CV_8UC1 : CV_8UC3);
    const auto contrast = static_cast<float>(sensor.contrast * (1 - sensor.haze));
    const auto level = static_cast<float>(sensor.level + sensor.haze * 40);
    const float corner = 4.0F / static_cast<float>(width * width + height * height);
    const auto frame_seed = hashOf(static_cast<std::uint32_t>(moment), seed, 0x5EED);
    const auto read_variance = static_cast<float>(sensor.read_noise * sensor.read_noise);
    const auto shot_variance = static_cast<float>(sensor.shot_noise * sensor.shot_noise);
    const int channels = picture.channels();
    const Sticking sticking(light.size(), sensor, seed);
    for (int y = 0; y < height; ++y) {
        const auto* from = light.ptr<cv::Vec3f>(y);
        auto* to = picture.ptr<std::uint8_t>(y);
        const float dy = static_cast<float>(y) - static_cast<float>(height - 1) / 2;
        for (int x = 0; x < width; ++x) {
            const float dx = static_cast<float>(x) - static_cast<float>(width - 1) / 2;
            float shade = 1 - static_cast<float>(sensor.vignette) * (dx * dx + dy * dy) * corner;
            if (!sticking.left.empty()) shade *= sticking.left.at<float>(y, x);
            const float stuck = sticking.levels.empty() ? 0 : sticking.levels.at<float>(y, x);
            for (int channel = 0; channel < channels; ++channel) {
                const float scene =
                    channels == 1 ? 0.114F * from[x][0] + 0.587F * from[x][1] + 0.299F * from[x][2] : from[x][channel];
                float value = std::clamp((level + contrast * (scene - 120)) * shade + stuck, 0.0F, 255.0F);
                const float deviation = std::sqrt(read_variance + shot_variance * value);
                const auto place = static_cast<std::uint32_t>((y * width + x) * 3 + channel);
                const std::uint32_t bits = hashOf(place, frame_seed, 77);
                value += deviation * normalFrom(bits, hashOf(bits, place, 78));
                to[x * channels + channel] = static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
            }
        }
    }
    if (sensor.jpeg_quality > 0) picture = compressed(picture, sensor.jpeg_quality);
    Frame frame;
    if (sensor.gray) {
        frame.gray = picture;
        frame.colour.create(height, width, CV_8UC3);
        for (int y = 0; y < height; ++y) {
            const auto* from = picture.ptr<std::uint8_t>(y);
            auto* to = frame.colour.ptr<cv::Vec3b>(y);
            for (int x = 0; x < width; ++x) to[x] = {from[x], from[x], from[x]};
        }
    } else {
        frame.colour = picture;
        frame.gray = grayOf(picture);
    }
    return frame;
}

}  // namespace eyrie
