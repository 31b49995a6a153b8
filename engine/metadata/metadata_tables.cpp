#include "metadata/metadata_tables.h"

#include <nlohmann/json.hpp>
#include <string>

#include "core/time/utc_time.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kRowsAtOnce = 1000;

/// "platform_heading_deg"
std::string columnName(int number) {
    std::string name = nameOfTag(number);
    for (char& c : name)
        if (c == ' ') c = '_';
    const TagInfo* info = infoOf(number);
    if (info == nullptr || info->unit[0] == '\0') return name;
    std::string unit = info->unit;
    for (char& c : unit)
        if (c == '/') c = '_';
    return name + "_" + (unit == "%" ? "percent" : unit);
}

/// A cell that holds separators or quotes is quoted.
std::string cell(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

/// Nanodegrees and nanometres: finer than any coding of the tags.
std::string valueText(double value) {
    return fixedText(value, 9);
}

Json known(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

}  // namespace

void writeMetadataCsv(const std::filesystem::path& path, const MetadataStream& stream,
                      const MetadataTimeline* timeline) {
    AtomicFileWriter file(path);
    std::vector<int> columns;
    std::string text = "packet,position,video_s,utc";
    for (const auto& [number, summary] : stream.tags) {
        const bool has_text = !summary.text.empty();
        if (number == tag::kTime || (!summary.has_numbers && !has_text)) continue;
        columns.push_back(number);
        text += "," + columnName(number);
    }
    text += "\n";
    for (std::size_t i = 0; i < stream.packets.size(); ++i) {
        const MetadataPacket& packet = stream.packets[i];
        const auto time = timeline != nullptr ? timeline->timeOf(i) : std::nullopt;
        text += std::to_string(i) + "," + (packet.position >= 0 ? std::to_string(packet.position) : "") + "," +
                (time ? fixedText(static_cast<double>(*time) / 1e6, 6) : "") + "," +
                (packet.utc_us ? utcText(*packet.utc_us) : "");
        for (const int number : columns) {
            text += ",";
            if (const auto value = packet.number(number)) {
                text += valueText(*value);
                continue;
            }
            for (const auto& [text_tag, words] : packet.texts) {
                if (text_tag != number) continue;
                text += cell(words);
                break;
            }
        }
        text += "\n";
        if (i % kRowsAtOnce != kRowsAtOnce - 1) continue;
        file.write(text);
        text.clear();
    }
    file.write(text);
    file.finish();
}

Json jsonOf(const MetadataStream& stream) {
    Json facts{{"track", stream.track.number},    {"id", stream.track.id},
               {"codec", stream.track.codec},     {"packets", stream.packets.size()},
               {"local_sets", stream.local_sets}, {"universal_sets", stream.universal_sets},
               {"other_sets", stream.other_sets}, {"damaged", stream.damaged()}};
    facts["damage"] = Json::object();
    for (std::size_t i = 0; i < stream.faults.size(); ++i)
        if (stream.faults[i] > 0) facts["damage"][klv::nameOf(static_cast<klv::Fault>(i))] = stream.faults[i];
    facts["without_checksum"] = stream.without_checksum;
    facts["without_stamp"] = stream.without_stamp;
    facts["without_time"] = stream.without_time;
    facts["clock_steps_back"] = stream.steps_back;
    facts["clock_leaps"] = stream.leaps;
    facts["first_utc"] = facts["last_utc"] = nullptr;
    for (const MetadataPacket& packet : stream.packets) {
        if (!packet.utc_us) continue;
        if (facts["first_utc"].is_null()) facts["first_utc"] = utcText(*packet.utc_us);
        facts["last_utc"] = utcText(*packet.utc_us);
    }
    facts["tags"] = Json::array();
    for (const auto& [number, summary] : stream.tags) {
        const TagInfo* info = infoOf(number);
        Json row{{"tag", number},
                 {"name", number == 0 ? "unknown item" : nameOfTag(number)},
                 {"unit", info != nullptr ? info->unit : ""},
                 {"packets", summary.packets},
                 {"unreadable", summary.unreadable}};
        if (summary.has_numbers) {
            row["least"] = summary.least;
            row["greatest"] = summary.greatest;
        }
        if (!summary.text.empty()) {
            row["text"] = summary.text;
            row["text_changes"] = summary.text_changes;
        }
        facts["tags"].push_back(row);
    }
    return facts;
}

Json jsonOf(const GroundView& view) {
    Json facts{{"gsd_m_per_px", known(view.gsd())},
               {"gsd_x_m_per_px", known(view.gsd_x_m_per_px)},
               {"gsd_y_m_per_px", known(view.gsd_y_m_per_px)},
               {"scale_source", nameOf(view.scale_source)},
               {"north_deg", known(view.north_deg)},
               {"ground_source", nameOf(view.source)},
               {"footprint", nullptr},
               {"remarks", view.remarks}};
    if (view.footprint) {
        facts["footprint"] = Json::array();
        for (const GeoPoint& corner : *view.footprint)
            facts["footprint"].push_back({{"latitude", corner.latitude_deg}, {"longitude", corner.longitude_deg}});
    }
    return facts;
}

Json jsonOf(const MetadataState& state) {
    Json facts{{"utc", state.utc_us ? Json(utcText(*state.utc_us)) : Json(nullptr)}};
    for (const auto& [number, value] : state.numbers) facts[columnName(number)] = value;
    return facts;
}

}  // namespace eyrie
