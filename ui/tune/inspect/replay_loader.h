#pragma once

#include <QString>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "rerun/replay.h"
#include "session/background/background_query.h"
#include "session/frames/open_run.h"

namespace eyrie::ui {

/// What is to be looked at in one frame.
struct ReplayWish {
    FrameIndex frame = 0;
    int cluster = -1;                            ///< whose steps are wanted; −1: none
    bool general_segmentation = false;           ///< also the views of fig. 5.1
    StackPictures stacks = StackPictures::none;  ///< how much of every stack
};

/// What general segmentation makes of a motion ROI (fig. 5.1): the ROI with the borders drawn in, CV_8UC3.
struct GeneralSegmentation {
    cv::Mat superpixels;
    cv::Mat watershed;
    cv::Mat graph_cut;
    cv::Mat contours;  ///< gPb with OWT and UCM, the stronger a border the fuller its colour
};

/// A replayed frame. Shared between threads, never changed once published.
struct ReplayView {
    ReplayWish wish;
    ChainOptions options;
    bool exact = true;  ///< see ReplayedFrame
    Frame frame;
    FrameResult result;
    std::vector<StackView> stacks;
    std::optional<DifferenceResult> differences;
    std::vector<SearchTrace> traces;
    std::optional<GeneralSegmentation> general;
};

/// What becomes of what a ReplayLoader was asked for.
struct ReplayAnswers {
    /// So many frames before the wanted one are still to be done.
    std::function<void(FrameIndex frame, int frames_left)> show_progress;
    std::function<void(const std::shared_ptr<const ReplayView>& view)> show;
    std::function<void(const QString& message)> fail;
};

/// Replays frames of a stored run in the background. Of several wishes the newest wins; one that is being worked on is
/// given up, what it has done so far is kept. Answers arrive on the thread it was made on.
class ReplayLoader {
 public:
    explicit ReplayLoader(ReplayAnswers answers);
    ~ReplayLoader();

    /// Touches neither video nor project before the first request.
    void useRun(std::optional<ReplayRun> run);
    /// Shows it or fails, unless a newer request comes first.
    void request(const ReplayWish& wish);
    /// Gives up what is being worked on.
    void cancel() { query_.cancel(); }

 private:
    class Worker;
    ReplayAnswers answers_;
    std::unique_ptr<Worker> worker_;
    BackgroundQuery query_;  ///< last: stops before the worker goes
};

}  // namespace eyrie::ui
