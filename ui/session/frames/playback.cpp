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
    if (speed_ > 0 && frame >= last) frame = 0;
    if (speed_ < 0 && frame <= 0) frame = last;
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

void Playback::tick() {
    const std::int64_t time = now();
    if (clock_.ended(time)) {
        if (!looping_) {
            emit frameDue(clock_.frameAt(time));
            emit playingChanged(false);
            return;
        }
        clock_.start(speed_ > 0 ? 0 : clock_.frameCount() - 1, speed_, time);
    }
    timer_.start(static_cast<int>((clock_.untilNext(time) + 999) / 1000));
    emit frameDue(clock_.frameAt(time));
}

}  // namespace eyrie::ui
