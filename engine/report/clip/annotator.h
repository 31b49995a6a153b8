#pragma once

#include <deque>
#include <map>
#include <opencv2/core/mat.hpp>

#include "core/values/frame.h"
#include "core/values/frame_result.h"

namespace eyrie {

/// Draws what the chain found into pictures for the annotated video: motion vectors yellow, clusters cyan, detections
/// red, tracks green with id and trail (the thesis' colours). Small videos are enlarged so that labels can be read.
class Annotator {
 public:
    /// What is drawn: all that the chain found, or its tracks alone.
    enum class Parts { all, tracks };
    explicit Annotator(Parts parts = Parts::all) : parts_(parts) {}
    /// How far trails go back.
    static constexpr int kTrailFrames = 50;

    /// A frame that is not drawn, for the trails of those that follow.
    void follow(const FrameResult& result);
    /// Picture of one frame, CV_8UC3; frames must come in ascending order for the trails.
    cv::Mat draw(const Frame& frame, const FrameResult& result);

 private:
    void drawTracks(cv::Mat& picture, const FrameResult& result, double zoom) const;

    Parts parts_;
    std::map<TrackId, std::deque<cv::Point2d>> trails_;
};

/// Factor by which frames of this size are enlarged.
int annotationZoom(cv::Size size);

}  // namespace eyrie
