#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "formats/label_formats.h"
#include "formats/tables/text_fields.h"

/// How one format is read, written and recognised; inside of this room only. Readers leave classes, frames and lengths
/// as the file has them (in our coordinates); writers get every box with an id where the format needs one.
namespace eyrie {

/// The beginning of a file, for recognising it.
struct FileHead {
    std::filesystem::path path;
    bool folder = false;
    std::string text;                ///< first 64 KiB without a byte order mark
    std::vector<std::string> lines;  ///< the first whole ones that are not blank, at most 20
    std::string name() const { return path.filename().string(); }
};

/// A format of labels: what is said of it, and the functions that recognise, read and write it.
struct LabelFormat {
    LabelFormatInfo info;
    bool needs_id = false;
    LabelFile (*read)(const std::filesystem::path&, const ImportOptions&) = nullptr;
    /// One of the two writes, where the format is written at all; the first needs one frame of boxes at a time.
    void (*write_frames)(const LabelStream&, const std::filesystem::path&, const ExportOptions&,
                         ExportReport&) = nullptr;
    void (*write)(const LabelFile&, const std::filesystem::path&, const ExportOptions&, ExportReport&) = nullptr;
    bool isWritten() const { return write_frames != nullptr || write != nullptr; }
    bool (*fits)(const FileHead&) = nullptr;
    /// The files of an export, where they are not just the one that was named.
    std::vector<ExportFile> (*files)(const std::filesystem::path&, const ExportOptions&) = nullptr;
};

/// All formats, in the order of sniffing; made in format_table.cpp, which alone knows their functions.
const std::vector<LabelFormat>& formatTable();

/// A box by the fields left, top, width, height from `first` on.
OrientedBox boxByEdges(const TextLine& line, std::size_t first, double first_pixel_edge);
/// A box by the fields left, top, right, bottom from `first` on.
OrientedBox boxByCorners(const TextLine& line, std::size_t first, double first_pixel_edge);

/// Boxes by id, each in ascending frames; boxes without id are left out.
std::map<int, std::vector<const LabelBox*>> boxesById(const LabelBoxes& boxes);

/// Calls `take(line)` for every line that is neither blank nor begins with `comment`.
void forEachLine(const std::filesystem::path& file, char separator, char comment,
                 const std::function<void(const TextLine&)>& take);

/// The fields of a line as far as they are numbers; for recognising formats.
std::vector<double> leadingNumbers(const std::string& line, char separator);

/// "000041" and the like; images are named so where nobody says otherwise.
std::string numberedName(FrameIndex frame);

/// The size of the image, or Error(parameter) saying that the format needs it.
cv::Size neededSize(const std::optional<cv::Size>& size, const std::filesystem::path& path, const char* format);

/// How many frames an export covers: what is known, at least up to the last box.
int framesToWrite(const LabelFile& labels);

/// The same for formats that list every image. Throws Error(parameter) when that cannot be meant.
int imagesToWrite(const LabelFile& labels, const std::filesystem::path& path);

/// Rows that a reader leaves out as they cannot be taken. For formats whose own programs are as lenient.
class LeftOutRows {
 public:
    /// `reason` tells file, place and what is wrong there. Throws it on when it is no Error(input).
    void add(const Error& reason);
    /// Says in `labels` what was left out and why. Throws Error(input) with the first reason when no box was read.
    void tell(LabelFile& labels) const;

 private:
    int count_ = 0;
    std::vector<std::string> reasons_;  ///< of the first ones
};

/// Frames per second in what is written of labels that know none.
inline constexpr int kAssumedRate_hz = 25;

/// A count with its noun: "1 box", "3 boxes".
std::string counted(int count, const char* one, const char* many);

/// The beginning of a text in quotes, for messages.
std::string inQuotes(std::string_view text);

}  // namespace eyrie
