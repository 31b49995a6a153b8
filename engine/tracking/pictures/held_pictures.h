#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>

#include "tracking/finishing/track_finishing.h"

namespace eyrie {

/// The grey pictures read last, neighbours in order. `source` must outlive it.
class HeldPictures {
 public:
    /// `frames`: as many as may be needed at once.
    HeldPictures(const GrayOfFrame& source, std::size_t frames) : source_(source), frames_(frames) {}

    void read(FrameIndex frame) {
        if (!pictures_.empty() && last_ + 1 != frame) pictures_.clear();
        last_ = frame;
        pictures_.push_back(source_(frame));
        while (pictures_.size() > mostOf(pictures_.back().size())) pictures_.pop_front();
    }
    /// As many of that size as are held.
    std::size_t mostOf(cv::Size size) const {
        const auto bytes = std::max<std::size_t>(1, static_cast<std::size_t>(size.area()));
        return std::max<std::size_t>(2, std::min(frames_, kMostHeldBytes / bytes));
    }
    /// Null where it is not held or could not be read.
    const cv::Mat* at(FrameIndex frame) const {
        const FrameIndex back = last_ - frame;
        if (back < 0 || static_cast<std::size_t>(back) >= pictures_.size()) return nullptr;
        const cv::Mat& picture = pictures_[pictures_.size() - 1 - static_cast<std::size_t>(back)];
        return picture.empty() || picture.type() != CV_8UC1 ? nullptr : &picture;
    }

 private:
    static constexpr std::size_t kMostHeldBytes = 200'000'000;  ///< of pictures, for those who are followed back

    const GrayOfFrame& source_;
    std::size_t frames_;
    FrameIndex last_ = -1;
    std::deque<cv::Mat> pictures_;  ///< up to the last
};

}  // namespace eyrie
