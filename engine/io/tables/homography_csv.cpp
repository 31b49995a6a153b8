#include "io/tables/homography_csv.h"

#include <cmath>
#include <map>
#include <string>

#include "io/atomic_file.h"
#include "io/tables/csv_reader.h"
#include "io/tables/number_text.h"

namespace eyrie {

namespace {

std::string elementName(int row, int column) {
    return {'h', static_cast<char>('0' + row), static_cast<char>('0' + column)};
}

}  // namespace

std::vector<Homography> readHomographyCsv(const std::filesystem::path& path, FrameIndex to_frame) {
    std::vector<std::string> required = {"frame"};
    for (int i = 0; i < 9; ++i) required.push_back(elementName(i / 3, i % 3));
    CsvReader csv(path, required);
    std::map<FrameIndex, Homography> by_frame;
    while (csv.next()) {
        Homography homography;
        homography.from_frame = csv.whole("frame");
        homography.to_frame = to_frame;
        if (homography.from_frame < 0) csv.refuse("frame", "a whole number, 0 or more");
        for (int i = 0; i < 9; ++i) homography.matrix(i / 3, i % 3) = csv.real(elementName(i / 3, i % 3));
        const double scale = homography.matrix(2, 2);
        if (std::abs(scale) < 1e-12) csv.refuse("h22", "a number other than 0");
        homography.matrix = homography.matrix * (1 / scale);
        if (std::abs(cv::determinant(homography.matrix)) < 1e-12) csv.refuse("h00", "a matrix that can be inverted");
        if (!by_frame.emplace(homography.from_frame, homography).second) csv.refuse("frame", "each frame once");
    }
    std::vector<Homography> homographies;
    for (const auto& [frame, homography] : by_frame) homographies.push_back(homography);
    return homographies;
}

void writeHomographyCsv(const std::filesystem::path& path, const std::vector<Homography>& homographies) {
    std::string text = "frame";
    for (int i = 0; i < 9; ++i) text += ',' + elementName(i / 3, i % 3);
    text += '\n';
    for (const Homography& homography : homographies) {
        text += std::to_string(homography.from_frame);
        for (int i = 0; i < 9; ++i) text += ',' + shortestText(homography.matrix(i / 3, i % 3));
        text += '\n';
    }
    writeFileAtomically(path, text);
}

}  // namespace eyrie
