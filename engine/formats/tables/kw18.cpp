#include <algorithm>

#include "formats/earth/placed_tracks.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

/// KW18: blanks between columns, "#" begins a comment, pixels from 0, frames as the source counts them.
///   1 track id  2 states of the track  3 frame  4-5 plane x,y  6-7 velocity  8-9 image x,y  10-13
///   left,top,right,bottom 14 area  15-17 longitude, latitude, 0 (0 0 0: not known)  18 seconds since 1970 where the
///   clock time is known, else of the video   [19 confidence | 19 object type, 20 activity]
namespace eyrie {
namespace {

constexpr int kKw18Decimals = 4;

LabelFile readKw18(const std::filesystem::path& path, const ImportOptions&) {
    LabelFile labels;
    std::map<int, int> declared;
    std::map<int, int> met;
    int typed = 0;
    forEachLine(path, ' ', '#', [&](const TextLine& line) {
        if (line.size() < 18 || line.size() > 20) {
            line.fail(0, std::to_string(line.size()) + " columns, expected the 18 to 20 of KW18");
        }
        LabelBox record;
        record.id = line.identity(0);
        declared[*record.id] = line.integer(1, "length of the track");
        ++met[*record.id];
        record.frame = line.frame(2, 0);
        record.velocity = {line.pixels(5, "velocity x"), line.pixels(6, "velocity y")};
        for (const std::size_t unused : {3, 4, 7, 8, 13, 14, 15, 16, 17}) line.number(unused, "number");
        record.box = boxByCorners(line, 9, 0);
        if (line.size() == 19) record.score = line.number(18, "confidence");
        typed += line.size() == 20;
        labels.boxes[record.frame].push_back(std::move(record));
    });
    int wrong = 0;
    for (const auto& [id, length] : declared) wrong += length != met.at(id);
    if (wrong > 0) labels.notes.push_back(counted(wrong, "track has", "tracks have") + " another length than declared");
    if (typed > 0) labels.notes.push_back("types and activities (columns 19 and 20) are not kept");
    return labels;
}

/// Columns 15 to 18.
std::string worldText(const TrackWorld* world, const LabelBox& box, double rate) {
    constexpr int kDegreeDecimals = 8;
    if (world == nullptr) return " 0 0 0 " + fixedText(box.frame / rate, 6);
    const auto place = world->place ? world->place(box.frame, box.box.centre) : std::nullopt;
    const auto utc = world->utc_us ? world->utc_us(box.frame) : std::nullopt;
    return (place ? ' ' + fixedText(place->longitude_deg, kDegreeDecimals) + ' ' +
                        fixedText(place->latitude_deg, kDegreeDecimals) + " 0 "
                  : " 0 0 0 ") +
           fixedText(utc ? static_cast<double>(*utc) / 1e6 : world->seconds(box.frame), 6);
}

void writeKw18(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions&, ExportReport& report) {
    const auto tracks = boxesById(labels.boxes);
    bool scored = false;
    for (const auto& [id, track] : tracks) {
        for (const LabelBox* record : track) scored = scored || record->score != 1;
    }
    std::string text =
        "# 1:Track-id 2:Track-length 3:Frame-number 4-5:Tracking-plane-loc(x,y) 6-7:velocity(x,y) 8-9:Image-loc(x,y) "
        "10-13:Img-bbox(TL_x,TL_y,BR_x,BR_y) 14:Area 15-17:World-loc(x,y,z) 18:timestamp";
    text += scored ? " 19:confidence\n" : "\n";
    AtomicFileWriter file(path);
    file.write(text);
    const double rate = labels.frame_rate_hz.value_or(kAssumedRate_hz);
    const auto number = [](double value) { return ' ' + fixedText(value, kKw18Decimals); };
    for (const auto& [id, track] : tracks) {
        for (const LabelBox* record : track) {
            const BoxEdges e = edgesOf(record->box, 0);
            text = std::to_string(id) + ' ' + std::to_string(track.size()) + ' ' + std::to_string(record->frame) +
                   " 0 0" + number(record->velocity.x) + number(record->velocity.y) + number(e.left + e.width / 2) +
                   number(e.top + e.height / 2) + number(e.left) + number(e.top) + number(e.left + e.width) +
                   number(e.top + e.height) + number(e.width * e.height) +
                   worldText(labels.world.get(), *record, rate) + (scored ? ' ' + fixedText(record->score, 6) : "") +
                   '\n';
            file.write(text);
        }
    }
    file.finish();
    report.files.push_back(path);
    std::erase_if(report.losses, [](const ExportLoss& loss) { return loss.kind == LossKind::velocity; });
    tellWorld(labels.world.get(), report);
    if (!labels.frame_rate_hz && !labels.world) tellAssumedRate(report);
}

}  // namespace

LabelFormat kw18Format() {
    LabelFormat format;
    format.info = {"kw18", "KW18", {"kw18", "trk"}, false, true, true, {}};
    format.info.carries = {.id = true, .score = true};
    format.info.tells_world = true;
    format.needs_id = true;
    format.read = readKw18;
    format.write = writeKw18;
    format.fits = [](const FileHead& head) {
        for (const std::string& line : head.lines) {
            if (line[line.find_first_not_of(" \t")] == '#') continue;
            const std::size_t columns = TextLine(head.path, 1, line, ' ').size();
            return columns >= 18 && columns <= 20 && leadingNumbers(line, ' ').size() >= 18;
        }
        return false;
    };
    return format;
}

}  // namespace eyrie
