// Reading what values a swept parameter takes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "core/error.h"
#include "io/tables/number_text.h"
#include "sweep/plan/sweep_plan.h"

namespace eyrie {
namespace {

constexpr double kMostValues = 1e7;

[[noreturn]] void refuse(const std::string& axis, const std::string& why) {
    throw Error(ErrorKind::parameter, axis + ": " + why);
}

std::vector<std::string> splitAt(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (;;) {
        const std::size_t end = text.find(separator, begin);
        parts.emplace_back(trimmed(std::string_view(text).substr(begin, end - begin)));
        if (end == std::string::npos) return parts;
        begin = end + 1;
    }
}

/// A number as somebody would write it: sums of steps carry rounding errors in their last digits.
std::string tidyText(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.12g", value);
    return shortestText(parseReal(text).value_or(value) + 0.0);
}

std::vector<std::string> rangeValues(const std::string& name, const std::vector<std::string>& parts) {
    const std::string spec = parts[0] + ":" + parts[1] + ":" + parts[2];
    const auto from = parseReal(parts[0]);
    const auto step = parseReal(parts[1]);
    const auto to = parseReal(parts[2]);
    if (!from || !step || !to)
        refuse(name, "the range " + spec + " is not FIRST:STEP:LAST in numbers, e.g. 0.05:0.01:0.5");
    if (*step == 0) refuse(name, "the range " + spec + " has a step of 0 and never ends");
    const double steps = std::floor((*to - *from) / *step + 1e-9);
    if (steps < 0) {
        refuse(name, "the range " + spec + " is empty: from " + parts[0] + " steps of " + parts[1] +
                         " lead away from " + parts[2]);
    }
    if (!(steps < kMostValues)) refuse(name, "the range " + spec + " has more than ten million values");
    std::vector<std::string> values;
    for (int i = 0; i <= static_cast<int>(steps); ++i) values.push_back(tidyText(*from + i * *step));
    return values;
}

}  // namespace

double countValues(const std::string& text) {
    const std::string spec(trimmed(std::string_view(text).substr(text.find('=') + 1)));
    if (spec.empty()) return 0;
    const std::vector<std::string> parts = splitAt(spec, ':');
    if (parts.size() != 3) return static_cast<double>(splitAt(spec, ',').size());
    const auto from = parseReal(parts[0]);
    const auto step = parseReal(parts[1]);
    const auto to = parseReal(parts[2]);
    if (!from || !step || !to || *step == 0) return 0;
    return std::max(0.0, std::floor((*to - *from) / *step + 1e-9) + 1);
}

SweepAxis parseAxis(const std::string& text, const ChainOptions& base) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
        refuse("\"" + text + "\"",
               "expected NAME=FIRST:STEP:LAST or NAME=VALUE,VALUE,…, e.g. gradient.quantile=0.05:0.01:0.5");
    SweepAxis axis;
    axis.name = std::string(trimmed(std::string_view(text).substr(0, equals)));
    const std::string spec(trimmed(std::string_view(text).substr(equals + 1)));

    ChainOptions options = base;
    const auto known = listParameters(describeOf(options));
    const auto declared =
        std::find_if(known.begin(), known.end(), [&](const Parameter& p) { return p.name == axis.name; });
    if (declared == known.end()) setParameter(describeOf(options), axis.name, "");  // tells the nearest known name
    const bool number = declared->kind == ParameterKind::real || declared->kind == ParameterKind::integer;
    if (spec.empty()) refuse(axis.name, "there is no value to try; give FIRST:STEP:LAST or a list");

    const std::vector<std::string> parts = splitAt(spec, ':');
    if (number && parts.size() == 3) {
        axis.values = rangeValues(axis.name, parts);
    } else if (number && parts.size() != 1) {
        refuse(axis.name, spec + " is neither a range FIRST:STEP:LAST nor a list of values");
    } else {
        axis.values = splitAt(spec, ',');
    }
    // Of a range the ends tell whether all is within the limits, and the first step whether all are whole numbers.
    const bool range = number && parts.size() == 3;
    std::set<std::string> seen;
    for (std::size_t i = 0; i < axis.values.size(); ++i) {
        std::string& value = axis.values[i];
        if (!range || i < 2 || i + 1 == axis.values.size())
            setParameter(describeOf(options), axis.name, value);  // out of range, or not read
        // As the chain itself would write it, so that "on" and "true" are one value.
        if (range) continue;
        if (number) {
            value = tidyText(*parseReal(value));
        } else if (declared->kind == ParameterKind::flag) {
            value = value == "true" || value == "on" || value == "yes" || value == "1" ? "true" : "false";
        }
        if (!seen.insert(value).second) refuse(axis.name, "the value " + value + " is there twice");
    }
    return axis;
}

}  // namespace eyrie
