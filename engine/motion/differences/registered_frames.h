#pragma once

#include <deque>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/values/corner.h"
#include "core/values/frame.h"

namespace eyrie {

/// A past picture laid over the current one.
struct WarpedFrame {
    cv::Mat gray;    ///< CV_8UC1, of the current picture's size
    cv::Mat inside;  ///< CV_8UC1, 255 where it shows something (A_o of eq. 2.1)
};

/// The last pictures of a video with the way from each to the newest. Pictures that could not be registered are left
/// out, repeated ones too; a cut forgets everything.
class RegisteredFrames {
 public:
    /// Remembers `depth` ≥ 1 pictures before the newest.
    explicit RegisteredFrames(int depth) : depth_(depth) {}

    /// Takes the next frame. False when it adds nothing: a frame that failed, or a repeated picture.
    bool add(const Frame& frame, const Registration& registration);
    void clear();

    /// How many pictures before the newest there are.
    int count() const { return pictures_.empty() ? 0 : static_cast<int>(pictures_.size()) - 1; }
    /// The newest picture; must not be asked for before the first `add`.
    const cv::Mat& newest() const { return pictures_.front().gray; }
    /// The picture `back` ones before the newest, 1 ≤ back ≤ count(), in the newest picture's coordinates.
    WarpedFrame past(int back) const;
    /// The same picture as it is, 0 ≤ back ≤ count(), …
    const cv::Mat& picture(int back) const { return pictures_.at(static_cast<std::size_t>(back)).gray; }
    /// … and the way from the newest picture to it.
    Homography pathTo(int back) const { return pictures_.at(static_cast<std::size_t>(back)).newest_from_it.inverse(); }

    /// Frames that passed from it to the newest; more than `back` where pictures were lost or not registered.
    int framesTo(int back) const { return pictures_.at(static_cast<std::size_t>(back)).frames_ago; }

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    struct Picture {
        cv::Mat gray;
        Homography newest_from_it;  ///< its `from_frame` is the picture's frame
        int frames_ago = 0;

        template <class Archive>
        void transfer(Archive& archive);
    };
    int depth_;
    std::deque<Picture> pictures_;  ///< newest first
    std::optional<FrameIndex> last_frame_;
};

}  // namespace eyrie
