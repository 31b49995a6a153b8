#pragma once

#include <QObject>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "label/label_session.h"

namespace eyrie::ui {

/// An object in one frame, cut out and turned upright: heading to the right.
struct LabelChip {
    FrameIndex frame = 0;
    bool keyframe = false;
    cv::Mat gray;    ///< CV_8UC1
    cv::Size2d box;  ///< length and width in the chip, px
};

/// Cuts an object out of frames spread over its life, in the background. Of several wishes the newest wins.
class LabelChips : public QObject {
    Q_OBJECT

 public:
    static constexpr int kMostChips = 36;

    /// Both must outlive it.
    LabelChips(ProjectSession& session, LabelSession& labels, QObject* parent = nullptr);

    /// Answers with ready().
    void request(ObjectId object);
    void cancel() { query_.cancel(); }

 signals:
    void ready(ObjectId object, const std::vector<LabelChip>& chips);

 private:
    ProjectSession& session_;
    LabelSession& labels_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

/// The frames of an object that are shown: all keyframes while they are few, else evenly spread ones.
std::vector<FrameIndex> chipFrames(const LabelledObject& object, int most);
/// The inside of a box and a border around it, heading to the right; `gray` CV_8UC1.
LabelChip cutChip(const cv::Mat& gray, const OrientedBox& box);

}  // namespace eyrie::ui
