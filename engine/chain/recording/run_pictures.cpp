#include "chain/recording/run_pictures.h"

#include <algorithm>
#include <exception>
#include <system_error>
#include <utility>

#include "io/video/frame_source.h"

namespace eyrie {
namespace {

constexpr std::chrono::milliseconds kTellEvery(200);

}  // namespace

RunPictures::RunPictures(FrameRange range)
    : first_(range.first), frames_(static_cast<std::size_t>(std::max(0, range.last - range.first + 1))) {}

void RunPictures::take(FrameIndex frame, const cv::Mat& gray) {
    if (frames_ == 0 || gray.empty() || frame < first_) return;
    const auto place = static_cast<std::size_t>(frame - first_);
    if (place >= frames_) return;
    if (frames_ > kMostBytes / gray.total()) {
        frames_ = 0;
        pictures_.clear();
        return;
    }
    if (place >= pictures_.size()) pictures_.resize(place + 1);
    pictures_[place] = gray;
}

cv::Mat RunPictures::at(FrameIndex frame) const {
    if (frame < first_ || static_cast<std::size_t>(frame - first_) >= pictures_.size()) return {};
    return pictures_[static_cast<std::size_t>(frame - first_)];
}

PicturesOnceMore::PicturesOnceMore(const RunPictures& held, FrameSource& source, FrameIndex first, FrameIndex last,
                                   ChainObserver* told, std::stop_token stop)
    : held_(held), source_(source), first_(first), last_(last), told_(told), stop_(std::move(stop)) {
    progress_.frames_total = last - first + 1;
    progress_.finishing = true;
}

cv::Mat PicturesOnceMore::operator()(FrameIndex frame) {
    stopped_ = stopped_ || stop_.stop_requested();
    if (stopped_) return {};
    if (!begun_) begun_ = last_told_ = Clock::now();
    tell(frame);
    cv::Mat held = held_.at(frame);
    if (!held.empty()) return held;
    try {
        cv::Mat picture = read(frame);
        readAhead(frame);
        return picture;
    } catch (const std::exception&) {
        ++lost_;
        return {};
    }
}

cv::Mat PicturesOnceMore::read(FrameIndex frame) {
    if (ahead_.valid()) {
        ahead_.wait();  // the source does one thing at a time
        if (coming_ == frame) return ahead_.get();
        ahead_ = {};
    }
    return source_.read(frame, false).gray;
}

void PicturesOnceMore::readAhead(FrameIndex frame) {
    // Of a video nothing may be left out, or it would have to go back; of a folder a picture too many is read in vain.
    const bool steps = source_.info().is_image_sequence && read_last_ && frame > *read_last_;
    coming_ = frame + (steps ? frame - *read_last_ : 1);
    read_last_ = frame;
    if (coming_ > last_ || !held_.at(coming_).empty()) return;
    try {
        ahead_ = std::async(std::launch::async, [this, next = coming_] { return source_.read(next, false).gray; });
    } catch (const std::system_error&) {
        // No thread is to be had: it is read when it is asked for.
    }
}

void PicturesOnceMore::tell(FrameIndex frame) {
    const Clock::time_point now = Clock::now();
    if (told_ == nullptr || frame <= first_ || now - last_told_ < kTellEvery) return;
    last_told_ = now;
    progress_.frames_done = frame - first_;
    const std::chrono::duration<double> passed = now - *begun_;
    progress_.frames_per_second = progress_.frames_done / passed.count();
    progress_.seconds_left = (progress_.frames_total - progress_.frames_done) / progress_.frames_per_second;
    told_->onProgress(progress_);
}

}  // namespace eyrie
