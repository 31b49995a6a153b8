#include "diagnosis/error_csv.h"

#include "core/geometry/angle.h"
#include "io/atomic_file.h"
#include "io/tables/csv_reader.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

constexpr int kDecimals = 2;

std::string idsText(const std::vector<int>& ids) {
    std::string text;
    for (const int id : ids) {
        if (!text.empty()) text += ' ';
        text += std::to_string(id);
    }
    return text;
}

/// The numbers are those of one frame of the stretch; says of which.
std::string detailOf(const DiagnosedError& one) {
    const ResultError& error = one.error;
    if (one.text.empty() || error.first_frame == error.last_frame) return one.text;
    return "frame " + std::to_string(error.places[one.place].frame) + ": " + one.text;
}

}  // namespace

std::string errorTable(const std::vector<DiagnosedError>& errors, char separator) {
    std::string table;
    const auto row = [&](const std::vector<std::string>& fields) {
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (i > 0) table += separator;
            table += separator == ',' ? csvField(fields[i]) : fields[i];
        }
        table += '\n';
    };
    row({"kind", "first_frame", "last_frame", "count", "objects", "tracks", "frame", "x", "y", "length", "width",
         "heading", "cause", "detail", "frames_of_cause"});
    for (const DiagnosedError& one : errors) {
        const ResultError& error = one.error;
        const ErrorPlace& place = error.places[one.place];
        const OrientedBox& box = place.box;
        row({nameOf(error.kind), std::to_string(error.first_frame), std::to_string(error.last_frame),
             std::to_string(error.count()), idsText(error.objects), idsText(error.tracks), std::to_string(place.frame),
             fixedText(box.centre.x, kDecimals), fixedText(box.centre.y, kDecimals), fixedText(box.length, kDecimals),
             fixedText(box.width, kDecimals), fixedText(degreesFromRadians(box.heading), kDecimals), nameOf(one.cause),
             detailOf(one), std::to_string(one.frames_of_cause)});
    }
    return table;
}

void writeErrorCsv(const std::filesystem::path& path, const std::vector<DiagnosedError>& errors) {
    writeFileAtomically(path, errorTable(errors));
}

}  // namespace eyrie
