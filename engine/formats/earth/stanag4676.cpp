#include <limits>

#include "core/time/utc_time.h"
#include "formats/earth/placed_tracks.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

/// NATO ISR tracks as XML after STANAG 4676 Edition B (AEDP-12), as far as it is publicly known; its schema is not
/// public, so conformance was not checked. Elements of the namespace urn:nato:niia:stanag:4676:isrtrackingstandard:b:1:
///   nitsRoot: msgCreatedTime, nitsVersion (B.1), message
///   message: baseTime, relTimeIncrement (0.000001 s), track …
///   track: lid, segment; segment: tp …; tp: relTime, dynamics (cs="WGS_84"), whose pos is latitude, longitude, height
/// Heights are what the metadata say of the ground in the middle of the frame, 0 where they say nothing. There is no
/// confidentiality label: whoever passes the file on has to add one.
namespace eyrie {
namespace {

constexpr int kDegreeDecimals = 8;

void writeStanag4676(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions&,
                     ExportReport& report) {
    const TrackWorld& world = neededPlaces(labels, path, "STANAG 4676");
    neededTimes(labels, path, "STANAG 4676");
    PlacedTracks placed(labels, true);
    std::int64_t base = std::numeric_limits<std::int64_t>::max();
    placed.visit([&](int, const std::vector<PlacedBox>& boxes) {
        for (const PlacedBox& one : boxes) base = std::min(base, *one.utc_us);
    });
    if (base == std::numeric_limits<std::int64_t>::max()) base = world.utc_us(0).value_or(0);
    AtomicFileWriter file(path);
    file.write(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<nitsRoot xmlns=\"urn:nato:niia:stanag:4676:isrtrackingstandard:b:1\">\n<msgCreatedTime>" +
        nowUtc() + "</msgCreatedTime>\n<nitsVersion>B.1</nitsVersion>\n<message>\n<baseTime>" + utcText(base) +
        "</baseTime>\n<relTimeIncrement>0.000001</relTimeIncrement>\n");
    int without_height = 0, above_sea = 0;
    placed.visit([&](int id, const std::vector<PlacedBox>& boxes) {
        file.write("<track>\n<lid>" + std::to_string(id) + "</lid>\n<segment>\n");
        for (const PlacedBox& one : boxes) {
            const auto height = world.height ? world.height(one.box->frame) : std::nullopt;
            without_height += height ? 0 : 1;
            above_sea += height && !height->ellipsoid ? 1 : 0;
            file.write("<tp><relTime>" + std::to_string(*one.utc_us - base) +
                       "</relTime><dynamics cs=\"WGS_84\"><pos>" + fixedText(one.place.latitude_deg, kDegreeDecimals) +
                       ' ' + fixedText(one.place.longitude_deg, kDegreeDecimals) + ' ' +
                       fixedText(height ? height->metres : 0, 2) + "</pos></dynamics></tp>\n");
        }
        file.write("</segment>\n</track>\n");
    });
    file.write("</message>\n</nitsRoot>\n");
    file.finish();
    report.files.push_back(path);
    placed.tell(report);
    if (without_height > 0)
        report.notes.push_back(counted(without_height, "position has", "positions have") +
                               " the height 0, as the metadata give none");
    if (above_sea > 0)
        report.notes.push_back(counted(above_sea, "height is", "heights are") +
                               " above the sea and not above the ellipsoid, as the metadata give no other");
    report.notes.push_back(
        "written from what is publicly known about Edition B; not checked against its schema, and without a "
        "confidentiality label");
}

}  // namespace

LabelFormat stanag4676Format() {
    LabelFormat format;
    format.info = {"stanag4676", "STANAG 4676 XML (positions)", {"xml"}, false, false, true, {}};
    format.info.carries = {.id = true};
    format.info.tells_world = true;
    format.needs_id = true;
    format.write = writeStanag4676;
    return format;
}

}  // namespace eyrie
