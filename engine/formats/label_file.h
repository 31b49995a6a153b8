#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/labels/annotation.h"
#include "core/labels/box_record.h"

/// What a file of labels holds, whatever its format. Coordinates and frames are ours: integers are pixel centres,
/// frames count from 0.
namespace eyrie {

/// A labelled box: what every table carries, and how far the object is hidden.
struct LabelBox : BoxRecord {
    Occlusion occlusion = Occlusion::none;
};

using LabelBoxes = std::map<FrameIndex, std::vector<LabelBox>>;

struct TrackWorld;

/// Labels as a file has them, in our pixel coordinates.
struct LabelFile {
    std::string format;  ///< name of the format it was read from
    LabelBoxes boxes;    ///< every frame an object is seen in; boxes without id belong to no object
    /// Only from formats with keyframes (CVAT), one per id, in which case `boxes` holds the frames between them too.
    std::vector<LabelledObject> objects;
    std::int64_t not_filled = 0;  ///< boxes between keyframes that `boxes` does without; see ImportOptions::frame_count
    std::vector<std::string> classes;  ///< in the file's own order where it lists them; may be empty
    std::optional<cv::Size> image_size;
    std::optional<int> frame_count;
    std::optional<double> frame_rate_hz;
    std::optional<double> gsd_m;                       ///< ground sampling distance, m/px
    std::map<FrameIndex, std::string> image_names;     ///< where the format names images
    std::shared_ptr<const TrackWorld> world;           ///< when and where (track_world.h); of runs, else null
    int first_frame_number = 0;                        ///< the number the format gives to a video's first frame
    std::vector<std::filesystem::path> further_files;  ///< read besides the one named
    std::vector<std::string> notes;                    ///< what was odd, one sentence each
};

/// What import shows before it touches anything.
struct LabelReport {
    std::string format;
    int boxes = 0;
    int frames = 0;  ///< with a box
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;
    int first_frame_number = 0;  ///< see LabelFile
    int ids = 0;
    int lowest_id = 0;
    int highest_id = 0;
    int without_id = 0;  ///< boxes
    int loose = 0;       ///< of those, the ones that are not to be ignored: they belong to no object
    int turned = 0;      ///< boxes with a rotation of their own
    int ignored = 0;     ///< boxes
    int occluded = 0;    ///< boxes
    int keyframes = 0;   ///< 0 where the format has none
    int outside = 0;     ///< boxes with their centre outside the image, where its size is known
    std::map<std::string, int> boxes_of_class;
    std::optional<cv::Size> image_size;
    std::optional<int> frame_count;
    std::vector<std::string> notes;
};

/// What is in the file, for people who are about to import it.
LabelReport reportOn(const LabelFile& labels);

/// Without the occlusions, for evaluation and our own tables.
BoxesByFrame plainBoxes(const LabelBoxes& labels);
/// The other way, with nothing occluded.
LabelBoxes labelBoxes(const BoxesByFrame& boxes);

/// Whether the box is neither upright nor upright after a quarter turn, so that an upright format loses its shape: an
/// edge of the enclosing upright box lies more than 0.005 px off.
bool isTurned(const OrientedBox& box);
/// The box brought to the nearest quarter turn, as an upright box (heading 0).
OrientedBox straightened(const OrientedBox& box);

/// A box by its edges, px; `first_pixel_edge` is where the first pixel begins in those coordinates.
struct BoxEdges {
    double left = 0;
    double top = 0;
    double width = 0;
    double height = 0;
};
OrientedBox boxFromEdges(const BoxEdges& edges, double first_pixel_edge);
/// Edges of the smallest upright box around it; of a box that is not turned, its own.
BoxEdges edgesOf(const OrientedBox& box, double first_pixel_edge);

/// Rectangle through four corners in the order front left, front right, rear right, rear left (as a driver sees them),
/// which may be rounded; and how far the corners are from it at most, px.
struct CornerBox {
    OrientedBox box;
    double departure = 0;
};
CornerBox boxFromCorners(const std::array<cv::Point2d, 4>& corners);
std::array<cv::Point2d, 4> frontFirstCorners(const OrientedBox& box);

/// All labels as objects with keyframes: those of the file, else one keyframe per box, `outside` over gaps. Headings
/// are set, never taken from the path. Ignored boxes without id become ignore regions, one per stretch of equal boxes.
/// Other boxes without id belong to no object and are left out; `left_out` counts them.
struct ImportedLabels {
    AnnotationSet annotations;
    int left_out = 0;
    int id_step = 0;  ///< added to the file's ids, so that they count from 1
    std::vector<std::string> notes;
};
ImportedLabels annotationsOf(const LabelFile& labels);

}  // namespace eyrie
