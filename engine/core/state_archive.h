#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/values/ids.h"

/// What stages of the chain remember between frames, as bytes and back. Each such class has one member
/// `template <class Archive> void transfer(Archive&)` that names what it remembers; the same lines write and read, so
/// that they cannot differ. Pictures of the video are not written but named, and taken from the video again.
namespace eyrie {

static_assert(std::endian::native == std::endian::little, "kept states are little-endian");

/// Thrown while a state is read that no writer wrote.
struct DamagedState {
    std::string what;
};

/// Thrown while a state is read when the video's picture is not the one that the state was made with.
struct ChangedPicture {
    FrameIndex frame = 0;
};

/// The grey picture of a frame. Throws Error(input) when it cannot be read.
using PictureSource = std::function<cv::Mat(FrameIndex)>;

/// Finds accidental damage and exchanged pictures; quick.
std::uint64_t checksumOf(std::string_view bytes);
std::uint64_t checksumOf(const cv::Mat& gray);  ///< CV_8UC1

template <class T>
concept PlainNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// The containers and values that both directions share.
template <class Archive>
class StateTransfer {
 public:
    /// Writes or reads one after the other.
    template <class... Values>
    void operator()(Values&... values) {
        (one(values), ...);
    }
    /// An enumeration that ends with `last`.
    template <class Enum>
    void word(Enum& value, Enum last) {
        auto number = static_cast<std::int32_t>(value);
        one(number);
        require(number >= 0 && number <= static_cast<std::int32_t>(last), "an unknown word");
        value = static_cast<Enum>(number);
    }
    /// A container whose items cannot be made without arguments: `make` gives one to be read into.
    template <class Container, class Make>
    void items(Container& container, Make make) {
        const std::size_t count = self().count(container.size());
        if constexpr (Archive::reading) {
            container.clear();
            for (std::size_t i = 0; i < count; ++i) {
                container.push_back(make());
                one(container.back());
            }
        } else {
            for (auto& item : container) one(item);
        }
    }
    /// Refuses what was read; says nothing while writing.
    void require(bool right, const char* what) const {
        if (Archive::reading && !right) throw DamagedState{what};
    }

 private:
    Archive& self() { return static_cast<Archive&>(*this); }

    template <PlainNumber T>
    void one(T& value) {
        self().numbers(&value, 1);
    }
    void one(bool& value) {
        auto byte = static_cast<std::uint8_t>(value);
        one(byte);
        require(byte <= 1, "a switch that is neither on nor off");
        value = byte != 0;
    }
    template <class T>
    void one(cv::Point_<T>& point) {
        (*this)(point.x, point.y);
    }
    template <class T>
    void one(cv::Size_<T>& size) {
        (*this)(size.width, size.height);
    }
    template <class T, int rows, int columns>
    void one(cv::Matx<T, rows, columns>& matrix) {
        self().numbers(matrix.val, std::size_t(rows * columns));
    }
    template <class T, std::size_t count>
    void one(std::array<T, count>& values) {
        for (T& value : values) one(value);
    }
    void one(std::string& text) {
        text.resize(self().count(text.size()));
        self().numbers(text.data(), text.size());
    }
    template <class T>
    void one(std::vector<T>& values) {
        if constexpr (PlainNumber<T>) {
            values.resize(self().count(values.size(), sizeof(T)));
            self().numbers(values.data(), values.size());
        } else {
            items(values, [] { return T(); });
        }
    }
    template <class T>
    void one(std::deque<T>& values) {
        items(values, [] { return T(); });
    }
    template <class Key, class Value>
    void one(std::map<Key, Value>& entries) {
        std::size_t left = self().count(entries.size());
        if constexpr (Archive::reading) {
            entries.clear();
            for (; left > 0; --left) {
                Key key{};
                Value value{};
                (*this)(key, value);
                entries.insert_or_assign(key, std::move(value));
            }
        } else {
            for (auto& [key, value] : entries) {
                Key copy = key;
                (*this)(copy, value);
            }
        }
    }
    template <class T>
    void one(std::optional<T>& value) {
        bool there = value.has_value();
        one(there);
        if constexpr (Archive::reading) {
            value.reset();
            if (there) value.emplace();
        }
        if (value) one(*value);
    }
    /// A matrix of its own, not a picture of the video.
    void one(cv::Mat& matrix) {
        int type = matrix.type();
        cv::Size size = matrix.size();
        (*this)(type, size);
        if constexpr (Archive::reading) {
            require(type == CV_8UC1 || type == CV_32SC1, "a matrix of a strange type");
            require(size.width >= 0 && size.height >= 0, "a matrix of negative size");
            self().requireLeft(std::size_t(size.width) * CV_ELEM_SIZE(type), std::size_t(size.height));
            matrix.create(size, type);
        }
        for (int row = 0; row < size.height; ++row) {
            self().numbers(matrix.ptr<std::uint8_t>(row), std::size_t(size.width) * CV_ELEM_SIZE(type));
        }
    }
    template <class T>
    requires requires(T& value, Archive& archive) { value.transfer(archive); }
    void one(T& value) { value.transfer(self()); }
    template <class T>
    requires requires(T& value, Archive& archive) { transfer(archive, value); }
    void one(T& value) {
        transfer(self(), value);  // found beside the type
    }
};

/// Collects a state.
class StateWriter : public StateTransfer<StateWriter> {
 public:
    static constexpr bool reading = false;

    template <PlainNumber T>
    void numbers(const T* values, std::size_t count) {
        bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(T));
    }
    std::size_t count(std::size_t items, std::size_t /*item_bytes*/ = 1);
    /// Names a picture of the video, CV_8UC1, which must stay as it is until bytes().
    cv::Mat picture(FrameIndex& frame, const cv::Mat& gray);
    /// All that was written.
    std::string bytes() const;

 private:
    std::string bytes_;
    std::map<FrameIndex, cv::Mat> pictures_;
};

/// Reads a state that nobody vouches for: no size is believed before as much is there. Throws DamagedState,
/// ChangedPicture and what the picture source throws.
class StateReader : public StateTransfer<StateReader> {
 public:
    static constexpr bool reading = true;

    /// `bytes` must outlive the reader.
    StateReader(std::string_view bytes, PictureSource pictures);

    template <PlainNumber T>
    void numbers(T* values, std::size_t count) {
        requireLeft(count, sizeof(T));
        if (count > 0) std::memcpy(values, bytes_.data(), count * sizeof(T));
        bytes_.remove_prefix(count * sizeof(T));
    }
    /// A number of items, each of at least `item_bytes`.
    std::size_t count(std::size_t ignored, std::size_t item_bytes = 1);
    void requireLeft(std::size_t items, std::size_t item_bytes) const;
    /// The picture that was named, shared by all who ask.
    cv::Mat picture(FrameIndex& frame, const cv::Mat& ignored);
    /// To be called after everything was read.
    void end() const;

 private:
    void readPictures();

    std::string_view bytes_;
    PictureSource source_;
    std::map<FrameIndex, std::uint64_t> known_;
    std::map<FrameIndex, cv::Mat> pictures_;
};

}  // namespace eyrie
