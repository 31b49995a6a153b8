#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace eyrie {

static_assert(std::endian::native == std::endian::little, "model files are little-endian");

/// Collects the bytes of a model file; numbers little-endian.
class ByteWriter {
 public:
    template <class T>
    void put(T value) {
        static_assert(std::is_arithmetic_v<T>);
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        bytes_.append(raw, sizeof(T));
    }
    template <class T>
    void putAll(std::span<const T> values) {
        put(static_cast<std::uint64_t>(values.size()));
        for (const T value : values) put(value);
    }
    template <class T>
    void putAll(const std::vector<T>& values) {
        putAll(std::span<const T>(values));
    }
    void putText(std::string_view text) {
        put(static_cast<std::uint64_t>(text.size()));
        bytes_.append(text);
    }
    const std::string& bytes() const { return bytes_; }

 private:
    std::string bytes_;
};

/// Reads them back from a file that nobody vouches for: every size is checked against what is left before memory is
/// taken for it. Throws Error(input) naming the file and what is wrong with it.
class ByteReader {
 public:
    /// `bytes` must outlive the reader; `name` is the file for messages.
    ByteReader(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

    template <class T>
    T get() {
        static_assert(std::is_arithmetic_v<T>);
        require(sizeof(T));
        T value;
        std::memcpy(&value, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return value;
    }
    /// A float that must be a finite number.
    float getFinite();
    /// An int in `low` … `high`; `what` names it in the message.
    int getInt(int low, int high, const char* what);
    /// At most `largest` values.
    template <class T>
    std::vector<T> getAll(std::size_t largest, const char* what) {
        const std::size_t count = getCount(largest, sizeof(T), what);
        std::vector<T> values(count);
        if (count > 0) std::memcpy(values.data(), bytes_.data() + at_, count * sizeof(T));
        at_ += count * sizeof(T);
        return values;
    }
    /// Finite floats, exactly `count`.
    std::vector<float> getFiniteAll(std::size_t count, const char* what);
    std::string getText(std::size_t largest, const char* what);
    std::size_t left() const { return bytes_.size() - at_; }
    /// Throws Error(input): "<file>: the classifier model is damaged (<why>); …".
    [[noreturn]] void damaged(const std::string& why) const;

 private:
    void require(std::size_t count) const;
    std::size_t getCount(std::size_t largest, std::size_t item_bytes, const char* what);

    std::string_view bytes_;
    std::string name_;
    std::size_t at_ = 0;
};

/// 64-bit FNV-1a: finds accidental damage.
std::uint64_t checksum(std::string_view bytes);

}  // namespace eyrie
