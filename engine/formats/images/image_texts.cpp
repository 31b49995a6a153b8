#include "formats/images/image_texts.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "io/atomic_file.h"
#include "io/folder.h"
#include "io/tables/number_text.h"
#include "io/video/image_sequence.h"

namespace eyrie {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> textsIn(const fs::path& folder) {
    std::vector<fs::path> texts;
    for (const fs::path& file : entriesOf(folder)) {
        if (file.extension() == ".txt" && file.filename() != "classes.txt" && isFile(file)) texts.push_back(file);
    }
    std::sort(texts.begin(), texts.end(),
              [](const fs::path& a, const fs::path& b) { return naturalOrder(a.filename(), b.filename()); });
    return texts;
}

/// The folder with the texts: this one, `labels_name` in it, or the only folder in that.
fs::path textFolder(const fs::path& path, const char* labels_name) {
    fs::path folder = isFolder(path / labels_name) ? path / labels_name : path;
    if (!textsIn(folder).empty()) return folder;
    std::vector<fs::path> inner;
    for (const fs::path& entry : entriesOf(folder)) {
        if (isFolder(entry) && !textsIn(entry).empty()) inner.push_back(entry);
    }
    return inner.size() == 1 ? inner.front() : folder;
}

std::optional<int> numberAtEnd(const std::string& stem) {
    std::size_t begin = stem.size();
    while (begin > 0 && stem[begin - 1] >= '0' && stem[begin - 1] <= '9') --begin;
    if (begin == stem.size() || stem.size() - begin > 9) return std::nullopt;
    const std::optional<int> number = parseWhole(stem.substr(begin));
    return number && *number < kFrameLimit ? number : std::nullopt;
}

std::map<std::string, FrameIndex> framesOfImages(const fs::path& folder, LabelFile& labels) {
    std::vector<fs::path> images;
    for (const fs::path& file : entriesOf(folder)) {
        if (ImageSequence::isImageFile(file) && isFile(file)) images.push_back(file);
    }
    std::sort(images.begin(), images.end(),
              [](const fs::path& a, const fs::path& b) { return naturalOrder(a.filename(), b.filename()); });
    std::map<std::string, FrameIndex> frames;
    for (std::size_t i = 0; i < images.size(); ++i) {
        frames[images[i].stem().string()] = static_cast<FrameIndex>(i);
        labels.image_names[static_cast<FrameIndex>(i)] = images[i].filename().string();
    }
    if (!images.empty()) labels.frame_count = static_cast<int>(images.size());
    return frames;
}

using Quadrangle = std::array<cv::Point2d, 4>;

/// Overlap |A ∩ B| / |A ∪ B| of a box with the hull of four corners; 0 for a hull without area.
double overlapWithHull(const OrientedBox& box, const Quadrangle& corners) {
    // Relative to the first corner, as OpenCV works in single precision.
    std::vector<cv::Point2f> outline, hull, rectangle, common;
    for (const cv::Point2d& corner : corners) outline.emplace_back(corner - corners[0]);
    for (const cv::Point2d& corner : box.corners()) rectangle.emplace_back(corner - corners[0]);
    cv::convexHull(outline, hull);
    const double area = hull.size() < 3 ? 0 : cv::contourArea(hull);
    if (!(area > 0) || !(box.area() > 0)) return 0;
    const double shared = cv::intersectConvexConvex(hull, rectangle, common);
    return shared / (area + box.area() - shared);
}

/// The smallest rectangle around four corners, which lies along the axis of `like` that is nearest.
OrientedBox smallestAround(const Quadrangle& corners, const OrientedBox& like) {
    std::vector<cv::Point2f> outline;
    for (const cv::Point2d& corner : corners) outline.emplace_back(corner - corners[0]);
    const double turn = radiansFromDegrees(cv::minAreaRect(outline).angle);
    const double quarters = std::round((like.heading - turn) / (kPi / 2));
    return boxAround(corners, wrapPi(turn + quarters * (kPi / 2)));
}

/// Of a skewed outline the rectangle that covers it best: the mean one or the smallest around it.
OrientedBox bestRectangle(const Quadrangle& corners, const OrientedBox& mean) {
    const OrientedBox smallest = smallestAround(corners, mean);
    return overlapWithHull(smallest, corners) > overlapWithHull(mean, corners) ? smallest : mean;
}

}  // namespace

std::optional<fs::path> imageFolderFor(const fs::path& texts) {
    const fs::path folder = fs::absolute(texts).lexically_normal();
    const fs::path above = folder.parent_path();
    for (const fs::path& place :
         {above / "images", above / "img1", above / "img", above.parent_path() / "images" / folder.filename()}) {
        std::error_code ignored;
        if (place != folder && fs::is_directory(place, ignored)) return place;
    }
    return std::nullopt;
}

