#include "session/frames/playback_clock.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/time/clock_step.h"

namespace eyrie::ui {

namespace {
constexpr std::int64_t kAssumedFrameLength_us = 40'000;
constexpr std::int64_t kShortestWait_us = 1'000;
}  // namespace

void PlaybackClock::setTimes(std::vector<std::int64_t> times_us) {
    times_us_ = std::move(times_us);
    if (times_us_.size() < 3) return;
    std::vector<std::int64_t> steps;
    for (size_t i = 1; i < times_us_.size(); ++i) steps.push_back(times_us_[i] - times_us_[i - 1]);
    const std::vector<std::int64_t> as_stamped = steps;
    std::nth_element(steps.begin(), steps.begin() + std::ssize(steps) / 2, steps.end());
    const std::int64_t usual_us = steps[steps.size() / 2];
    const auto seconds = [](std::int64_t length_us) { return static_cast<double>(length_us) / 1e6; };
    for (size_t i = 1; i < times_us_.size(); ++i) {
        const std::int64_t step_us = as_stamped[i - 1];
        times_us_[i] = times_us_[i - 1] + (isClockJump(seconds(step_us), seconds(usual_us)) ? usual_us : step_us);
    }
}

void PlaybackClock::start(FrameIndex frame, double speed, std::int64_t now_us) {
    speed_ = speed;
    start_us_ = now_us;
    if (times_us_.empty()) return;
    const auto index = static_cast<size_t>(std::clamp(frame, 0, frameCount() - 1));
    // Backwards, a frame is shown from its end to its beginning.
    const std::int64_t end = index + 1 < times_us_.size() ? times_us_[index + 1] - 1 : times_us_[index];
    start_media_us_ = static_cast<double>(speed > 0 ? times_us_[index] : end);
}

double PlaybackClock::mediaTime(std::int64_t now_us) const {
    return start_media_us_ + speed_ * static_cast<double>(now_us - start_us_);
}

FrameIndex PlaybackClock::frameAt(std::int64_t now_us) const {
    if (times_us_.empty()) return 0;
    const auto media = static_cast<std::int64_t>(std::floor(mediaTime(now_us)));
    const auto after = std::upper_bound(times_us_.begin(), times_us_.end(), media);
    return std::max(0, static_cast<FrameIndex>(after - times_us_.begin()) - 1);
}

bool PlaybackClock::ended(std::int64_t now_us) const {
    if (times_us_.empty()) return true;
    const double media = mediaTime(now_us);
    if (speed_ < 0) return media < static_cast<double>(times_us_.front());
    return media >= static_cast<double>(times_us_.back() + lastFrameLength());
}

std::int64_t PlaybackClock::lastFrameLength() const {
    if (times_us_.size() < 2) return kAssumedFrameLength_us;
    return times_us_.back() - times_us_[times_us_.size() - 2];
}

std::int64_t PlaybackClock::untilNext(std::int64_t now_us) const {
    if (times_us_.empty()) return kAssumedFrameLength_us;
    const auto frame = static_cast<size_t>(frameAt(now_us));
    double border = static_cast<double>(times_us_.back() + lastFrameLength());
    if (speed_ < 0)
        border = static_cast<double>(times_us_[frame] - 1);
    else if (frame + 1 < times_us_.size())
        border = static_cast<double>(times_us_[frame + 1]);
    const double wait = (border - mediaTime(now_us)) / speed_;
    return std::max(kShortestWait_us, static_cast<std::int64_t>(std::ceil(wait)));
}

}  // namespace eyrie::ui
