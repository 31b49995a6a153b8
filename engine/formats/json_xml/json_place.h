#pragma once

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.h"
#include "formats/tables/text_fields.h"

namespace eyrie {

/// A value together with where it stands. Places refer to the place they are in, which must outlive them.
class JsonPlace {
 public:
    JsonPlace(const std::filesystem::path& file, const nlohmann::json& value) : file_(file), value_(value) {}

    const nlohmann::json& value() const { return value_; }
    [[noreturn]] void fail(const std::string& message) const {
        const std::string place = name();
        throw Error(ErrorKind::input, file_.string() + ": " + (place.empty() ? "the file" : place) + ": " + message);
    }
    bool has(const char* key) const {
        if (!value_.is_object()) return false;
        const auto found = value_.find(key);
        return found != value_.end() && !found->is_null();
    }
    JsonPlace at(const char* key) const {
        if (!value_.is_object()) fail("is not an object");
        const auto found = value_.find(key);
        if (found == value_.end() || found->is_null()) fail(std::string("\"") + key + "\" is missing");
        return {*this, *found, key, 0};
    }
    JsonPlace at(std::size_t index) const { return {*this, value_.at(index), nullptr, index}; }
    std::size_t size() const {
        if (!value_.is_array()) fail("is not a list");
        return value_.size();
    }
    double real() const {
        if (!value_.is_number() || !std::isfinite(value_.get<double>())) fail("is not a number");
        return value_.get<double>();
    }
    double pixels() const {
        const double number = real();
        if (std::abs(number) > kLargestCoordinate) fail("lies outside any image");
        return number;
    }
    int whole() const {
        const double number = real();
        if (number != std::floor(number) || std::abs(number) > 2e9) fail("is not a whole number in range");
        return static_cast<int>(number);
    }
    std::string text() const {
        if (!value_.is_string()) fail("is not text");
        const std::string& text = value_.get_ref<const std::string&>();
        for (const char c : text) {
            if (static_cast<unsigned char>(c) < 0x20) fail("holds control characters");
        }
        return text;
    }
    /// A flag as JSON writes them: true, 1 or "true".
    bool flag() const {
        return (value_.is_boolean() && value_.get<bool>()) || (value_.is_number() && value_.get<double>() != 0) ||
               (value_.is_string() && value_.get_ref<const std::string&>() == "true");
    }

 private:
    JsonPlace(const JsonPlace& within, const nlohmann::json& value, const char* key, std::size_t index)
        : file_(within.file_), value_(value), within_(&within), key_(key), index_(index) {}
    std::string name() const {
        if (within_ == nullptr) return {};
        const std::string before = within_->name();
        if (key_ == nullptr) return before + "[" + std::to_string(index_) + "]";
        return before.empty() ? key_ : before + "." + key_;
    }

    const std::filesystem::path& file_;
    const nlohmann::json& value_;
    const JsonPlace* within_ = nullptr;
    const char* key_ = nullptr;  ///< none: `index_` counts
    std::size_t index_ = 0;
};

/// The JSON of a file of labels. NaN and Infinity, which some programs write though JSON has no such numbers, become
/// null. Throws Error(input) for what is no JSON or nested deeper than labels ever are.
nlohmann::json readLabelJson(const std::filesystem::path& path);

}  // namespace eyrie
