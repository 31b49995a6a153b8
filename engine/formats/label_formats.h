#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "formats/label_file.h"
#include "formats/label_stream.h"
#include "io/file_kind.h"

/// Import and export of labels in every format that peers use; columns and conventions of each are told beside its
/// functions. Reading ends with labels or an Error(input) that names file and place, whatever the bytes are.
namespace eyrie {

/// How a file of labels is read.
struct ImportOptions {
    std::map<std::string, std::string> class_map;  ///< from a class of the file to one of ours
    int frame_shift = 0;                           ///< added to every frame
    double scale = 1;                              ///< multiplies all lengths, about the corner of the first pixel
    std::optional<cv::Size> image_size;            ///< before scaling; for formats relative to the image (YOLO)
    /// Of the video they are for, where it is known: what keyframes span far behind its end is not filled in.
    std::optional<int> frame_count;
    /// Columns of the user's own table (format "columns"), such as "frame,id,cname,x1,y1,x2,y2".
    std::string columns;
    std::optional<int> first_frame_number;  ///< "columns" only: number of a video's first frame, otherwise 0
    std::optional<double>
        first_pixel_edge;  ///< "columns" (otherwise 0) and MOTChallenge (otherwise 1; 0 with labels.txt)
    std::string sequence;  ///< which video of a KWCOCO file with several
};

/// How labels are written.
struct ExportOptions {
    std::optional<cv::Size> image_size;  ///< instead of LabelFile's
    std::optional<int> frame_count;
    std::optional<double> frame_rate_hz;
    std::string sequence = "sequence";  ///< name of the video or sequence
    std::string columns;                ///< as in ImportOptions
    std::optional<int> first_frame_number;
    std::optional<double> first_pixel_edge;
    std::optional<bool> clip;         ///< cut corners at the image's border: otherwise only YOLO-OBB does, which must
    bool unrotated_bounds = false;    ///< COCO, KWCOCO: `bbox` is the unrotated box, as DIVE reads it
    std::string benchmark = "EYRIE";  ///< TrackEval tree: <benchmark>-<split>
    std::string split = "train";
    std::string tracker;  ///< TrackEval tree: write the boxes as this tracker's result instead of as truth
};

/// What of a box an export could not carry.
enum class LossKind { rotation, heading, class_name, occlusion, ignore, score, velocity, id, clipped, rounded, other };

/// Something an export could not carry.
struct ExportLoss {
    LossKind kind = LossKind::other;
    int boxes = 0;
    std::string remark;  ///< a whole sentence, number included
};

/// What was written, and what of the labels the format could not hold.
struct ExportReport {
    std::string format;
    int boxes = 0;
    std::vector<std::filesystem::path> files;  ///< written; of folders with a file per frame the folder
    std::vector<ExportLoss> losses;
    std::vector<std::string> notes;  ///< worth knowing, one sentence each

    void add(LossKind kind, int count, const std::string& remark_after_number);
    int lost(LossKind kind) const;
};

/// What a format can say of a box.
struct Carries {
    bool rotation = false;
    bool id = false;
    bool object_class = false;
    bool occlusion = false;
    bool ignore = false;
    bool score = false;
};

/// A format as lists and menus show it.
struct LabelFormatInfo {
    std::string name;   ///< word for the command line
    std::string title;  ///< for people
    std::vector<std::string> extensions;
    bool folder = false;  ///< export makes a folder
    bool reads = true;
    bool writes = true;
    Carries carries;
    bool tells_world = false;  ///< writes places on the earth or clock times where LabelFile::world knows them
};

/// All of them, in the order of sniffing.
const std::vector<LabelFormatInfo>& labelFormats();

/// What the names of files with labels look like, for dialogs: "*.csv *.xml".
std::string labelFilePatterns();

/// The format that a file or folder seems to have. Throws Error(input) when it is missing or none fits, naming what was
/// looked at.
std::string sniffLabelFormat(const std::filesystem::path& path);

/// Reads labels; format "auto" sniffs. Then classes are mapped, frames shifted and lengths scaled. Throws Error(input)
/// "file:place: …" for anything malformed and Error(parameter) for an unknown format or a missing option.
LabelFile readLabels(const std::filesystem::path& path, const std::string& format = "auto",
                     const ImportOptions& options = {});

/// A file that an export writes.
struct ExportFile {
    std::filesystem::path path;
    FileKind kind = FileKind::text;
    bool grows = false;  ///< lines are added to what is there
};

/// Every file that writeLabels may write that can exist already, for io/output_files.h to judge before it does. Texts
/// of single images are not among them: folders that hold such are refused. Throws Error(parameter) for an unknown
/// format.
std::vector<ExportFile> filesToWrite(const std::filesystem::path& path, const std::string& format,
                                     const ExportOptions& options = {});

/// Writes labels and says what the format could not carry. Existing folders of labels are refused, existing files
/// replaced whole. Throws Error(output), and Error(parameter) for an unknown format or a missing option.
ExportReport writeLabels(LabelFile labels, const std::filesystem::path& path, const std::string& format,
                         const ExportOptions& options = {});
/// The same for labels frame by frame, which are gone through several times. Formats of one text with a line a box hold
/// no more than a frame of them; CVAT, which goes by object, some 50 bytes a box; the others hold all. Throws
/// Error(output) when it was stopped before the first file was in its place, which leaves nothing behind; later, what
/// was begun is completed.
ExportReport writeLabels(const LabelStream& labels, const std::filesystem::path& path, const std::string& format,
                         const ExportOptions& options = {}, const std::stop_token& stop = {});

}  // namespace eyrie
