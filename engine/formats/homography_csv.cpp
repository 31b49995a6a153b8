#include "formats/homography_csv.h"

#include <cmath>
#include <string>

#include "core/error.h"
#include "formats/text_fields.h"

namespace eyrie {

std::map<FrameIndex, cv::Matx33d> readHomographyCsv(const std::filesystem::path& file) {
    static const char* const names[] = {"frame", "h00", "h01", "h02", "h10", "h11", "h12", "h20", "h21", "h22"};
    std::map<FrameIndex, cv::Matx33d> homographies;
    int number = 0;
    for (const std::string& text : readTextLines(file)) {
        const TextLine line(file, ++number, text);
        if (line.blank()) continue;
        if (line.size() != 10) {
            line.fail(0, std::to_string(line.size()) + " columns, expected 10: frame,h00,h01,…,h22");
        }
        if (number == 1) {
            for (std::size_t k = 0; k < 10; ++k) {
                if (line.text(k) != names[k]) line.fail(k, std::string("expected the column name ") + names[k]);
            }
            continue;
        }
        cv::Matx33d matrix;
        for (int k = 0; k < 9; ++k) {
            const auto column = static_cast<std::size_t>(k + 1);
            matrix(k / 3, k % 3) = line.number(column, names[column]);
        }
        if (!(std::abs(cv::determinant(matrix)) > 1e-12)) line.fail(1, "this homography has no inverse");
        if (!homographies.insert({line.integer(0, "frame"), matrix}).second) line.fail(0, "this frame occurred above");
    }
    if (homographies.empty()) throw Error(ErrorKind::input, file.string() + ": holds no homography");
    return homographies;
}

}  // namespace eyrie
