#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/values/ids.h"

/// What a person says about a video: objects with keyframes, ignore regions, and what was checked.
namespace eyrie {

/// Identity of a labelled object within a project, from 1; assigned once and never reused.
using ObjectId = int;

enum class Occlusion { none, partly, fully };

/// The box of an object in one frame, set by a person or taken over. Between keyframes boxes are interpolated.
struct Keyframe {
    FrameIndex frame = 0;
    OrientedBox box;
    bool heading_set = false;  ///< false: the heading follows the path of the object
    Occlusion occlusion = Occlusion::none;
    bool outside = false;   ///< the object is not in the image from here until the next keyframe
    bool ignore = false;    ///< counts neither way from here until the next keyframe
    bool computed = false;  ///< placed by a run or by following; no hand has set or confirmed it
};

/// Where an object comes from.
enum class ObjectOrigin { hand, proposal_accepted, proposal_corrected, imported };

/// A labelled object. It exists from its first keyframe to `last_frame`, both included.
struct LabelledObject {
    ObjectId id = 0;
    std::string object_class = "car";
    std::uint32_t colour = 0;  ///< 0xRRGGBB
    std::string notes;
    ObjectOrigin origin = ObjectOrigin::hand;
    FrameIndex last_frame = 0;
    std::vector<Keyframe> keyframes;  ///< ascending frames, each frame once, never empty once stored
};

/// What an ignore region is fixed to.
enum class RegionAnchor { image, ground };

/// A polygon in which objects count neither way, over a range of frames.
struct IgnoreRegion {
    int id = 0;
    std::vector<cv::Point2d> polygon;  ///< px in `reference_frame`, at least three corners
    RegionAnchor anchor = RegionAnchor::image;
    FrameIndex reference_frame = 0;
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;  ///< included
    std::string notes;
};

enum class ReviewState { unseen, checked, questionable };

/// Somebody's judgement of an object over a range of frames. Later marks replace earlier ones where they meet.
struct ReviewMark {
    ObjectId object = 0;
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;  ///< included
    ReviewState state = ReviewState::checked;
    std::string person;
    std::string when_utc;  ///< ISO 8601
};

/// A class of objects that a project knows besides the built-in ones, or a built-in one changed.
struct ObjectClass {
    std::string name;
    bool vehicle = true;
    std::uint32_t colour = 0;  ///< 0xRRGGBB
    double length_m = 0;       ///< usual size, for boxes drawn by two clicks; 0: not known
    double width_m = 0;
};

/// All that is labelled in one sequence.
struct AnnotationSet {
    std::vector<ObjectClass> classes;
    std::map<ObjectId, LabelledObject> objects;
    std::map<int, IgnoreRegion> regions;
    std::vector<ReviewMark> reviews;  ///< in the order they were made
};

}  // namespace eyrie
