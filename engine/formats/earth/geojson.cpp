#include <nlohmann/json.hpp>

#include "core/time/utc_time.h"
#include "formats/earth/placed_tracks.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

/// GeoJSON (RFC 7946): a feature a track, a LineString of the middles of its boxes, or a Point where there is but one;
/// longitude before latitude, WGS 84. Properties: track, class, score, first_frame, last_frame, frames (of each
/// position), seconds, times (UTC, where known), mean_speed_km_h.
namespace eyrie {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDecimals = 7;  ///< of degrees: about a centimetre

double rounded(double value, int decimals) {
    return parseReal(fixedText(value, decimals)).value_or(0);
}

Json positionOf(const GeoPoint& place) {
    return Json::array({rounded(place.longitude_deg, kDecimals), rounded(place.latitude_deg, kDecimals)});
}

void writeGeoJson(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions& options,
                  ExportReport& report) {
    const TrackWorld& world = neededPlaces(labels, path, "GeoJSON");
    PlacedTracks placed(labels);
    AtomicFileWriter file(path);
    file.write("{\"type\": \"FeatureCollection\", \"name\": " + Json(options.sequence).dump() + ", \"features\": [");
    const char* separator = "\n";
    placed.visit([&](int id, const std::vector<PlacedBox>& boxes) {
        Json positions = Json::array(), frames = Json::array(), seconds = Json::array(), times = Json::array();
        double speed = 0;
        int speeds = 0;
        for (const PlacedBox& one : boxes) {
            positions.push_back(positionOf(one.place));
            frames.push_back(one.box->frame);
            seconds.push_back(rounded(world.seconds(one.box->frame), 3));
            if (one.utc_us) times.push_back(utcTextToMilliseconds(*one.utc_us));
            const GroundState state = groundStateOf(&world, *one.box);
            if (!state.speed_km_h) continue;
            speed += *state.speed_km_h;
            ++speeds;
        }
        Json properties{{"track", id}};
        if (!boxes.front().box->object_class.empty()) properties["class"] = boxes.front().box->object_class;
        properties["score"] = rounded(boxes.front().box->score, 6);
        properties["first_frame"] = boxes.front().box->frame;
        properties["last_frame"] = boxes.back().box->frame;
        if (speeds > 0) properties["mean_speed_km_h"] = rounded(speed / speeds, 2);
        properties["frames"] = std::move(frames);
        properties["seconds"] = std::move(seconds);
        if (times.size() == boxes.size()) properties["times"] = std::move(times);
        const bool one = positions.size() == 1;
        const Json feature{
            {"type", "Feature"},
            {"id", id},
            {"geometry",
             {{"type", one ? "Point" : "LineString"}, {"coordinates", one ? positions.front() : std::move(positions)}}},
            {"properties", std::move(properties)}};
        file.write(separator + feature.dump(-1, ' ', false, Json::error_handler_t::replace));
        separator = ",\n";
    });
    file.write("\n]}\n");
    file.finish();
    report.files.push_back(path);
    placed.tell(report);
}

}  // namespace

LabelFormat geoJsonFormat() {
    LabelFormat format;
    format.info = {"geojson", "GeoJSON (paths on the earth)", {"geojson"}, false, false, true, {}};
    format.info.carries = {.id = true, .object_class = true, .score = true};
    format.info.tells_world = true;
    format.needs_id = true;
    format.write = writeGeoJson;
    format.files = [](const std::filesystem::path& path, const ExportOptions&) {
        return std::vector<ExportFile>{{path, FileKind::json}};
    };
    return format;
}

}  // namespace eyrie
