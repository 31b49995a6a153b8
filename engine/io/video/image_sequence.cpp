#include "io/video/image_sequence.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/folder.h"
#include "io/tables/size_text.h"

namespace eyrie {

namespace {

constexpr std::array kExtensions = {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".pgm", ".bmp"};

std::string lowerExtension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

/// The JPEG reader fills what is missing with grey and says nothing; a whole file has an end mark behind its last scan.
bool isCutJpeg(const std::string& bytes) {
    if (bytes.size() < 2 || bytes[0] != '\xFF' || bytes[1] != '\xD8') return false;
    const std::size_t scan = bytes.rfind("\xFF\xDA");
    const std::size_t end = bytes.rfind("\xFF\xD9");
    return scan == std::string::npos || end == std::string::npos || end < scan;
}

/// 8 or 16 bit, grey or blue-green-red.
cv::Mat decode(const std::filesystem::path& file) {
    const std::string bytes = readWholeFile(file);
    const std::string broken =
        file.string() +
        ": the image cannot be read; it is damaged, cut off or of another kind: copy it again or "
        "take it away";
    if (bytes.empty())
        throw Error(ErrorKind::input, file.string() + ": the image file is empty; copy it again or take it away");
    if (isCutJpeg(bytes)) throw Error(ErrorKind::input, broken);
    cv::Mat image;
    try {
        const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
        image = cv::imdecode(encoded, cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR);
    } catch (const cv::Exception&) {
        throw Error(ErrorKind::input, broken);
    }
    if (image.empty()) throw Error(ErrorKind::input, broken);
    if (image.depth() != CV_8U && image.depth() != CV_16U)
        throw Error(ErrorKind::input, file.string() + ": images must have 8 or 16 bit; convert them to 16 bit");
    if (image.channels() == 4) cv::cvtColor(image, image, cv::COLOR_BGRA2BGR);
    if (image.channels() != 1 && image.channels() != 3)
        throw Error(ErrorKind::input, file.string() + ": images must have one or three channels, this one has " +
                                          std::to_string(image.channels()) + "; convert them to grey or colour");
    return image;
}

/// Values of a 16 bit image that become black and white; see ImageSequence.
std::pair<double, double> rangeOf(const cv::Mat& image) {
    std::vector<int> histogram(65536, 0);
    for (int y = 0; y < image.rows; ++y) {
        const std::uint16_t* row = image.ptr<std::uint16_t>(y);
        for (int i = 0; i < image.cols * image.channels(); ++i) ++histogram[row[i]];
    }
    const auto pixels = static_cast<double>(image.total()) * image.channels();
    const auto quantile = [&](double share) {
        double below = 0;
        for (int value = 0; value < 65536; ++value) {
            below += histogram[static_cast<std::size_t>(value)];
            if (below > share * pixels) return value;
        }
        return 65535;
    };
    const double low = quantile(0.001);
    const double high = quantile(0.999);
    if (high - low < 16) return {0, 65535};  // a blank image tells nothing
    const int brightest = quantile(1 - 0.5 / pixels);
    int bits = 8;
    while (bits < 16 && brightest >= 1 << bits) bits += 2;
    const double full = (1 << bits) - 1;
    if (high - low >= full / 4) return {0, full};
    const double centre = (low + high) / 2;
    return {std::max(0.0, centre - (high - low)), centre + (high - low)};
}

}  // namespace

std::vector<std::filesystem::path> imagesIn(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const std::filesystem::path& file : entriesOf(folder))
        if (ImageSequence::isImageFile(file) && isFile(file)) files.push_back(file);
    if (files.empty())
        throw Error(ErrorKind::input,
                    folder.string() + ": the folder holds no images; expected png, jpg, tif, pgm or bmp files");
    std::sort(files.begin(), files.end(),
              [](const auto& a, const auto& b) { return naturalOrder(a.filename().string(), b.filename().string()); });
    return files;
}

