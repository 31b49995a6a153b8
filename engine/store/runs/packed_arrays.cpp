#include "store/runs/packed_arrays.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

static_assert(std::endian::native == std::endian::little, "packed arrays are written as they lie in memory");

namespace eyrie {
namespace {

constexpr float kStepsPerPixel = 16;
constexpr float kWideLimit = 1e8F;  // steps; keeps the conversion to int32 defined

template <class Value>
void put(std::byte*& at, Value value) {
    std::memcpy(at, &value, sizeof value);
    at += sizeof value;
}

template <class Value>
Value take(const std::byte*& at) {
    Value value;
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
    return value;
}

constexpr std::size_t kVectorBytes = 28;

/// Steps of 1/16 px, rounded; 0 for what is no number.
std::int32_t stepsOf(float px) {
    if (!std::isfinite(px)) return 0;
    return static_cast<std::int32_t>(std::lround(std::clamp(px * kStepsPerPixel, -kWideLimit, kWideLimit)));
}

/// Narrow coordinates hold 0 … 65,535 steps as uint16.
bool fitsNarrow(float px) {
    return !std::isfinite(px) || (px >= 0.F && px < 4095.9F);
}

}  // namespace

Bytes packMotionVectors(std::span<const MotionVector> vectors) {
    Bytes bytes(vectors.size() * kVectorBytes);
    std::byte* at = bytes.data();
    for (const MotionVector& vector : vectors) {
        put<std::int64_t>(at, vector.id);
        put(at, vector.position.x);
        put(at, vector.position.y);
        put(at, vector.velocity.x);
        put(at, vector.velocity.y);
        put<std::int32_t>(at, vector.age);
    }
    return bytes;
}

std::optional<std::vector<MotionVector>> unpackMotionVectors(ByteView bytes) {
    if (bytes.size() % kVectorBytes != 0) return std::nullopt;
    std::vector<MotionVector> vectors(bytes.size() / kVectorBytes);
    const std::byte* at = bytes.data();
    for (MotionVector& vector : vectors) {
        vector.id = take<std::int64_t>(at);
        vector.position.x = take<float>(at);
        vector.position.y = take<float>(at);
        vector.velocity.x = take<float>(at);
        vector.velocity.y = take<float>(at);
        vector.age = take<std::int32_t>(at);
    }
    return vectors;
}

Bytes packPoints(std::span<const cv::Point2f> points) {
    const bool narrow = std::all_of(points.begin(), points.end(),
                                    [](cv::Point2f point) { return fitsNarrow(point.x) && fitsNarrow(point.y); });
    const std::size_t width = narrow ? sizeof(std::uint16_t) : sizeof(std::int32_t);
    Bytes bytes(1 + points.size() * 2 * width);
    std::byte* at = bytes.data();
    put(at, static_cast<std::uint8_t>(width));
    for (const cv::Point2f& point : points) {
        for (const float px : {point.x, point.y}) {
            if (narrow) {
                // Inside 0 … 4,095.9 px rounding is adding a half and cutting.
                put(at, static_cast<std::uint16_t>(std::isfinite(px) ? px * kStepsPerPixel + 0.5F : 0.F));
            } else {
                put(at, stepsOf(px));
            }
        }
    }
    return bytes;
}

std::optional<std::vector<cv::Point2f>> unpackPoints(ByteView bytes) {
    if (bytes.empty()) return std::vector<cv::Point2f>{};
    const auto width = static_cast<std::size_t>(bytes[0]);
    const bool known = width == sizeof(std::uint16_t) || width == sizeof(std::int32_t);
    if (!known || (bytes.size() - 1) % (2 * width) != 0) return std::nullopt;
    std::vector<cv::Point2f> points((bytes.size() - 1) / (2 * width));
    const std::byte* at = bytes.data() + 1;
    const bool narrow = width == sizeof(std::uint16_t);
    for (cv::Point2f& point : points) {
        for (float* px : {&point.x, &point.y}) {
            const float steps =
                narrow ? static_cast<float>(take<std::uint16_t>(at)) : static_cast<float>(take<std::int32_t>(at));
            *px = steps / kStepsPerPixel;
        }
    }
    return points;
}

Bytes packIndices(std::span<const int> indices) {
    Bytes bytes(indices.size() * sizeof(std::int32_t));
    std::byte* at = bytes.data();
    for (const int index : indices) put<std::int32_t>(at, index);
    return bytes;
}

std::optional<std::vector<int>> unpackIndices(ByteView bytes) {
    if (bytes.size() % sizeof(std::int32_t) != 0) return std::nullopt;
    std::vector<int> indices(bytes.size() / sizeof(std::int32_t));
    const std::byte* at = bytes.data();
    for (int& index : indices) index = take<std::int32_t>(at);
    return indices;
}

}  // namespace eyrie
