#include "core/geometry/angle.h"
#include "core/time/utc_time.h"
#include "formats/earth/placed_tracks.h"
#include "io/atomic_file.h"
#include "io/tables/csv_reader.h"
#include "io/tables/number_text.h"

/// Tracks for spreadsheets and scripts: a row a box in the order of frames, every column always there, empty where
/// nothing is known.
///   track,frame,seconds,utc,x_px,y_px,length_px,width_px,heading_deg: the box in the picture as in our own tables
///   ground,ground_x_m,ground_y_m: on the plane of the ground that the run registered; `ground` counts the stretches
///   latitude,longitude: WGS 84  speed_km_h,course_deg: of the vehicle over the ground, clockwise from north
///   length_m,width_m,class,score,origin
namespace eyrie {
namespace {

constexpr int kPlaceDecimals = 7;  ///< of degrees: about a centimetre

std::string optionalText(const std::optional<double>& value, int decimals) {
    return value ? fixedText(*value, decimals) : "";
}

std::string rowOf(const LabelBox& box, const TrackWorld* world, double rate) {
    const auto seconds = world != nullptr ? world->seconds(box.frame) : box.frame / rate;
    const auto utc = world != nullptr && world->utc_us ? world->utc_us(box.frame) : std::nullopt;
    const auto ground = world != nullptr && world->ground ? world->ground(box.frame, box.box.centre) : std::nullopt;
    const auto place = world != nullptr && world->place ? world->place(box.frame, box.box.centre) : std::nullopt;
    const GroundState state = groundStateOf(world, box);
    const double heading = degreesFromRadians(box.box.heading);
    std::string row = (box.id ? std::to_string(*box.id) : "") + ',' + std::to_string(box.frame) + ',' +
                      fixedText(seconds, 6) + ',' + (utc ? utcText(*utc) : "");
    for (const double px : {box.box.centre.x, box.box.centre.y, box.box.length, box.box.width})
        row += ',' + fixedText(px, 4);
    row += ',' + fixedText(heading, 4) + ',';
    if (ground)
        row += std::to_string(ground->stretch) + ',' + fixedText(ground->metres.x, 3) + ',' +
               fixedText(ground->metres.y, 3);
    else
        row += ",,";
    row += ',';
    row += place
               ? fixedText(place->latitude_deg, kPlaceDecimals) + ',' + fixedText(place->longitude_deg, kPlaceDecimals)
               : ",";
    return row + ',' + optionalText(state.speed_km_h, 2) + ',' + optionalText(state.course_deg, 1) + ',' +
           optionalText(state.length_m, 2) + ',' + optionalText(state.width_m, 2) + ',' + csvField(box.object_class) +
           ',' + fixedText(box.score, 6) + ',' + originText(box) + '\n';
}

void writeTracksCsv(const LabelStream& labels, const std::filesystem::path& path, const ExportOptions&,
                    ExportReport& report) {
    const TrackWorld* world = labels.about.world.get();
    const double rate = labels.about.frame_rate_hz.value_or(kAssumedRate_hz);
    AtomicFileWriter file(path);
    file.write(
        "track,frame,seconds,utc,x_px,y_px,length_px,width_px,heading_deg,ground,ground_x_m,ground_y_m,latitude,"
        "longitude,speed_km_h,course_deg,length_m,width_m,class,score,origin\n");
    labels.frames([&](FrameIndex, const std::vector<LabelBox>& boxes) {
        for (const LabelBox& box : boxes) file.write(rowOf(box, world, rate));
    });
    file.finish();
    report.files.push_back(path);
    std::erase_if(report.losses, [](const ExportLoss& loss) { return loss.kind == LossKind::velocity; });
    tellWorld(world, report);
    if (world == nullptr || !world->ground)
        report.notes.push_back("columns in metres are empty: the scale is not known; run again with --gsd");
    if (world == nullptr && !labels.about.frame_rate_hz) tellAssumedRate(report);
}

}  // namespace

LabelFormat tracksCsvFormat() {
    LabelFormat format;
    format.info = {"tracks-csv", "Tracks with UTC, metres and km/h (CSV)", {"csv"}, false, false, true, {}};
    format.info.carries = {.rotation = true, .id = true, .object_class = true, .score = true};
    format.info.tells_world = true;
    format.write_frames = writeTracksCsv;
    return format;
}

}  // namespace eyrie
