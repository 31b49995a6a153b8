#pragma once

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/labels/box_record.h"
#include "formats/label_stream.h"

namespace eyrie {

/// MOTChallenge text: one file per sequence, no header, frames from 1, upright boxes.
///   gt.txt     frame,id,left,top,width,height,flag,class,visibility        (flag 0: ignored)
///   result     frame,id,left,top,width,height,confidence,-1,-1,-1
///   det.txt    the same with id −1
/// Our pixels are centred at integers, so our first pixel begins at −0.5. MOTChallenge counts pixels from 1: its first
/// pixel begins at 1. A box with left = 1 and width = 1 is our pixel 0.
struct MotOptions {
    /// Where the first pixel begins in the file: 1 by the specification, 0 in UAVDT, VisDrone and most trackers'
    /// output, −0.5 where our own coordinates were written as they are.
    double first_pixel_edge = 1;
    int first_frame_number = 1;  ///< the number that the file gives to a video's first frame
    /// The classes that numbers from 1 mean, where a list of them stands beside the file as CVAT and datumaro write it;
    /// an id of 0 is none then, and a visibility of 0 only says that something hides the object.
    std::optional<std::vector<std::string>> class_list = std::nullopt;
};

/// Reads ground truth: flag 0 sets BoxRecord::ignore; a visibility of 0 means fully hidden, below 1 partly. Six to ten
/// columns; a missing flag counts as 1, a missing or negative class as none. Throws Error(input) "file:line:column: …"
/// for anything malformed, among it frames below 1, negative sizes and an id that a line above gave to another counting
/// box of the frame.
LabelBoxes readMotTruth(const std::filesystem::path& file, const MotOptions& options = {});

/// Reads tracks or detections (id −1 or lower: no id). Column 7 is the score; column 8 is a class only with a list of
/// classes. Throws as readMotTruth().
BoxesByFrame readMotResult(const std::filesystem::path& file, const MotOptions& options = {});

/// What a file could not carry.
struct MotLosses {
    int boxes = 0;
    int turned = 0;      ///< boxes of which only the enclosing upright one was written
    int classes = 0;     ///< classes without a number of their own
    int velocities = 0;  ///< boxes whose velocity was dropped
};

/// How boxes are written as lines of MOTChallenge.
struct MotWriteOptions {
    MotOptions pixels;
    /// Writes class 1 for every box that counts: TrackEval scores only class 1 when it preprocesses.
    bool every_class_one = false;
    /// Writes class 8 for every ignored box: TrackEval takes results on these out when it preprocesses.
    bool ignored_distract = false;
    int decimals = 3;  ///< of edges and sizes, at most
};

/// Writes ground truth (ignored boxes with flag 0; visibility 1, partly hidden 0.5, fully 0) through a temporary file
/// beside it. Throws Error(output) when it cannot be written and Error(input) for a box without an id.
MotLosses writeMotTruth(const std::filesystem::path& file, const BoxesByFrame& boxes,
                        const MotWriteOptions& options = {});
MotLosses writeMotTruth(const std::filesystem::path& file, const LabelBoxes& boxes,
                        const MotWriteOptions& options = {});
MotLosses writeMotTruth(const std::filesystem::path& file, const VisitFrames& frames, const MotWriteOptions& options);
/// Writes a result; boxes without id get −1.
MotLosses writeMotResult(const std::filesystem::path& file, const BoxesByFrame& boxes,
                         const MotWriteOptions& options = {});
MotLosses writeMotResult(const std::filesystem::path& file, const VisitFrames& frames, const MotWriteOptions& options);

/// What seqinfo.ini says of a sequence; empty where it says nothing.
struct MotSequence {
    std::optional<cv::Size> image_size;
    std::optional<int> frame_count;
    std::optional<double> frame_rate_hz;
};

/// Reads seqinfo.ini. Throws Error(input) when it cannot be read or a known entry is no number.
MotSequence readMotSequence(const std::filesystem::path& file);

}  // namespace eyrie
