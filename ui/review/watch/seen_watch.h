#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "core/review/seen_frames.h"
#include "session/background/background_query.h"
#include "widgets/repeated_call.h"

class QWidget;

namespace eyrie::ui {

class ProjectSession;
class VideoView;

/// What anybody watched of a run.
struct WatchedFrames {
    std::vector<FrameSpan> spans;  ///< of the whole video, merged
    double share = 0;              ///< of the run's frames, 0 … 1
};

/// Keeps in the project which frames a person watches: shown at four times the speed or slower, with the window in
/// front. What was shown is written every few seconds, in the background.
class SeenWatch : public QObject {
    Q_OBJECT

 public:
    using ShowWatched = std::function<void(const std::optional<WatchedFrames>&)>;

    /// All must outlive it; `window` is the one that must be in front. `show_watched` is told what anybody watched;
    /// nothing while there is no run, or it cannot be kept.
    SeenWatch(ProjectSession& session, VideoView& canvas, QWidget& window, ShowWatched show_watched,
              QObject* parent = nullptr);
    ~SeenWatch() override;

    /// Writes what was seen since, and asks anew for what was watched.
    void flush();

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void showFrame();
    double wallSeconds() const { return static_cast<double>(clock_.nsecsElapsed()) / 1e9; }

    ProjectSession& session_;
    VideoView& canvas_;
    QWidget& window_;
    ShowWatched show_watched_;
    SeenRecorder recorder_;
    QElapsedTimer clock_;
    int sequence_ = 0;  ///< of the run whose frames are recorded; 0: of none
    std::filesystem::path project_;
    bool told_ = false;  ///< what was watched of the video that is shown
    FrameSpan searched_{0, -1};
    RepeatedCall due_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
