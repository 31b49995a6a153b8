#include "tune/inspect/explanation_loader.h"

#include <exception>
#include <utility>

#include "explain/place_explainer.h"

namespace eyrie::ui {

namespace {
constexpr double kShownAround = 1.3;  ///< corners are shown in the area times this
}

/// What is used in the background alone.
class ExplanationLoader::Worker {
 public:
    explicit Worker(ExplanationLoader& owner) : owner_(owner) {}

    void useRun(std::optional<ReplayRun> run) {
        explainer_.reset();
        open_.reset();
        run_ = std::move(run);
    }

    void explain(FrameIndex frame, const OrientedBox& area, const BackgroundTask& task) {
        const std::stop_token& stop = task.stop();
        if (!run_ || stop.stop_requested()) return;
        try {
            if (!explainer_) {
                open_ = std::make_unique<OpenRun>(*run_, stop);
                if (stop.stop_requested()) {  // perhaps half open
                    open_.reset();
                    return;
                }
                explainer_ = std::make_unique<PlaceExplainer>(open_->source());
            }
            auto told = explainer_->explain(frame, area, stop);
            if (!told || stop.stop_requested()) return;
            auto view = std::make_shared<ExplanationView>();
            view->frame = frame;
            view->area = area;
            view->told = std::move(*told);
            const OrientedBox around = area.scaled(kShownAround, kShownAround);
            if (const auto& corners = explainer_->evidence().corners) {
                for (const CornerVerdict& corner : *corners)
                    if (around.contains(corner.position)) view->corners.push_back(corner);
            }
            task.tell(
                [this, view = std::shared_ptr<const ExplanationView>(std::move(view))] { owner_.answers_.show(view); });
        } catch (const std::exception&) {
            useRun(std::move(run_));  // opened anew with the next question
            throw;
        }
    }

 private:
    ExplanationLoader& owner_;
    std::optional<ReplayRun> run_;
    std::unique_ptr<OpenRun> open_;
    std::unique_ptr<PlaceExplainer> explainer_;  ///< after what it reads from
};

ExplanationLoader::ExplanationLoader(ExplanationAnswers answers)
    : answers_(std::move(answers)), worker_(std::make_unique<Worker>(*this)) {}

ExplanationLoader::~ExplanationLoader() = default;

void ExplanationLoader::useRun(std::optional<ReplayRun> run) {
    cancel();
    query_.post([worker = worker_.get(), run = std::move(run)](const BackgroundTask&) { worker->useRun(run); });
}

void ExplanationLoader::ask(FrameIndex frame, const OrientedBox& area) {
    query_.ask(
        [worker = worker_.get(), frame, area](const BackgroundTask& task) { worker->explain(frame, area, task); },
        answers_.fail);
}

}  // namespace eyrie::ui
