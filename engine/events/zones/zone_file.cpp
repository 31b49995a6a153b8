#include "events/zones/zone_file.h"

#include <algorithm>
#include <set>
#include <string>

#include "core/error.h"
#include "core/text.h"
#include "core/values/last_frame.h"
#include "formats/json_xml/json_place.h"
#include "io/atomic_file.h"

namespace eyrie {
namespace {

constexpr int kZoneFormat = 1;
constexpr std::size_t kMostZones = 1000;
constexpr std::size_t kMostPoints = 10000;

/// Words that nobody reads were misspelt.
void refuseOtherKeys(const JsonPlace& place, const std::vector<std::string>& known) {
    if (!place.value().is_object()) place.fail("is not an object");
    for (const auto& item : place.value().items()) {
        if (std::find(known.begin(), known.end(), item.key()) != known.end()) continue;
        const auto nearest = nearestWord(item.key(), known);
        place.fail("\"" + validUtf8(item.key()) + "\" is not known here" +
                   (nearest ? "; did you mean \"" + *nearest + "\"?" : ""));
    }
}

// In the order of their enumerators.
const std::vector<std::string> kShapeWords = {"area", "line", "arrow"};

/// Which of the words stands there; the first where nothing does.
std::size_t choiceOf(const JsonPlace& zone, const char* key, const std::vector<std::string>& words) {
    if (!zone.has(key)) return 0;
    const JsonPlace place = zone.at(key);
    const std::string word = place.text();
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) {
        std::string all;
        for (const std::string& each : words)
            all += (all.empty() ? "\"" : &each == &words.back() ? " or \"" : ", \"") + each + "\"";
        place.fail("is \"" + word + "\", expected " + all);
    }
    return static_cast<std::size_t>(found - words.begin());
}

Zone zoneAt(const JsonPlace& place) {
    refuseOtherKeys(place, {"name", "shape", "fixed_to", "frame", "points"});
    Zone zone;
    zone.name = place.at("name").text();
    if (zone.name.empty()) place.at("name").fail("is empty");
    zone.shape = static_cast<ZoneShape>(choiceOf(place, "shape", kShapeWords));
    zone.anchor = choiceOf(place, "fixed_to", {"ground", "image"}) == 0 ? ZoneAnchor::ground : ZoneAnchor::image;
    if (place.has("frame")) {
        zone.frame = place.at("frame").whole();
        if (zone.frame < 0 || zone.frame > kLastFrame) place.at("frame").fail("is not the number of a frame");
    }
    if (zone.anchor == ZoneAnchor::image) zone.frame = 0;  // it holds in all of them
    const JsonPlace points = place.at("points");
    if (points.size() > kMostPoints) points.fail("has more than " + std::to_string(kMostPoints) + " points");
    for (std::size_t i = 0; i < points.size(); ++i) {
        const JsonPlace point = points.at(i);
        if (point.size() != 2) point.fail("is not a point [x, y]");
        zone.points.emplace_back(point.at(std::size_t{0}).pixels(), point.at(std::size_t{1}).pixels());
    }
    const std::string fault = faultOf(zone);
    if (!fault.empty()) points.fail(fault);
    return zone;
}

}  // namespace

std::vector<Zone> readZones(const std::filesystem::path& path) {
    const nlohmann::json json = readLabelJson(path);
    const JsonPlace file(path, json);
    if (!file.has("eyrie_zones")) file.fail("holds no zones: \"eyrie_zones\" is missing");
    const JsonPlace format = file.at("eyrie_zones");
    if (format.whole() != kZoneFormat)
        format.fail("is " + std::to_string(format.whole()) + ", expected " + std::to_string(kZoneFormat));
    refuseOtherKeys(file, {"eyrie_zones", "zones"});
    const JsonPlace list = file.at("zones");
    if (list.size() == 0) list.fail("is empty");
    if (list.size() > kMostZones) list.fail("has more than " + std::to_string(kMostZones) + " zones");
    std::vector<Zone> zones;
    std::set<std::string> names;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const JsonPlace place = list.at(i);
        zones.push_back(zoneAt(place));
        if (!names.insert(zones.back().name).second)
            place.fail("is the second zone with the name \"" + zones.back().name + "\"");
    }
    return zones;
}

void writeZones(const std::filesystem::path& path, const std::vector<Zone>& zones) {
    constexpr auto kReplace = nlohmann::ordered_json::error_handler_t::replace;
    std::string text = "{\"eyrie_zones\": " + std::to_string(kZoneFormat) + ", \"zones\": [";
    for (std::size_t i = 0; i < zones.size(); ++i) {
        const Zone& zone = zones[i];
        nlohmann::ordered_json json;
        json["name"] = zone.name;
        json["shape"] = kShapeWords.at(static_cast<std::size_t>(zone.shape));
        json["fixed_to"] = zone.anchor == ZoneAnchor::image ? "image" : "ground";
        if (zone.anchor == ZoneAnchor::ground) json["frame"] = zone.frame;
        for (const cv::Point2d& point : zone.points) json["points"].push_back({point.x, point.y});
        text += (i == 0 ? "\n  " : ",\n  ") + json.dump(-1, ' ', false, kReplace);
    }
    writeFileAtomically(path, text + "]}\n");
}

}  // namespace eyrie
