#include "tune/compare/preview_loader.h"

#include <exception>
#include <utility>

namespace eyrie::ui {

namespace {
using Clock = std::chrono::steady_clock;
constexpr auto kPreviewProgressInterval = std::chrono::milliseconds(120);
}  // namespace

/// What is used in the background alone.
class PreviewLoader::Worker {
 public:
    explicit Worker(PreviewLoader& owner) : owner_(owner) {}

    void useRun(std::optional<ReplayRun> run) {
        close();
        run_ = std::move(run);
    }

    void load(FrameIndex frame, const ChainOptions& options, int range, Clock::time_point wished,
              const std::stop_token& tracks_stop, const BackgroundTask& task) {
        if (!run_ || task.stop().stop_requested()) return;
        try {
            if (!open(task.stop())) return;
            auto first = preview_->now(frame, options, range, task.stop());
            if (!first) return;
            const bool final = first->tracks_final || range == 0;
            const double waited_ms = std::chrono::duration<double, std::milli>(Clock::now() - wished).count();
            publish(frame, std::move(*first), final ? 0 : range, waited_ms, task);
            if (final || tracks_stop.stop_requested()) return;
            Clock::time_point told = Clock::now();
            auto whole = preview_->withTracks(frame, options, range, tracks_stop, [&](int left) {
                if (Clock::now() - told < kPreviewProgressInterval) return;
                told = Clock::now();
                task.tell([this, frame, left] { owner_.answers_.show_progress(frame, left); });
            });
            if (whole && !tracks_stop.stop_requested()) publish(frame, std::move(*whole), 0, waited_ms, task);
        } catch (const std::exception&) {
            close();  // opened anew with the next wish
            throw;
        }
    }

    void warmUp(FrameIndex frame, const std::stop_token& stop) {
        if (!run_ || stop.stop_requested()) return;
        try {
            if (open(stop)) preview_->warmUp(frame, stop);
        } catch (const std::exception&) {
            close();  // the first wish says what is wrong
        }
    }

 private:
    void close() {
        preview_.reset();
        open_.reset();
    }

    /// False when it was stopped.
    bool open(const std::stop_token& stop) {
        if (preview_) return true;
        open_ = std::make_unique<OpenRun>(*run_, stop);
        if (stop.stop_requested()) {  // perhaps half open
            open_.reset();
            return false;
        }
        preview_ = std::make_unique<Preview>(open_->source());
        return true;
    }

    void publish(FrameIndex frame, PreviewedFrame previewed, int left, double waited_ms, const BackgroundTask& task) {
        auto view = std::make_shared<PreviewView>();
        view->frame = frame;
        view->previewed = std::move(previewed);
        view->frames_left = left;
        view->milliseconds = waited_ms;
        task.tell([this, view = std::shared_ptr<const PreviewView>(std::move(view))] { owner_.answers_.show(view); });
    }

    PreviewLoader& owner_;
    std::optional<ReplayRun> run_;
    std::unique_ptr<OpenRun> open_;
    std::unique_ptr<Preview> preview_;  ///< after what it reads from
};

PreviewLoader::PreviewLoader(PreviewAnswers answers)
    : answers_(std::move(answers)), worker_(std::make_unique<Worker>(*this)) {}

PreviewLoader::~PreviewLoader() {
    tracks_.request_stop();
}

void PreviewLoader::useRun(std::optional<ReplayRun> run) {
    cancel();
    query_.post([worker = worker_.get(), run = std::move(run)](const BackgroundTask&) { worker->useRun(run); });
}

void PreviewLoader::warmUp(FrameIndex frame) {
    query_.whenIdle(
        [worker = worker_.get(), frame](const BackgroundTask& task) { worker->warmUp(frame, task.stop()); });
}

void PreviewLoader::request(FrameIndex frame, const ChainOptions& options, int range) {
    tracks_.request_stop();
    tracks_ = std::stop_source();
    const auto work = [worker = worker_.get(), frame, options, range, wished = Clock::now(),
                       tracks = tracks_.get_token()](const BackgroundTask& task) {
        worker->load(frame, options, range, wished, tracks, task);
    };
    query_.ask(work, answers_.fail, BackgroundQuery::Former::finish);
}

void PreviewLoader::cancel() {
    tracks_.request_stop();
    query_.cancel();
}

}  // namespace eyrie::ui
