#pragma once

#include <QColor>
#include <QString>
#include <optional>
#include <vector>

#include "core/labels/annotation.h"
#include "core/values/ids.h"
#include "core/values/scale_slope.h"

namespace eyrie::ui {

/// How a labelled box in a frame came about, as it is drawn.
enum class LabelKind {
    keyframe,      ///< solid
    interpolated,  ///< dashed
    expected,      ///< dotted: beyond the object's life, no label yet
    proposal,      ///< a track offered by a run
    planned        ///< what a verb would make of an object; no more than a picture
};

/// Whether it is an object of the labels that one can point at.
constexpr bool isObject(LabelKind kind) {
    return kind != LabelKind::proposal && kind != LabelKind::planned;
}

/// A labelled object, or a proposal, in the frame shown.
struct LabelMark {
    int id = 0;  ///< object, or track of a proposal
    LabelKind kind = LabelKind::keyframe;
    OrientedBox box;
    QColor colour;
    Occlusion occlusion = Occlusion::none;
    bool ignore = false;
    bool in_image_only = false;  ///< interpolated without knowing how the camera moved
    ReviewState review = ReviewState::unseen;
    bool selected = false;  ///< one of the selected ones, or to be seen like them
    QString text;           ///< beside the box
};

/// An ignore region as it lies in the frame shown.
struct RegionMark {
    int id = 0;
    std::vector<cv::Point2d> polygon;
};

/// All labels of a frame and what the tool needs to draw new ones.
struct LabelScene {
    FrameIndex frame = 0;
    std::vector<LabelMark> marks;  ///< objects ascending, then proposals
    std::vector<RegionMark> regions;
    std::optional<ObjectId> selected;  ///< the one with handles
    bool editable = true;
    QColor drawn_colour{255, 255, 255};
    double drawn_width = 0;         ///< usual one of the class drawn in the slope's centre, px; 0: not known
    ScaleSlope slope;               ///< how that changes over the picture
    double width_of_length = 0.42;  ///< width of what is drawn when its size is not known
};

}  // namespace eyrie::ui