bool naturalOrder(const std::string& a, const std::string& b) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        if (!isDigit(a[i]) || !isDigit(b[j])) {
            if (a[i] != b[j]) return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[j]);
            ++i;
            ++j;
            continue;
        }
        while (i < a.size() && a[i] == '0') ++i;
        while (j < b.size() && b[j] == '0') ++j;
        std::size_t a_end = i;
        std::size_t b_end = j;
        while (a_end < a.size() && isDigit(a[a_end])) ++a_end;
        while (b_end < b.size() && isDigit(b[b_end])) ++b_end;
        if (a_end - i != b_end - j) return a_end - i < b_end - j;
        const int order = a.compare(i, a_end - i, b, j, b_end - j);
        if (order != 0) return order < 0;
        i = a_end;
        j = b_end;
    }
    const std::size_t a_rest = a.size() - i;
    const std::size_t b_rest = b.size() - j;
    return a_rest != b_rest ? a_rest < b_rest : a < b;  // equal but for leading zeros: any fixed order will do
}

bool ImageSequence::isImageFile(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    return !name.empty() && name.front() != '.' &&
           std::find(kExtensions.begin(), kExtensions.end(), lowerExtension(path)) != kExtensions.end();
}

ImageSequence::ImageSequence(const std::filesystem::path& path, const SourceOptions& options) {
    info_.path = std::filesystem::absolute(path).lexically_normal();
    if (!info_.path.has_filename()) info_.path = info_.path.parent_path();
    files_ = isFolder(info_.path) ? imagesIn(info_.path) : std::vector<std::filesystem::path>{info_.path};
    const cv::Mat first = decode(files_.front());
    if (first.depth() == CV_16U) std::tie(black_, white_) = rangeOf(first);
    info_.size = first.size();
    info_.frame_count = static_cast<int>(files_.size());
    if (const double rate = overridingRate(options, info_.frame_rate_hz); rate > 0) info_.frame_rate_hz = rate;
    info_.frame_rate_assumed = !(options.frame_rate_hz > 0 || options.remembered_rate_hz > 0);
    info_.is_image_sequence = true;
    info_.codec = lowerExtension(files_.front()).substr(1) + " sequence";
    info_.container = "folder";
}

void ImageSequence::checkIndex(FrameIndex index) const {
    if (index < 0 || index >= info_.frame_count)
        throw Error(ErrorKind::input, info_.path.string() + ": there is no frame " + std::to_string(index) +
                                          "; the sequence has frames 0 to " + std::to_string(info_.frame_count - 1));
}

std::int64_t ImageSequence::timeOf(FrameIndex index) const {
    checkIndex(index);
    return std::llround(index * 1e6 / info_.frame_rate_hz);
}

bool ImageSequence::hasGrown() const noexcept {
    try {
        return isFolder(info_.path) && imagesIn(info_.path).size() > files_.size();
    } catch (const std::exception&) {
        return false;  // it is gone
    }
}

Frame ImageSequence::read(FrameIndex index, bool with_colour) {
    checkIndex(index);
    const std::filesystem::path& file = files_[static_cast<std::size_t>(index)];
    cv::Mat image = decode(file);
    if (image.size() != info_.size)
        throw Error(ErrorKind::input, file.string() + ": frame " + std::to_string(index) + " is " +
                                          sizeText(image.size()) + " px, the sequence began with " +
                                          sizeText(info_.size) + " px; all images of a folder must have one size");
    if (image.depth() == CV_16U) {
        const double gain = 255.0 / (white_ - black_);
        image.convertTo(image, CV_8U, gain, -black_ * gain);
    }
    Frame frame;
    frame.index = index;
    frame.time_us = timeOf(index);
    if (image.channels() == 1) {
        frame.gray = image;
        if (with_colour) cv::cvtColor(image, frame.colour, cv::COLOR_GRAY2BGR);
    } else {
        cv::cvtColor(image, frame.gray, cv::COLOR_BGR2GRAY);
        if (with_colour) frame.colour = image;
    }
    return frame;
}

}  // namespace eyrie
