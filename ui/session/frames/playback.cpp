#include "session/frames/playback.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace eyrie::ui {

Playback::Playback(QObject* parent) : QObject(parent) {
    steady_.start();
    timer_.setTimerType(Qt::PreciseTimer);
    timer_.setSingleShot(true);
    connect(&timer_, &QTimer::timeout, this, &Playback::tick);
}

void Playback::setTimes(std::vector<std::int64_t> times_us) {
    pause();
    clock_.setTimes(std::move(times_us));
}

void Playback::play(FrameIndex frame) {
    if (clock_.frameCount() < 2) return;
    const FrameIndex last = clock_.frameCount() - 1;
    const FrameIndex begin = speed_ > 0 ? 0 : last;
    if (frame == last - begin || !nextToPlay(frame)) frame = begin;
    clock_.start(frame, speed_, now());
    const bool was_playing = playing();
    timer_.start(0);
    if (!was_playing) emit playingChanged(true);
}

void Playback::pause() {
    if (!playing()) return;
    timer_.stop();
    emit playingChanged(false);
}

void Playback::setSpeed(double speed, FrameIndex frame) {
    const double limited = std::copysign(std::clamp(std::abs(speed), kSlowest, kFastest), speed);
    if (limited == speed_) return;
    speed_ = limited;
    emit speedChanged(speed_);
    jumped(frame);
}

void Playback::jumped(FrameIndex frame) {
    if (playing()) clock_.start(frame, speed_, now());
}

std::optional<FrameIndex> Playback::nextToPlay(FrameIndex frame) const {
    if (!spans_) return frame;
    if (speed_ > 0) {
        const auto span = std::find_if(spans_->begin(), spans_->end(), [&](auto& each) { return each.last >= frame; });
        return span == spans_->end() ? std::nullopt : std::optional(std::max(span->first, frame));
    }
    const auto span = std::find_if(spans_->rbegin(), spans_->rend(), [&](auto& each) { return each.first <= frame; });
    return span == spans_->rend() ? std::nullopt : std::optional(std::min(span->last, frame));
}

void Playback::tick() {
    const std::int64_t time = now();
    std::optional<FrameIndex> due = clock_.ended(time) ? std::nullopt : nextToPlay(clock_.frameAt(time));
    if (due && *due != clock_.frameAt(time)) clock_.start(*due, speed_, time);
    if (!due && looping_) {
        due = nextToPlay(speed_ > 0 ? 0 : clock_.frameCount() - 1);
        if (due) clock_.start(*due, speed_, time);
    }
    if (!due) {
        // The end of the video is shown; of stretches, it was.
        if (!spans_) emit frameDue(clock_.frameAt(time));
        emit playingChanged(false);
        return;
    }
    timer_.start(std::max(kLeastWait_ms, static_cast<int>((clock_.untilNext(time) + 999) / 1000)));
    emit frameDue(*due);
}

}  // namespace eyrie::ui

#include "moc_playback.cpp"
