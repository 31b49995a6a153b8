#include <algorithm>

#include "core/text.h"
#include "core/time/utc_time.h"
#include "formats/earth/placed_tracks.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

/// KML 2.2: a placemark a track, on the ground. Where every position has a time, as gx:Track (of Google's extension
/// that came with KML 2.2), which can be played; else as LineString, or as Point where there is but one.
namespace eyrie {
namespace {

constexpr int kKmlDecimals = 7;  ///< of degrees: about a centimetre

std::string degrees(double value) {
    return fixedText(value, kKmlDecimals);
}

std::string timedTrack(const std::vector<PlacedBox>& boxes) {
    std::string text = "<gx:Track><altitudeMode>clampToGround</altitudeMode>\n";
    for (const PlacedBox& one : boxes) text += "<when>" + utcTextToMilliseconds(*one.utc_us) + "</when>";
    text += '\n';
    for (const PlacedBox& one : boxes)
        text +=
            "<gx:coord>" + degrees(one.place.longitude_deg) + ' ' + degrees(one.place.latitude_deg) + " 0</gx:coord>";
    return text + "\n</gx:Track>";
}

std::string plainPath(const std::vector<PlacedBox>& boxes) {
    const bool one = boxes.size() == 1;
    std::string text = one ? "<Point><coordinates>" : "<LineString><tessellate>1</tessellate><coordinates>";
    for (std::size_t i = 0; i < boxes.size(); ++i)
        text += (i > 0 ? " " : "") + degrees(boxes[i].place.longitude_deg) + ',' + degrees(boxes[i].place.latitude_deg);
    return text + (one ? "</coordinates></Point>" : "</coordinates></LineString>");
}

void writeKml(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions& options,
              ExportReport& report) {
    neededPlaces(labels, path, "KML");
    PlacedTracks placed(labels);
    AtomicFileWriter file(path);
    file.write(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\" "
        "xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n<Document><name>" +
        markupEscaped(options.sequence) +
        "</name>\n<Style id=\"track\"><LineStyle><color>ff14a0de</color><width>3</width></LineStyle></Style>\n");
    placed.visit([&](int id, const std::vector<PlacedBox>& boxes) {
        const LabelBox& first = *boxes.front().box;
        const bool timed = boxes.size() > 1 && std::all_of(boxes.begin(), boxes.end(),
                                                           [](const PlacedBox& one) { return one.utc_us.has_value(); });
        file.write("<Placemark id=\"track-" + std::to_string(id) + "\"><name>" + std::to_string(id) +
                   "</name><description>" +
                   markupEscaped((first.object_class.empty() ? "" : first.object_class + ", ") + "frames " +
                                 std::to_string(first.frame) + " to " + std::to_string(boxes.back().box->frame) +
                                 ", score " + fixedText(first.score, 2)) +
                   "</description><styleUrl>#track</styleUrl>" + (timed ? timedTrack(boxes) : plainPath(boxes)) +
                   "</Placemark>\n");
    });
    file.write("</Document>\n</kml>\n");
    file.finish();
    report.files.push_back(path);
    placed.tell(report);
}

}  // namespace

LabelFormat kmlFormat() {
    LabelFormat format;
    format.info = {"kml", "KML (paths on the earth)", {"kml"}, false, false, true, {}};
    format.info.carries = {.id = true, .object_class = true, .score = true};
    format.info.tells_world = true;
    format.needs_id = true;
    format.write = writeKml;
    format.files = [](const std::filesystem::path& path, const ExportOptions&) {
        return std::vector<ExportFile>{{path, FileKind::xml}};
    };
    return format;
}

}  // namespace eyrie
