#include "tune/inspect/replay_loader.h"

#include <chrono>
#include <exception>
#include <utility>

#include "core/error.h"
#include "detection/segmenters/segmentation_views.h"

namespace eyrie::ui {

namespace {

constexpr auto kReplayProgressInterval = std::chrono::milliseconds(100);

GeneralSegmentation generalSegmentation(const MotionRoi& roi, const SceneScale& scale) {
    return {drawSegments(roi.image, superpixelSegments(roi, scale)), drawSegments(roi.image, watershedSegments(roi)),
            drawSegments(roi.image, graphCutSegments(roi)), drawContourMap(roi.image, contourMap(roi))};
}

}  // namespace

/// What is used in the background alone.
class ReplayLoader::Worker {
 public:
    explicit Worker(ReplayLoader& owner) : owner_(owner) {}

    void useRun(std::optional<ReplayRun> run) {
        replay_.reset();
        open_.reset();
        run_ = std::move(run);
    }

    void load(const ReplayWish& wish, const BackgroundTask& task) {
        const std::stop_token& stop = task.stop();
        if (!run_ || stop.stop_requested()) return;
        try {
            if (!replay_) {
                open_ = std::make_unique<OpenRun>(*run_, stop);
                if (stop.stop_requested()) {  // perhaps half open
                    open_.reset();
                    return;
                }
                replay_ = std::make_unique<Replay>(open_->source([this](FrameIndex frame) { tell(frame); }));
            }
            wanted_ = wish.frame;
            const ReplayedFrame* frame = replay_->at(wish.frame, stop);
            if (stop.stop_requested()) return;
            if (frame == nullptr) throw Error(ErrorKind::project, "the run has no such frame");
            publish(wish, *frame, task);
        } catch (const std::exception&) {
            useRun(std::move(run_));  // opened anew with the next wish
            throw;
        }
    }

 private:
    void publish(const ReplayWish& wish, const ReplayedFrame& frame, const BackgroundTask& task) {
        auto view = std::make_shared<ReplayView>();
        view->wish = wish;
        view->options = replay_->options();
        view->exact = frame.exact;
        view->frame = frame.frame;
        view->result = frame.result;
        view->stacks = replay_->stacks(wish.stacks);
        view->differences = frame.differences;
        view->traces = replay_->trace(wish.cluster);
        if (wish.general_segmentation && !view->traces.empty())
            view->general =
                generalSegmentation(view->traces.front().roi, replay_->scale().zoomed(view->traces.front().roi.zoom));
        task.tell([this, view = std::shared_ptr<const ReplayView>(std::move(view))] { owner_.answers_.show(view); });
    }

    void tell(FrameIndex frame) {
        const auto now = std::chrono::steady_clock::now();
        if (frame >= wanted_ || now - told_ < kReplayProgressInterval) return;
        told_ = now;
        owner_.query_.tell(
            [this, wanted = wanted_, left = wanted_ - frame] { owner_.answers_.show_progress(wanted, left); });
    }

    ReplayLoader& owner_;
    std::optional<ReplayRun> run_;
    std::unique_ptr<OpenRun> open_;
    std::unique_ptr<Replay> replay_;  ///< after what it reads from
    FrameIndex wanted_ = 0;
    std::chrono::steady_clock::time_point told_;
};

ReplayLoader::ReplayLoader(ReplayAnswers answers)
    : answers_(std::move(answers)), worker_(std::make_unique<Worker>(*this)) {}

ReplayLoader::~ReplayLoader() = default;

void ReplayLoader::useRun(std::optional<ReplayRun> run) {
    cancel();
    query_.post([worker = worker_.get(), run = std::move(run)](const BackgroundTask&) { worker->useRun(run); });
}

void ReplayLoader::request(const ReplayWish& wish) {
    query_.ask([worker = worker_.get(), wish](const BackgroundTask& task) { worker->load(wish, task); }, answers_.fail);
}

}  // namespace eyrie::ui
