#include "learning/models/byte_stream.h"

#include <cmath>

#include "core/error.h"

namespace eyrie {

void ByteReader::damaged(const std::string& why) const {
    throw Error(ErrorKind::input, name_ + ": the classifier model is damaged (" + why +
                                      "); get a fresh copy or train it again with eyrie-cli train");
}

void ByteReader::require(std::size_t count) const {
    if (left() < count) damaged("it ends too early, at byte " + std::to_string(bytes_.size()));
}

std::size_t ByteReader::getCount(std::size_t largest, std::size_t item_bytes, const char* what) {
    const auto count = get<std::uint64_t>();
    if (count > largest) damaged(std::string(what) + ": " + std::to_string(count) + " is too many");
    require(static_cast<std::size_t>(count) * item_bytes);
    return static_cast<std::size_t>(count);
}

float ByteReader::getFinite() {
    const auto value = get<float>();
    if (!std::isfinite(value)) damaged("a number is not finite");
    return value;
}

int ByteReader::getInt(int low, int high, const char* what) {
    const auto value = get<std::int32_t>();
    if (value < low || value > high) damaged(std::string(what) + " is " + std::to_string(value));
    return value;
}

std::vector<float> ByteReader::getFiniteAll(std::size_t count, const char* what) {
    auto values = getAll<float>(count, what);
    if (values.size() != count) damaged(std::string(what) + ": too few values");
    for (const float value : values) {
        if (!std::isfinite(value)) damaged(std::string(what) + ": a number is not finite");
    }
    return values;
}

std::string ByteReader::getText(std::size_t largest, const char* what) {
    const std::size_t count = getCount(largest, 1, what);
    std::string text(bytes_.substr(at_, count));
    at_ += count;
    return text;
}

std::uint64_t checksum(std::string_view bytes) {
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const char byte : bytes) {
        hash ^= static_cast<unsigned char>(byte);
        hash *= 0x100000001b3ULL;
    }
    return hash;
}

}  // namespace eyrie
