#include "core/parameter.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/text.h"

namespace eyrie {
namespace {

std::string textOf(double value) {
    char buffer[64];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return error == std::errc() ? std::string(buffer, end) : std::to_string(value);
}

template <class Number>
bool readNumber(const std::string& text, Number& value) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stop == end;
}

class Lister : public ParameterVisitor {
 public:
    std::vector<Parameter> found;

    void real(const std::string& name, const ParameterEffect& effect, double& value, double min, double max,
              const ParameterText& text) override {
        found.push_back({name, effect, ParameterKind::real, min, max, {}, text, textOf(value)});
    }
    void integer(const std::string& name, const ParameterEffect& effect, int& value, int min, int max,
                 const ParameterText& text) override {
        found.push_back(
            {name, effect, ParameterKind::integer, double(min), double(max), {}, text, std::to_string(value)});
    }
    void flag(const std::string& name, const ParameterEffect& effect, bool& value, const ParameterText& text) override {
        found.push_back({name, effect, ParameterKind::flag, 0, 1, {}, text, value ? "true" : "false"});
    }
    void choice(const std::string& name, const ParameterEffect& effect, int& index,
                const std::vector<std::string>& names, const ParameterText& text) override {
        found.push_back({name, effect, ParameterKind::choice, 0, double(names.size()) - 1, names, text,
                         names.at(static_cast<std::size_t>(index))});
    }
    void words(const std::string& name, const ParameterEffect& effect, std::string& value,
               const ParameterText& text) override {
        found.push_back({name, effect, ParameterKind::words, 0, 0, {}, text, value});
    }
};

class Setter : public ParameterVisitor {
 public:
    Setter(const std::string& name, const std::string& text) : name_(name), text_(text) {}
    bool found = false;
    bool accepted = false;

    void real(const std::string& name, const ParameterEffect&, double& value, double min, double max,
              const ParameterText&) override {
        double read = 0;
        if (!matches(name) || !readNumber(text_, read) || !std::isfinite(read) || read < min || read > max) return;
        value = read;
        accepted = true;
    }
    void integer(const std::string& name, const ParameterEffect&, int& value, int min, int max,
                 const ParameterText&) override {
        int read = 0;
        if (!matches(name) || !readNumber(text_, read) || read < min || read > max) return;
        value = read;
        accepted = true;
    }
    void flag(const std::string& name, const ParameterEffect&, bool& value, const ParameterText&) override {
        if (!matches(name)) return;
        const bool yes = text_ == "true" || text_ == "on" || text_ == "yes" || text_ == "1";
        const bool no = text_ == "false" || text_ == "off" || text_ == "no" || text_ == "0";
        if (yes || no) value = yes;
        accepted = yes || no;
    }
    void choice(const std::string& name, const ParameterEffect&, int& index, const std::vector<std::string>& names,
                const ParameterText&) override {
        if (!matches(name)) return;
        const auto at = std::find(names.begin(), names.end(), text_);
        if (at == names.end()) return;
        index = static_cast<int>(at - names.begin());
        accepted = true;
    }
    void words(const std::string& name, const ParameterEffect&, std::string& value, const ParameterText&) override {
        if (!matches(name)) return;
        value = text_;
        accepted = true;
    }

 private:
    bool matches(const std::string& name) {
        const bool same = name == name_;
        found = found || same;
        return same;
    }
    const std::string& name_;
    const std::string& text_;
};

}  // namespace

std::string Parameter::expected() const {
    switch (kind) {
        case ParameterKind::flag:
            return "true or false";
        case ParameterKind::choice: {
            std::string list = "one of: ";
            for (std::size_t i = 0; i < choices.size(); ++i) list += (i ? ", " : "") + choices[i];
            return list;
        }
        case ParameterKind::words:
            return "a text";
        case ParameterKind::integer:
        case ParameterKind::real:
            break;
    }
    return textOf(min) + ".." + textOf(max) + (text.unit.empty() ? "" : " " + text.unit);
}

std::vector<Parameter> listParameters(const Describe& describe) {
    Lister lister;
    describe(lister);
    return std::move(lister.found);
}

void setParameter(const Describe& describe, const std::string& name, const std::string& value) {
    Setter setter(name, value);
    describe(setter);
    if (setter.accepted) return;
    const auto known = listParameters(describe);
    if (setter.found) {
        const auto at = std::find_if(known.begin(), known.end(), [&](const Parameter& p) { return p.name == name; });
        const auto point = withDecimalPoint(value);
        throw Error(ErrorKind::parameter, name + " = " + value + ", expected " + at->expected() +
                                              (point ? "; write " + *point + " with a decimal point" : ""));
    }
    std::string nearest;
    std::size_t best = std::numeric_limits<std::size_t>::max();
    for (const auto& parameter : known) {
        const std::size_t distance = editDistance(name, parameter.name);
        if (distance < best) {
            best = distance;
            nearest = parameter.name;
        }
    }
    throw Error(ErrorKind::parameter, "there is no parameter \"" + name + "\"" +
                                          (nearest.empty() ? "" : "; the nearest is \"" + nearest + "\"") +
                                          "; eyrie-cli params lists them all");
}

void setParameters(const Describe& describe, const std::vector<std::pair<std::string, std::string>>& values) {
    for (const auto& [name, value] : values) setParameter(describe, name, value);
}

}  // namespace eyrie
