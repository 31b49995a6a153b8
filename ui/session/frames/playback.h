#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <optional>
#include <vector>

#include "core/review/seen_frames.h"
#include "session/frames/playback_clock.h"

namespace eyrie::ui {

/// Plays: asks for frames when they are due by the video's time stamps. Whoever shows them may be slower; then frames
/// are left out, never delayed.
class Playback : public QObject {
    Q_OBJECT

 public:
    static constexpr double kSlowest = 0.25;
    static constexpr double kFastest = 32;
    /// From one frame that is due to the next, at least: screens show no more.
    static constexpr int kLeastWait_ms = 8;

    explicit Playback(QObject* parent = nullptr);

    void setTimes(std::vector<std::int64_t> times_us);
    const PlaybackClock& clock() const { return clock_; }
    bool playing() const { return timer_.isActive(); }
    /// Signed: negative plays backwards. Kept while paused.
    double speed() const { return speed_; }
    bool looping() const { return looping_; }
    void setLooping(bool looping) { looping_ = looping; }

    /// Plays these frames alone, merged spans, and leaps over what lies between; nothing: all. Frames that are asked
    /// for otherwise are shown all the same.
    void setSpans(std::optional<std::vector<FrameSpan>> spans) { spans_ = std::move(spans); }
    const std::optional<std::vector<FrameSpan>>& spans() const { return spans_; }

    /// Plays from `frame`; from the other end when it is the last one in that direction.
    void play(FrameIndex frame);
    void pause();
    /// Limited to kSlowest … kFastest in either direction.
    void setSpeed(double speed, FrameIndex frame);
    /// Someone jumped while playing: go on from there.
    void jumped(FrameIndex frame);

 signals:
    void frameDue(FrameIndex frame);
    void playingChanged(bool playing);
    void speedChanged(double speed);

 private:
    void tick();
    /// The first frame from here on, in the direction it plays, that is to be played; nothing when none follows.
    std::optional<FrameIndex> nextToPlay(FrameIndex frame) const;
    std::int64_t now() const { return steady_.nsecsElapsed() / 1000; }

    PlaybackClock clock_;
    QElapsedTimer steady_;
    QTimer timer_;
    double speed_ = 1;
    bool looping_ = false;
    std::optional<std::vector<FrameSpan>> spans_;
};

}  // namespace eyrie::ui
