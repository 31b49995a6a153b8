#include "io/tables/preset_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

namespace eyrie {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;

[[noreturn]] void refusePreset(const std::filesystem::path& path, const std::string& reason) {
    throw Error(ErrorKind::input, path.string() + ": " + reason);
}

std::string placeOf(const std::string& text, std::size_t byte) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte > 0 ? byte - 1 : 0, text.size()));
    const auto line = std::count(text.begin(), end, '\n') + 1;
    const std::size_t line_start = text.rfind('\n', byte > 1 ? byte - 2 : 0);
    const std::size_t column = line == 1 ? byte : byte - line_start - 1;
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

Json parse(const std::filesystem::path& path, const std::string& text) {
    std::vector<std::set<std::string>> names;
    const auto watch = [&](int, nlohmann::detail::parse_event_t event, Json& value) {
        using Event = nlohmann::detail::parse_event_t;
        if (event == Event::object_start) names.emplace_back();
        if (event == Event::object_end) names.pop_back();
        if (event == Event::key && !names.back().insert(value.get<std::string>()).second)
            refusePreset(path, "\"" + value.get<std::string>() + "\" is there twice");
        return true;
    };
    try {
        return Json::parse(text, watch);
    } catch (const nlohmann::json::parse_error& error) {
        refusePreset(path,
                     placeOf(text, error.byte) + ": this is not JSON; look for a missing comma, quote or bracket");
    } catch (const nlohmann::json::exception&) {
        refusePreset(path, "a number of this file is out of range");
    }
}

std::string valueText(const std::filesystem::path& path, const std::string& name, const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
    if (value.is_number_integer()) return value.dump();
    if (value.is_number()) return shortestText(value.get<double>());
    refusePreset(path, "parameters: " + name + " = " + value.dump() + ", expected a number, true, false or a text");
}

/// Numbers and truth values as such, if they read back as the same text.
Json jsonOf(const std::string& text) {
    if (text == "true" || text == "false") return text == "true";
    const Json number = Json::parse(text, nullptr, false);
    if (number.is_number_integer() && number.dump() == text) return number;
    if (number.is_number_float() && parseReal(text) && shortestText(*parseReal(text)) == text) return number;
    return text;
}

}  // namespace

Preset readPreset(const std::filesystem::path& path) {
    const Json root = parse(path, readWholeFile(path));
    if (!root.is_object() || !root.contains("eyrie_preset"))
        refusePreset(path, "this is not a preset: \"eyrie_preset\" is missing");
    const Json& format = root["eyrie_preset"];
    if (!format.is_number_integer() || format.get<std::int64_t>() < 1)
        refusePreset(path, "eyrie_preset = " + format.dump() + ", expected " + std::to_string(kFormat));
    if (format.get<std::int64_t>() > kFormat)
        refusePreset(path, "eyrie_preset = " + format.dump() + " is newer than this program knows; update Eyrie");

    Preset preset;
    if (root.contains("name")) {
        if (!root["name"].is_string()) refusePreset(path, "name = " + root["name"].dump() + ", expected a text");
        preset.name = root["name"].get<std::string>();
    }
    if (!root.contains("parameters") || !root["parameters"].is_object())
        refusePreset(path, "\"parameters\" is missing or not an object of names and values");
    for (const auto& [name, value] : root["parameters"].items())
        preset.values.emplace_back(name, valueText(path, name, value));
    return preset;
}

void writePreset(const std::filesystem::path& path, const Preset& preset) {
    Json root;
    root["eyrie_preset"] = kFormat;
    root["name"] = preset.name;
    Json& parameters = root["parameters"] = Json::object();
    for (const auto& [name, value] : preset.values) parameters[name] = jsonOf(value);
    writeFileAtomically(path, root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace eyrie
