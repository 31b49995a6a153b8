#include "tune/compare/comparison_loader.h"

#include <exception>
#include <utility>

#include "canvas/image_convert.h"
#include "io/video/frame_cache.h"
#include "rerun/replay.h"
#include "session/background/queued_call.h"
#include "session/frames/stored_frames.h"
#include "tune/compare/comparison_computation.h"
#include "tune/compare/computed_frames.h"

namespace eyrie::ui {

namespace {

constexpr std::size_t kSidePictureBudget = std::size_t{256} << 20U;
constexpr int kTrailLength = 40;   ///< frames
constexpr int kSideReadAhead = 8;  ///< frames

/// Where the frames of one side come from.
struct SideFrames {
    std::unique_ptr<StoredFrames> stored;
    std::shared_ptr<const ComputedFrames> computed;

    bool open() const { return stored || computed; }
    void addTo(ViewFrame& frame) const {
        if (stored) stored->addTo(frame);
        if (computed) computed->addTo(frame);
    }
    bool prepare(FrameIndex frame) const { return !stored || stored->prepare(frame); }
};

}  // namespace

/// What lives on the loader's thread.
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
                if (wanted.options)
                    made.computed = frames;
                else
                    made.stored = std::make_unique<StoredFrames>(pair.project, wanted.run_id, kTrailLength);
                return made;
            };
            first_ = side(pair.first, computed.first);
            second_ = side(pair.second, computed.second);
            auto source = pair.media.open({}, stop);
            if (stop.stop_requested()) return;
            FrameCacheOptions options;
            options.max_bytes = kSidePictureBudget;
            pictures_ = std::make_unique<FrameCache>(std::move(source), options);
        } catch (const std::exception& error) {
            report(error, stop);
        }
    }

    void load(FrameIndex frame, const std::stop_token& stop) {
        if (!first_.open() || !second_.open() || stop.stop_requested()) return;
        ViewFrame one;
        one.index = frame;
        try {
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
            queuedCall(&owner_, [owner = &owner_, one = std::move(one), other = std::move(other), stop] {
                if (!stop.stop_requested()) emit owner->loaded(one, other);
            });
            readAhead(frame + 1, kSideReadAhead);
        } catch (const std::exception& error) {
            report(error, stop);
        }
    }

 private:
    void readAhead(FrameIndex frame, int left) {
        if (left == 0) return;
        owner_.thread_.postIdle([this, frame, left](const std::stop_token&) {
            try {
                if (!first_.open() || !second_.open()) return;
                if (!first_.prepare(frame) || !second_.prepare(frame)) return;
            } catch (const std::exception&) {
                return;  // told when the frame is asked for
            }
            readAhead(frame + 1, left - 1);
        });
    }

    void report(const std::exception& error, const std::stop_token& stop) {
        if (stop.stop_requested()) return;
        queuedCall(&owner_,
                   [owner = &owner_, message = QString::fromUtf8(error.what())] { emit owner->failed(message); });
    }

    ComparisonLoader& owner_;
    std::unique_ptr<FrameCache> pictures_;
    SideFrames first_;
    SideFrames second_;
};

ComparisonLoader::ComparisonLoader(QObject* parent) : QObject(parent), worker_(std::make_unique<Worker>(*this)) {}

ComparisonLoader::~ComparisonLoader() {
    cancel();
}

void ComparisonLoader::cancel() {
    pair_.request_stop();
}

void ComparisonLoader::usePair(const ComparisonPair& pair) {
    cancel();
    pair_ = std::stop_source();
    const std::stop_token stop = pair_.get_token();
    ComputedPair computed;
    if (pair.first.options) computed.first = std::make_shared<ComputedFrames>(kTrailLength);
    if (pair.second.options) computed.second = std::make_shared<ComputedFrames>(kTrailLength);
    thread_.post(
        [worker = worker_.get(), pair, computed, stop](const std::stop_token&) { worker->open(pair, computed, stop); });
    comparing_.postNewest([this, pair, computed, stop](const std::stop_token&) {
        try {
            const auto tell = [this, stop](int done, int total) {
                queuedCall(this, [this, stop, done, total] {
                    if (!stop.stop_requested()) emit this->computed(done, total);
                });
            };
            auto comparison = std::make_shared<const SideComparison>(compareSides(pair, computed, stop, tell));
            if (stop.stop_requested()) return;
            queuedCall(this, [this, comparison = std::move(comparison), stop] {
                if (!stop.stop_requested()) emit compared(comparison);
            });
        } catch (const std::exception& error) {
            queuedCall(this, [this, stop, message = QString::fromUtf8(error.what())] {
                if (!stop.stop_requested()) emit failed(message);
            });
        }
    });
}

void ComparisonLoader::request(FrameIndex frame) {
    thread_.postNewest([worker = worker_.get(), frame, stop = pair_.get_token()](const std::stop_token&) {
        worker->load(frame, stop);
    });
}

}  // namespace eyrie::ui