std::optional<fs::path> firstImageText(const fs::path& folder, const char* labels_name) {
    for (const fs::path& file : textsIn(textFolder(folder, labels_name))) {
        std::error_code ignored;
        if (fs::file_size(file, ignored) > 0) return file;
    }
    return std::nullopt;
}

std::vector<ImageText> findImageTexts(const fs::path& path, const char* labels_name, LabelFile& labels) {
    if (!isFolder(path)) {
        labels.notes.push_back("a text file of one image became frame 0");
        return {{path, 0}};
    }
    const fs::path folder = textFolder(path, labels_name);
    const std::vector<fs::path> files = textsIn(folder);
    if (files.empty()) throw Error(ErrorKind::input, folder.string() + ": holds no label files (*.txt)");
    std::vector<ImageText> texts;
    if (const std::optional<fs::path> images = imageFolderFor(folder)) {
        const std::map<std::string, FrameIndex> frames = framesOfImages(*images, labels);
        if (!frames.empty()) {
            for (const fs::path& file : files) {
                const auto found = frames.find(file.stem().string());
                if (found == frames.end()) {
                    throw Error(ErrorKind::input,
                                file.string() + ": there is no image of this name in " + images->string());
                }
                texts.push_back({file, found->second});
            }
            labels.notes.push_back("frames are the places of the images in " + images->string());
            return texts;
        }
    }
    std::set<int> numbers;
    for (const fs::path& file : files) {
        if (const auto number = numberAtEnd(file.stem().string())) numbers.insert(*number);
    }
    const bool numbered = numbers.size() == files.size();
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string stem = files[i].stem().string();
        const FrameIndex frame = numbered ? numberAtEnd(stem).value_or(0) : static_cast<FrameIndex>(i);
        texts.push_back({files[i], frame});
        labels.image_names[frame] = stem;
    }
    labels.notes.push_back(numbered ? "frames are the numbers at the end of the names"
                                    : "frames are the texts in the order of their names");
    return texts;
}

void makeTextFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        throw Error(ErrorKind::output, folder.string() + ": cannot be made (" + error.message() + "); choose another");
    }
    if (!textsIn(folder).empty()) {
        throw Error(ErrorKind::output, folder.string() + ": holds labels already, which would mix; name a new folder");
    }
}

void writePlainFile(const fs::path& file, const std::string& text) {
    writeFileAtomically(file, text, Durability::left_to_system);
}

std::string imageStem(const LabelFile& labels, FrameIndex frame) {
    const auto named = labels.image_names.find(frame);
    const std::string stem = named == labels.image_names.end() ? "" : fs::path(named->second).stem().string();
    const bool plain = !stem.empty() && stem.find_first_of("/\\") == std::string::npos && stem.front() != '.';
    return plain ? stem : numberedName(frame);
}

void tellFourCorners(int departures, int across, std::vector<std::string>& notes) {
    if (departures > 0)
        notes.push_back(counted(departures, "outline is", "outlines are") +
                        " no rectangle; the best fitting one was taken");
    if (across > 0)
        notes.push_back(counted(across, "box is", "boxes are") +
                        " wider than long: the first corner may not be the front left one");
}

OrientedBox boxByFourCorners(const TextLine& line, std::size_t first, cv::Point2d scale, int& departures) {
    std::array<cv::Point2d, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) {
        const double x = line.pixels(first + 2 * i, "corner's x") * scale.x;
        const double y = line.pixels(first + 2 * i + 1, "corner's y") * scale.y;
        if (std::abs(x) > kLargestCoordinate || std::abs(y) > kLargestCoordinate) {
            line.fail(first + 2 * i, "the corner lies outside any image");
        }
        corners[i] = {x - 0.5, y - 0.5};
    }
    const CornerBox found = boxFromCorners(corners);
    if (found.departure <= std::max(2.0, 0.1 * std::hypot(found.box.length, found.box.width))) return found.box;
    ++departures;
    return bestRectangle(corners, found.box);
}

std::array<cv::Point2d, 4> cornersToWrite(const OrientedBox& box, std::optional<cv::Size> clip, int& cut) {
    std::array<cv::Point2d, 4> corners = frontFirstCorners(box);
    bool moved = false;
    for (cv::Point2d& corner : corners) {
        corner += {0.5, 0.5};
        if (!clip) continue;
        const cv::Point2d inside(std::clamp(corner.x, 0.0, double(clip->width)),
                                 std::clamp(corner.y, 0.0, double(clip->height)));
        moved = moved || std::abs(inside.x - corner.x) + std::abs(inside.y - corner.y) > 1e-9;
        corner = inside;
    }
    cut += moved;
    return corners;
}

}  // namespace eyrie
