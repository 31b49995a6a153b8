#pragma once

#include <QObject>
#include <chrono>
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

/// Computes previews in the background. Every wish that begins to be worked on is answered at once, so that dragging a
/// slider shows something all the time; of those that wait the newest wins. The tracks, which need the frames before,
/// follow unless a newer wish comes. Signals arrive on the thread of this object.
class PreviewLoader : public QObject {
    Q_OBJECT

 public:
    explicit PreviewLoader(QObject* parent = nullptr);
    ~PreviewLoader() override;

    /// Touches neither video nor project before the first wish.
    void useRun(std::optional<ReplayRun> run);
    /// Answers with previewed() twice, without and with tracks, or failed(). `range`: frames before, over which tracks
    /// are followed.
    void request(FrameIndex frame, const ChainOptions& options, int range);
    /// A parameter of motion may be moved soon: does in spare time what the first answer to that will need.
    void warmUp(FrameIndex frame);
    void cancel();

 signals:
    void previewed(const std::shared_ptr<const PreviewView>& view);
    void tracksProgress(FrameIndex frame, int frames_left);
    void failed(FrameIndex frame, const QString& message);

 private:
    class Worker;
    std::unique_ptr<Worker> worker_;
    std::stop_source tracks_;  ///< of one wish
    BackgroundQuery query_;    ///< last: stops before the worker goes
};

}  // namespace eyrie::ui
