#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/labels/annotation.h"

namespace eyrie {

/// What deserves a look.
enum class AttentionKind {
    questionable,   ///< somebody marked it so
    starts_inside,  ///< appears in the middle of the image after the first frame
    ends_inside,    ///< vanishes in the middle of the image before the last frame
    gap,            ///< outside for a while although it was in the middle of the image
    jump,           ///< speed between keyframes unlike that before and after
    turn,           ///< turns on the spot
    size            ///< length or width changes suddenly
};
const char* nameOf(AttentionKind kind);

/// A frame of an object that a person should look at.
struct AttentionItem {
    ObjectId object = 0;
    FrameIndex frame = 0;
    AttentionKind kind = AttentionKind::questionable;
    std::string text;  ///< for people: "jumps: 14.2 px/frame, 3.1 before"
};

/// What of labels is worth a look.
struct AttentionOptions {
    cv::Size image;                ///< px
    int frame_count = 0;           ///< of the video
    double border_px = 12;         ///< boxes that come this near to the border may begin and end there
    double jump_px = 3;            ///< px/frame over the ground that a speed may change between keyframes …
    double jump_factor = 2.5;      ///< … and the factor it must change by, too
    double turn_per_frame = 0.35;  ///< radians
    double size_factor = 1.4;      ///< between keyframes
};

/// All that deserves a look, by frame, then object.
std::vector<AttentionItem> attentionList(const AnnotationSet& set, const CameraMotion& camera,
                                         const AttentionOptions& options);

/// The next item after a frame (and, in it, after an object), from the start again when there is none.
std::optional<AttentionItem> nextAttention(const std::vector<AttentionItem>& items, FrameIndex frame, ObjectId object);

}  // namespace eyrie
