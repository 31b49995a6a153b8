#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/labels/annotation.h"
#include "store/runs/packed_arrays.h"

namespace eyrie {

/// Values of labels appended to bytes.
class LabelBytesOut {
 public:
    template <class Number>
    void number(Number value) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + sizeof value);
        std::memcpy(bytes_.data() + at, &value, sizeof value);
    }
    void count(std::size_t value) { number(static_cast<std::uint32_t>(value)); }
    void text(const std::string& value);
    void keyframe(const Keyframe& value);
    /// All of an object but its keyframes.
    void header(const LabelledObject& value);
    void region(const IgnoreRegion& value);
    void mark(const ReviewMark& value);
    void objectClass(const ObjectClass& value);
    Bytes take() { return std::move(bytes_); }

 private:
    Bytes bytes_;
};

/// The same read back. What does not fit makes it `broken`; then values are defaults.
class LabelBytesIn {
 public:
    explicit LabelBytesIn(ByteView bytes) : bytes_(bytes) {}

    template <class Number>
    Number number() {
        Number value{};
        if (broken_ || bytes_.size() - at_ < sizeof value) {
            broken_ = true;
            return {};
        }
        std::memcpy(&value, bytes_.data() + at_, sizeof value);
        at_ += sizeof value;
        return value;
    }
    /// A number of things of at least `least_bytes` each, so that damaged bytes cannot ask for all memory.
    std::size_t count(std::size_t least_bytes);
    std::string text();
    Keyframe keyframe();
    LabelledObject header();
    IgnoreRegion region();
    ReviewMark mark();
    ObjectClass objectClass();

    bool broken() const { return broken_; }
    void refuse() { broken_ = true; }
    bool complete() const { return !broken_ && at_ == bytes_.size(); }
    std::size_t left() const { return bytes_.size() - at_; }

 private:
    double finite();
    template <class Enum>
    Enum word(int last) {
        const int value = number<std::uint8_t>();
        if (value > last) broken_ = true;
        return static_cast<Enum>(broken_ ? 0 : value);
    }

    ByteView bytes_;
    std::size_t at_ = 0;
    bool broken_ = false;
};

/// Bytes of one keyframe.
inline constexpr std::size_t kKeyframeBytes = 45;

}  // namespace eyrie
