#include "tune/compare/preview_loader.h"

#include <exception>
#include <utility>

#include "session/background/queued_call.h"

namespace eyrie::ui {

namespace {
using Clock = std::chrono::steady_clock;
constexpr auto kPreviewProgressInterval = std::chrono::milliseconds(120);
}  // namespace

/// What lives on the loader's thread.
class PreviewLoader::Worker {
 public:
    explicit Worker(PreviewLoader& owner) : owner_(owner) {}

    void useRun(std::optional<ReplayRun> run) {
        preview_.reset();
        open_.reset();
        run_ = std::move(run);
    }

    void load(FrameIndex frame, const ChainOptions& options, int range, Clock::time_point wished,
              const std::stop_token& run_stop, const std::stop_token& wish_stop) {
        if (!run_ || run_stop.stop_requested()) return;
        try {
            if (!open(run_stop)) return;
            auto first = preview_->now(frame, options, range, run_stop);
            if (!first) return;
            const bool final = first->tracks_final || range == 0;
            const double waited_ms = std::chrono::duration<double, std::milli>(Clock::now() - wished).count();
            publish(frame, std::move(*first), final ? 0 : range, waited_ms);
            if (final || wish_stop.stop_requested()) return;
            Clock::time_point told = Clock::now();
            auto whole = preview_->withTracks(frame, options, range, wish_stop, [&](int left) {
                if (Clock::now() - told < kPreviewProgressInterval) return;
                told = Clock::now();
                queuedCall(&owner_, [owner = &owner_, frame, left] { emit owner->tracksProgress(frame, left); });
            });
            if (whole && !wish_stop.stop_requested()) publish(frame, std::move(*whole), 0, waited_ms);
        } catch (const std::exception& error) {
            if (run_stop.stop_requested()) return;
            preview_.reset();  // opened anew with the next wish
            open_.reset();
            queuedCall(&owner_, [owner = &owner_, frame, message = QString::fromUtf8(error.what())] {
                emit owner->failed(frame, message);
            });
        }
    }

    void warmUp(FrameIndex frame, const std::stop_token& run_stop, const std::stop_token& warm_stop) {
        if (!run_ || run_stop.stop_requested() || warm_stop.stop_requested()) return;
        try {
            if (open(run_stop)) preview_->warmUp(frame, warm_stop);
        } catch (const std::exception&) {
            preview_.reset();  // the first wish says what is wrong
            open_.reset();
        }
    }

 private:
    /// False when it was stopped.
    bool open(const std::stop_token& run_stop) {
        if (preview_) return true;
        open_ = std::make_unique<OpenRun>(*run_, run_stop);
        if (run_stop.stop_requested()) {  // perhaps half open
            open_.reset();
            return false;
        }
        preview_ = std::make_unique<Preview>(open_->source());
        return true;
    }

    void publish(FrameIndex frame, PreviewedFrame previewed, int left, double waited_ms) {
        auto view = std::make_shared<PreviewView>();
        view->frame = frame;
        view->previewed = std::move(previewed);
        view->frames_left = left;
        view->milliseconds = waited_ms;
        queuedCall(&owner_, [owner = &owner_, view = std::shared_ptr<const PreviewView>(std::move(view))] {
            emit owner->previewed(view);
        });
    }

    PreviewLoader& owner_;
    std::optional<ReplayRun> run_;
    std::unique_ptr<OpenRun> open_;
    std::unique_ptr<Preview> preview_;  ///< after what it reads from
};

PreviewLoader::PreviewLoader(QObject* parent) : QObject(parent), worker_(std::make_unique<Worker>(*this)) {}

PreviewLoader::~PreviewLoader() {
    cancel();
}

void PreviewLoader::useRun(std::optional<ReplayRun> run) {
    cancel();
    thread_.post([worker = worker_.get(), run = std::move(run)](const std::stop_token&) { worker->useRun(run); });
}

void PreviewLoader::warmUp(FrameIndex frame) {
    warm_.request_stop();
    warm_ = std::stop_source();
    if (run_.stop_requested()) run_ = std::stop_source();
    thread_.postIdle([worker = worker_.get(), frame, run = run_.get_token(),
                      warm = warm_.get_token()](const std::stop_token&) { worker->warmUp(frame, run, warm); });
}

void PreviewLoader::request(FrameIndex frame, const ChainOptions& options, int range) {
    warm_.request_stop();
    wish_.request_stop();
    wish_ = std::stop_source();
    if (run_.stop_requested()) run_ = std::stop_source();
    thread_.postNewest(
        [worker = worker_.get(), frame, options, range, wished = Clock::now(), run = run_.get_token(),
         wish = wish_.get_token()](const std::stop_token&) { worker->load(frame, options, range, wished, run, wish); });
}

void PreviewLoader::cancel() {
    run_.request_stop();
    wish_.request_stop();
    warm_.request_stop();
}

}  // namespace eyrie::ui
