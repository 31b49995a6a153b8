#include "session/frames/result_loader.h"

#include <chrono>
#include <exception>
#include <utility>

#include "canvas/image_convert.h"
#include "io/video/frame_cache.h"
#include "session/background/queued_call.h"
#include "session/frames/stored_frames.h"

namespace eyrie::ui {

namespace {
constexpr std::size_t kPictureBudget = std::size_t{384} << 20U;
constexpr int kReadAhead = 10;  ///< frames
constexpr auto kProgressInterval = std::chrono::milliseconds(60);
}  // namespace

/// What lives on the loader's thread.
class ResultLoader::Worker {
 public:
    explicit Worker(ResultLoader& owner) : owner_(owner) {}

    void open(const Media& media, int ticket, const std::stop_token& stop) {
        try {
            auto last = std::chrono::steady_clock::time_point{};
            const auto progress = [&](double share) {
                const auto now = std::chrono::steady_clock::now();
                if (now - last < kProgressInterval) return;
                last = now;
                queuedCall(&owner_, [owner = &owner_, share] { emit owner->openingProgress(share); });
            };
            auto source = media.open(progress, stop);
            if (stop.stop_requested()) return;
            OpenedVideo video{source->info(), {}, media.gsd_m_per_px()};
            for (FrameIndex f = 0; f < video.info.frame_count; ++f) video.times_us.push_back(source->timeOf(f));
            close();
            FrameCacheOptions options;
            options.max_bytes = kPictureBudget;
            pictures_ = std::make_unique<FrameCache>(std::move(source), options);
            queuedCall(&owner_,
                       [owner = &owner_, ticket, video = std::move(video)] { emit owner->opened(ticket, video); });
        } catch (const std::exception& error) {
            if (stop.stop_requested()) return;
            queuedCall(&owner_, [owner = &owner_, ticket, message = QString::fromUtf8(error.what())] {
                emit owner->openFailed(ticket, message);
            });
        }
    }

    void close() { pictures_.reset(); }

    void useRun(const std::optional<RunReference>& run, int trail_length) {
        frames_.reset();
        if (!run) return;
        try {
            frames_ = std::make_unique<StoredFrames>(run->project, run->run_id, trail_length);
        } catch (const std::exception& error) {
            report(-1, error);
        }
    }

    void load(FrameIndex frame, int direction) {
        ViewFrame view;
        view.index = frame;
        const bool has_picture = pictures_ && frame < pictures_->info().frame_count;
        if (has_picture) pictures_->tryGet(frame);  // decoded on its own thread while the result is read here
        try {
            if (frames_) frames_->addTo(view);
        } catch (const std::exception& error) {
            report(frame, error);
        }
        try {
            if (has_picture) {
                view.time_us = pictures_->timeOf(frame);
                const auto picture = pictures_->get(frame);
                view.image = imageForDisplay(picture->colour.empty() ? picture->gray : picture->colour);
            }
        } catch (const std::exception& error) {
            report(frame, error);
        }
        queuedCall(&owner_, [owner = &owner_, view = std::move(view)] { emit owner->frameLoaded(view); });
        if (direction != 0) readAhead(frame + direction, direction, kReadAhead);
    }

    /// Results of the frames to come; the pictures are read ahead by their cache.
    void readAhead(FrameIndex frame, int direction, int left) {
        if (left == 0 || !frames_ || frame < 0) return;
        owner_.thread_.postIdle([this, frame, direction, left](const std::stop_token&) {
            try {
                if (!frames_ || !frames_->prepare(frame)) return;
            } catch (const std::exception&) {
                return;  // told when the frame is asked for
            }
            readAhead(frame + direction, direction, left - 1);
        });
    }

 private:
    void report(FrameIndex frame, const std::exception& error) {
        queuedCall(&owner_, [owner = &owner_, frame, message = QString::fromUtf8(error.what())] {
            emit owner->frameFailed(frame, message);
        });
    }

    ResultLoader& owner_;
    std::unique_ptr<FrameCache> pictures_;
    std::unique_ptr<StoredFrames> frames_;
};

ResultLoader::ResultLoader(QObject* parent) : QObject(parent), worker_(std::make_unique<Worker>(*this)) {}

ResultLoader::~ResultLoader() {
    opening_.request_stop();
}

void ResultLoader::openMedia(const Media& media, int ticket) {
    opening_.request_stop();
    opening_ = std::stop_source();
    thread_.post([worker = worker_.get(), media, ticket, stop = opening_.get_token()](const std::stop_token&) {
        if (!stop.stop_requested()) worker->open(media, ticket, stop);
    });
}

void ResultLoader::cancelOpening() {
    opening_.request_stop();
}

void ResultLoader::closeMedia() {
    opening_.request_stop();
    thread_.post([worker = worker_.get()](const std::stop_token&) { worker->close(); });
}

void ResultLoader::useRun(std::optional<RunReference> run, int trail_length) {
    thread_.post([worker = worker_.get(), run = std::move(run), trail_length](const std::stop_token&) {
        worker->useRun(run, trail_length);
    });
}

void ResultLoader::request(FrameIndex frame, int direction) {
    thread_.postNewest(
        [worker = worker_.get(), frame, direction](const std::stop_token&) { worker->load(frame, direction); });
}

}  // namespace eyrie::ui
