#include "core/geometry/place_text.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

namespace eyrie {
namespace {

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

std::string degreesText(double degrees) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, degrees, std::chars_format::fixed, 6);
    return {text, end.ec == std::errc() ? end.ptr : text};
}

void replaceAll(std::string& text, std::string_view what, std::string_view by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
}

/// One sign each for degrees (o), minutes (') and seconds ("), and a point in decimals.
std::string plainText(std::string_view given) {
    std::string text(given);
    for (const std::string_view degree : {"°", "º"}) replaceAll(text, degree, "o");
    for (const std::string_view second : {"″", "”", "''"}) replaceAll(text, second, "\"");
    for (const std::string_view minute : {"′", "’"}) replaceAll(text, minute, "'");
    replaceAll(text, "−", "-");
    replaceAll(text, "\u00a0", " ");
    if (text.find('.') != std::string::npos) return text;
    // Commas are decimal where each of the two numbers has one.
    std::string with_points = text;
    int within = 0;
    for (std::size_t i = 1; i + 1 < text.size(); ++i) {
        if (text[i] != ',' || !isDigit(text[i - 1]) || !isDigit(text[i + 1])) continue;
        with_points[i] = '.';
        ++within;
    }
    return within == 2 ? with_points : text;
}

/// Takes coordinates off the front of a text.
class PlaceReader {
 public:
    explicit PlaceReader(std::string_view text) : rest_(text) {}

    struct Angle {
        double degrees = 0;
        char letter = '\0';  ///< N, S, E or W
    };
    std::optional<Angle> angle() {
        Angle angle;
        angle.letter = letter();
        const bool negative = take('-');
        if (!negative) take('+');
        const auto degrees = number();
        if (!degrees) return std::nullopt;
        angle.degrees = *degrees;
        if (take('o')) {
            double unit = 1;
            for (const char mark : {'\'', '"'}) {
                unit /= 60;
                const std::string_view before = rest_;
                const auto part = number();
                if (part && *part < 60 && take(mark)) {
                    angle.degrees += *part * unit;
                } else {
                    rest_ = before;
                    break;
                }
            }
        }
        if (angle.letter == '\0') angle.letter = letter();
        if (negative && angle.letter != '\0') return std::nullopt;
        if (negative || angle.letter == 'S' || angle.letter == 'W') angle.degrees = -angle.degrees;
        return angle;
    }
    bool separator() {
        const bool blank = !rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front())) != 0;
        return take(',') || take(';') || blank;
    }
    bool atEnd() {
        skipBlanks();
        return rest_.empty();
    }

 private:
    void skipBlanks() {
        while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front())) != 0) rest_.remove_prefix(1);
    }
    bool take(char wanted) {
        const std::string_view before = rest_;
        skipBlanks();
        if (!rest_.empty() && rest_.front() == wanted) {
            rest_.remove_prefix(1);
            return true;
        }
        rest_ = before;
        return false;
    }
    char letter() {
        for (const char wanted : {'N', 'S', 'E', 'W'})
            if (take(wanted) || take(static_cast<char>(wanted - 'A' + 'a'))) return wanted;
        return '\0';
    }
    std::optional<double> number() {
        skipBlanks();
        if (rest_.empty() || !isDigit(rest_.front())) return std::nullopt;
        double value = 0;
        const auto end = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value, std::chars_format::fixed);
        if (end.ec != std::errc()) return std::nullopt;
        rest_.remove_prefix(static_cast<std::size_t>(end.ptr - rest_.data()));
        return value;
    }

    std::string_view rest_;
};

bool isLongitude(char letter) {
    return letter == 'E' || letter == 'W';
}

}  // namespace

std::string placeText(const GeoPoint& place) {
    return degreesText(place.latitude_deg) + ", " + degreesText(place.longitude_deg);
}

std::optional<GeoPoint> placeOfText(std::string_view given) {
    const std::string text = plainText(given);
    PlaceReader reader(text);
    auto first = reader.angle();
    if (!first || (!reader.separator() && first->letter == '\0')) return std::nullopt;
    auto second = reader.angle();
    if (!second || !reader.atEnd()) return std::nullopt;
    if (isLongitude(first->letter)) std::swap(first, second);
    const bool latitude_last = second->letter == 'N' || second->letter == 'S';
    if (isLongitude(first->letter) || latitude_last) return std::nullopt;
    if (!(std::abs(first->degrees) <= 90) || !(std::abs(second->degrees) <= 180)) return std::nullopt;
    return GeoPoint{first->degrees, second->degrees};
}

}  // namespace eyrie
