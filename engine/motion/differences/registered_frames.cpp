#include "motion/differences/registered_frames.h"

#include <opencv2/imgproc.hpp>

namespace eyrie {

void RegisteredFrames::clear() {
    pictures_.clear();
    last_frame_.reset();
}

bool RegisteredFrames::add(const Frame& frame, const Registration& registration) {
    const Homography& step = registration.current_from_previous;
    const bool follows = last_frame_ && registration.state != RegistrationState::first &&
                         step.from_frame == *last_frame_ && step.to_frame == frame.index;
    const bool same_size = pictures_.empty() || pictures_.front().gray.size() == frame.gray.size();
    if (!follows || !same_size) {
        pictures_.clear();
    } else {
        // A failed frame's homography is a guess whose product with the next one is true again (see Registrar).
        for (Picture& picture : pictures_) {
            picture.newest_from_it = step * picture.newest_from_it;
            picture.frames_ago += registration.framesPassed();
        }
    }
    last_frame_ = frame.index;
    if (follows && registration.state != RegistrationState::registered) return false;
    Picture picture;
    picture.gray = frame.gray;
    picture.newest_from_it.from_frame = frame.index;
    picture.newest_from_it.to_frame = frame.index;
    pictures_.push_front(picture);
    if (static_cast<int>(pictures_.size()) > depth_ + 1) pictures_.pop_back();
    return true;
}

WarpedFrame RegisteredFrames::past(int back) const {
    const Picture& picture = pictures_.at(static_cast<std::size_t>(back));
    const cv::Size size = newest().size();
    WarpedFrame warped;
    cv::warpPerspective(picture.gray, warped.gray, picture.newest_from_it.matrix, size, cv::INTER_LINEAR,
                        cv::BORDER_REPLICATE);
    cv::warpPerspective(cv::Mat(size, CV_8UC1, cv::Scalar(255)), warped.inside, picture.newest_from_it.matrix, size,
                        cv::INTER_NEAREST, cv::BORDER_CONSTANT);
    return warped;
}

}  // namespace eyrie
