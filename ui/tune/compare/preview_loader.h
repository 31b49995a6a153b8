#pragma once

#include <QString>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

#include "rerun/preview.h"
#include "session/background/background_query.h"
#include "session/frames/open_run.h"

namespace eyrie::ui {

/// A frame with other parameters than those of its run. Shared between threads, never changed once published.
struct PreviewView {
    FrameIndex frame = 0;
    PreviewedFrame previewed;
    int frames_left = 0;      ///< to be done before the tracks are final; 0: they are, or will not be
    double milliseconds = 0;  ///< from the wish to the first answer
};

/// What becomes of what a PreviewLoader was asked for.
struct PreviewAnswers {
    std::function<void(const std::shared_ptr<const PreviewView>& view)> show;
    /// So many frames are still to be done before the tracks are shown.
    std::function<void(FrameIndex frame, int frames_left)> show_progress;
    std::function<void(const QString& message)> fail;
};

/// Computes previews in the background. Every wish that begins to be worked on is answered at once, so that dragging a
/// slider shows something all the time; of those that wait the newest wins. The tracks, which need the frames before,
/// follow unless a newer wish comes. Answers arrive on the thread it was made on.
class PreviewLoader {
 public:
    explicit PreviewLoader(PreviewAnswers answers);
    ~PreviewLoader();

    /// Touches neither video nor project before the first wish.
    void useRun(std::optional<ReplayRun> run);
    /// Shows it twice, without and with tracks, or fails. `range`: frames before, over which tracks
    /// are followed.
    void request(FrameIndex frame, const ChainOptions& options, int range);
    /// A parameter of motion may be moved soon: does in spare time what the first answer to that will need.
    void warmUp(FrameIndex frame);
    void cancel();

 private:
    class Worker;
    PreviewAnswers answers_;
    std::unique_ptr<Worker> worker_;
    std::stop_source tracks_;  ///< of one wish
    BackgroundQuery query_;    ///< last: stops before the worker goes
};

}  // namespace eyrie::ui
