#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <filesystem>
#include <functional>
#include <optional>

#include "core/review/seen_frames.h"
#include "session/background/background_query.h"
#include "widgets/repeated_call.h"

class QWidget;

namespace eyrie::ui {

class ProjectSession;
class VideoView;

/// Keeps in the project which frames a person watches: shown at four times the speed or slower, with the window in
/// front. What was shown is written every few seconds, in the background.
class SeenWatch : public QObject {
    Q_OBJECT

 public:
    /// All must outlive it; `window` is the one that must be in front. `show_share` is told the share of the run's
    /// frames, 0 … 1, that anybody watched; nothing while there is no run, or it cannot be kept.
    SeenWatch(ProjectSession& session, VideoView& canvas, QWidget& window,
              std::function<void(std::optional<double>)> show_share, QObject* parent = nullptr);
    ~SeenWatch() override;

    /// Writes what was seen since, and asks for the share anew.
    void flush();

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void showFrame();
    double wallSeconds() const { return static_cast<double>(clock_.nsecsElapsed()) / 1e9; }

    ProjectSession& session_;
    VideoView& canvas_;
    QWidget& window_;
    std::function<void(std::optional<double>)> show_share_;
    SeenRecorder recorder_;
    QElapsedTimer clock_;
    int sequence_ = 0;  ///< of the run whose frames are recorded; 0: of none
    std::filesystem::path project_;
    FrameSpan searched_{0, -1};
    RepeatedCall due_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
