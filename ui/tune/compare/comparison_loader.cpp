#include "tune/compare/comparison_loader.h"

#include <exception>
#include <functional>
#include <utility>

#include "canvas/drawing/image_convert.h"
#include "io/video/frame_cache.h"
#include "rerun/replay.h"
#include "session/frames/picture_budget.h"
#include "session/frames/stored_frames.h"
#include "session/project_session.h"
#include "tune/compare/comparison_computation.h"
#include "tune/compare/computed_frames.h"

namespace eyrie::ui {

namespace {

constexpr int kSideReadAhead = 8;  ///< frames

/// Where the frames of one side come from.
struct SideFrames {
    std::unique_ptr<StoredFrames> stored;
    std::shared_ptr<const ComputedFrames> computed;
    SceneScale scale;  ///< of what is computed

    bool open() const { return stored || computed; }
    void addTo(ViewFrame& frame) const {
        if (stored) stored->addTo(frame);
        if (computed) {
            frame.scale = scale.in(frame.index);
            computed->addTo(frame);
        }
    }
    bool prepare(FrameIndex frame) const { return !stored || stored->prepare(frame); }
};

}  // namespace

/// What is used in the background alone.
class ComparisonLoader::Worker {
 public:
    explicit Worker(ComparisonLoader& owner) : owner_(owner) {}

    void open(const ComparisonPair& pair, const ComputedPair& computed, const std::stop_token& stop) {
        pictures_.reset();
        first_ = {};
        second_ = {};
        try {
            const auto side = [&](const ComparisonSide& wanted, const std::shared_ptr<ComputedFrames>& frames) {
                SideFrames made;
                if (!wanted.options) {
                    made.stored =
                        std::make_unique<StoredFrames>(pair.project, wanted.run_id, ProjectSession::kTrailLength);
                    return made;
                }
                made.computed = frames;
                ProjectFile project = ProjectFile::open(pair.project, ProjectFile::Mode::read_only);
                if (const auto run = RunStore(project).run(wanted.run_id)) made.scale = run->scale;
                return made;
            };
            first_ = side(pair.first, computed.first);
            second_ = side(pair.second, computed.second);
            auto source = pair.media.open({}, stop);
            if (stop.stop_requested()) return;
            FrameCacheOptions options;
            options.max_bytes = pictureBudget(PictureUse::comparison);
            pictures_ = std::make_unique<FrameCache>(std::move(source), options);
        } catch (const std::exception&) {
            if (!stop.stop_requested()) throw;
        }
    }

    void load(FrameIndex frame, const BackgroundTask& task) {
        if (!first_.open() || !second_.open() || task.stop().stop_requested()) return;
        ViewFrame one;
        one.index = frame;
        const bool has_picture = pictures_ && frame < pictures_->info().frame_count;
        if (has_picture) pictures_->tryGet(frame);  // decoded on its own thread while results are read here
        ViewFrame other = one;
        first_.addTo(one);
        second_.addTo(other);
        if (has_picture) {
            const auto picture = pictures_->get(frame);
            one.image = imageForDisplay(picture->colour.empty() ? picture->gray : picture->colour);
            one.time_us = other.time_us = pictures_->timeOf(frame);
            other.image = one.image;
        }
        task.tell([this, one = std::move(one), other = std::move(other)] { owner_.answers_.show(one, other); });
        readAhead(frame + 1, kSideReadAhead);
    }

 private:
    void readAhead(FrameIndex frame, int left) {
        if (left == 0) return;
        owner_.query_.whenIdle([this, frame, left](const BackgroundTask&) {
            if (!first_.open() || !second_.open()) return;
            if (first_.prepare(frame) && second_.prepare(frame)) readAhead(frame + 1, left - 1);
        });  // what is wrong with a frame is told when it is asked for
    }

    ComparisonLoader& owner_;
    std::unique_ptr<FrameCache> pictures_;
    SideFrames first_;
    SideFrames second_;
};

ComparisonLoader::ComparisonLoader(ComparisonAnswers answers)
    : answers_(std::move(answers)), worker_(std::make_unique<Worker>(*this)) {}

ComparisonLoader::~ComparisonLoader() {
    cancel();  // of both, before either is waited for
}

void ComparisonLoader::cancel() {
    opening_.request_stop();
    query_.cancel();
    comparing_.cancel();
}

void ComparisonLoader::usePair(const ComparisonPair& pair) {
    cancel();
    ComputedPair computed;
    if (pair.first.options) computed.first = std::make_shared<ComputedFrames>(ProjectSession::kTrailLength);
    if (pair.second.options) computed.second = std::make_shared<ComputedFrames>(ProjectSession::kTrailLength);
    opening_ = query_.post([worker = worker_.get(), pair,
                            computed](const BackgroundTask& task) { worker->open(pair, computed, task.stop()); },
                           answers_.fail);
    const auto compare = [this, pair, computed](const BackgroundTask& task) {
        const auto tell = [&](int done, int total) {
            task.tell([this, done, total] { answers_.show_progress(done, total); });
        };
        auto comparison = std::make_shared<const SideComparison>(compareSides(pair, computed, task.stop(), tell));
        task.tell([this, comparison = std::move(comparison)] { answers_.show_comparison(comparison); });
    };
    comparing_.ask(compare, answers_.fail);
}

void ComparisonLoader::request(FrameIndex frame) {
    if (opening_.stop_requested()) return;  // no pair is shown
    query_.ask([worker = worker_.get(), frame](const BackgroundTask& task) { worker->load(frame, task); },
               answers_.fail, BackgroundQuery::Former::finish);
}

}  // namespace eyrie::ui
