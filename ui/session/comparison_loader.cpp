#include "session/comparison_loader.h"

#include <exception>
#include <utility>

#include "chain/replay.h"
#include "io/frame_cache.h"
#include "session/queued_call.h"
#include "session/stored_frames.h"
#include "view/image_convert.h"

namespace eyrie::ui {

namespace {

constexpr std::size_t kPictureBudget = std::size_t{256} << 20U;
constexpr int kTrailLength = 40;  ///< frames
constexpr int kReadAhead = 8;     ///< frames

RunComparison compare(const RunPair& pair, const std::stop_token& stop) {
    ProjectFile project = ProjectFile::open(pair.project, ProjectFile::Mode::read_only);
    const RunStore store(project);
    RunComparison comparison;
    comparison.parameters =
        differencesBetween(storedOptions(store.parameters(pair.first)), storedOptions(store.parameters(pair.second)));
    if (stop.stop_requested()) return comparison;
    comparison.tracks = differencesOf(store.trackBoxes(pair.first), store.trackBoxes(pair.second));
    if (stop.stop_requested()) return comparison;
    comparison.detections = differencesOf(store.detectionBoxes(pair.first), store.detectionBoxes(pair.second));
    return comparison;
}

}  // namespace

/// What lives on the loader's thread.
class ComparisonLoader::Worker {
 public:
    explicit Worker(ComparisonLoader& owner) : owner_(owner) {}

    void open(const RunPair& pair, const std::stop_token& stop) {
        pictures_.reset();
        first_.reset();
        second_.reset();
        try {
            first_ = std::make_unique<StoredFrames>(pair.project, pair.first, kTrailLength);
            second_ = std::make_unique<StoredFrames>(pair.project, pair.second, kTrailLength);
            auto source = pair.media.open({}, stop);
            if (stop.stop_requested()) return;
            FrameCacheOptions options;
            options.max_bytes = kPictureBudget;
            pictures_ = std::make_unique<FrameCache>(std::move(source), options);
        } catch (const std::exception& error) {
            report(error, stop);
        }
    }

    void load(FrameIndex frame, const std::stop_token& stop) {
        if (!first_ || !second_ || stop.stop_requested()) return;
        ViewFrame one;
        one.index = frame;
        try {
            const bool has_picture = pictures_ && frame < pictures_->info().frame_count;
            if (has_picture) pictures_->tryGet(frame);  // decoded on its own thread while results are read here
            ViewFrame other = one;
            first_->addTo(one);
            second_->addTo(other);
            if (has_picture) {
                const auto picture = pictures_->get(frame);
                one.image = imageForDisplay(picture->colour.empty() ? picture->gray : picture->colour);
                one.time_us = other.time_us = pictures_->timeOf(frame);
                other.image = one.image;
            }
            queuedCall(&owner_, [owner = &owner_, one = std::move(one), other = std::move(other)] {
                emit owner->loaded(one, other);
            });
            readAhead(frame + 1, kReadAhead);
        } catch (const std::exception& error) {
            report(error, stop);
        }
    }

 private:
    void readAhead(FrameIndex frame, int left) {
        if (left == 0) return;
        owner_.thread_.postIdle([this, frame, left](const std::stop_token&) {
            try {
                if (!first_ || !second_) return;
                if (!first_->prepare(frame) || !second_->prepare(frame)) return;
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
    std::unique_ptr<StoredFrames> first_;
    std::unique_ptr<StoredFrames> second_;
};

ComparisonLoader::ComparisonLoader(QObject* parent) : QObject(parent), worker_(std::make_unique<Worker>(*this)) {}

ComparisonLoader::~ComparisonLoader() {
    pair_.request_stop();
}

void ComparisonLoader::usePair(const RunPair& pair) {
    pair_.request_stop();
    pair_ = std::stop_source();
    const std::stop_token stop = pair_.get_token();
    thread_.post([worker = worker_.get(), pair, stop](const std::stop_token&) { worker->open(pair, stop); });
    comparing_.postNewest([this, pair, stop](const std::stop_token&) {
        try {
            auto comparison = std::make_shared<const RunComparison>(compare(pair, stop));
            if (stop.stop_requested()) return;
            queuedCall(this, [this, comparison = std::move(comparison), stop] {
                if (!stop.stop_requested()) emit compared(comparison);
            });
        } catch (const std::exception& error) {
            queuedCall(this, [this, message = QString::fromUtf8(error.what())] { emit failed(message); });
        }
    });
}

void ComparisonLoader::request(FrameIndex frame) {
    thread_.postNewest([worker = worker_.get(), frame, stop = pair_.get_token()](const std::stop_token&) {
        worker->load(frame, stop);
    });
}

}  // namespace eyrie::ui
