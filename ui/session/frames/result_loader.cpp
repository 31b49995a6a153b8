#include "session/frames/result_loader.h"

#include <chrono>
#include <exception>
#include <string>
#include <utility>

#include "canvas/drawing/image_convert.h"
#include "io/video/ahead/expected_frames.h"
#include "io/video/frame_cache.h"
#include "session/frames/picture_budget.h"
#include "session/frames/stored_frames.h"

namespace eyrie::ui {

namespace {
constexpr int kReadAhead = 10;  ///< frames
constexpr auto kProgressInterval = std::chrono::milliseconds(60);
}  // namespace

/// What is used in the background alone.
class ResultLoader::Worker {
 public:
    explicit Worker(ResultLoader& owner) : owner_(owner) {}

    void open(const Media& media, int ticket, const BackgroundTask& task) {
        try {
            auto last = std::chrono::steady_clock::time_point{};
            const auto progress = [&](double share) {
                const auto now = std::chrono::steady_clock::now();
                if (now - last < kProgressInterval) return;
                last = now;
                task.tell([this, share] { emit owner_.openingProgress(share); });
            };
            auto source = media.open(progress, task.stop());
            if (task.stop().stop_requested()) return;
            OpenedVideo video{source->info(), {}, media.gsd_m_per_px()};
            for (FrameIndex f = 0; f < video.info.frame_count; ++f) video.times_us.push_back(source->timeOf(f));
            close();
            FrameCacheOptions options;
            options.max_bytes = pictureBudget(PictureUse::review);
            pictures_ = std::make_unique<FrameCache>(std::move(source), options);
            task.tell([this, ticket, video = std::move(video)] { emit owner_.opened(ticket, video); });
        } catch (const std::exception&) {
            if (!task.stop().stop_requested()) throw;
        }
    }

    void close() {
        expected_.reset();
        pictures_.reset();
    }

    void expect(const Media& media, std::vector<FrameIndex> frames) {
        if (!pictures_) return;
        if (!frames.empty() && (!expected_ || expected_of_ != media.identity)) {
            expected_of_ = media.identity;
            expected_ = std::make_unique<ExpectedFrames>(
                *pictures_, [open = media.open](const std::stop_token& stop) { return open({}, stop); });
        }
        pictures_->expect(std::move(frames));
    }

    void useRun(const std::optional<RunReference>& run, int trail_length) {
        frames_.reset();
        if (run) frames_ = std::make_unique<StoredFrames>(run->project, run->run_id, trail_length, run->corrected);
    }

    void setLook(const PictureLook& look) { look_ = look; }

    void load(FrameIndex frame, int direction, const BackgroundTask& task) {
        ViewFrame view;
        view.index = frame;
        const bool has_picture = pictures_ && frame < pictures_->info().frame_count;
        if (has_picture) pictures_->tryGet(frame);  // decoded on its own thread while the result is read here
        try {
            if (frames_) frames_->addTo(view);
        } catch (const std::exception& error) {
            report(frame, error, task);
        }
        try {
            if (has_picture) {
                view.time_us = pictures_->timeOf(frame);
                const auto picture = pictures_->get(frame);
                view.image =
                    imageForDisplay(withLook(picture->colour.empty() ? picture->gray : picture->colour, look_));
            }
        } catch (const std::exception& error) {
            report(frame, error, task);
        }
        task.tell([this, view = std::move(view)] { emit owner_.frameLoaded(view); });
        if (direction != 0) readAhead(frame + direction, direction, kReadAhead);
    }

    /// Results of the frames to come; the pictures are read ahead by their cache.
    void readAhead(FrameIndex frame, int direction, int left) {
        if (left == 0 || !frames_ || frame < 0) return;
        owner_.query_.whenIdle([this, frame, direction, left](const BackgroundTask&) {
            if (frames_ && frames_->prepare(frame)) readAhead(frame + direction, direction, left - 1);
        });  // what is wrong with a frame is told when it is asked for
    }

 private:
    void report(FrameIndex frame, const std::exception& error, const BackgroundTask& task) {
        task.tell(
            [this, frame, message = QString::fromUtf8(error.what())] { emit owner_.frameFailed(frame, message); });
    }

    ResultLoader& owner_;
    std::unique_ptr<FrameCache> pictures_;
    std::string expected_of_;                   ///< identity of the media
    std::unique_ptr<ExpectedFrames> expected_;  ///< after the cache
    std::unique_ptr<StoredFrames> frames_;
    PictureLook look_;
};

ResultLoader::ResultLoader(QObject* parent) : QObject(parent), worker_(std::make_unique<Worker>(*this)) {}

ResultLoader::~ResultLoader() = default;

void ResultLoader::openMedia(const Media& media, int ticket) {
    opening_.request_stop();
    opening_ = query_.post(
        [worker = worker_.get(), media, ticket](const BackgroundTask& task) {
            if (!task.stop().stop_requested()) worker->open(media, ticket, task);
        },
        [this, ticket](const QString& message) { emit openFailed(ticket, message); });
}

void ResultLoader::cancelOpening() {
    opening_.request_stop();
}

void ResultLoader::closeMedia() {
    opening_.request_stop();
    query_.post([worker = worker_.get()](const BackgroundTask&) { worker->close(); });
}

void ResultLoader::useRun(std::optional<RunReference> run, int trail_length) {
    query_.post([worker = worker_.get(), run = std::move(run),
                 trail_length](const BackgroundTask&) { worker->useRun(run, trail_length); },
                [this](const QString& message) { emit frameFailed(-1, message); });
}

void ResultLoader::setLook(const PictureLook& look) {
    query_.post([worker = worker_.get(), look](const BackgroundTask&) { worker->setLook(look); });
}

void ResultLoader::expect(const Media& media, std::vector<FrameIndex> frames) {
    query_.post([worker = worker_.get(), media, frames = std::move(frames)](const BackgroundTask&) {
        worker->expect(media, frames);
    });
}

void ResultLoader::request(FrameIndex frame, int direction) {
    query_.ask([worker = worker_.get(), frame,
                direction](const BackgroundTask& task) { worker->load(frame, direction, task); },
               {}, BackgroundQuery::Former::finish);
}

}  // namespace eyrie::ui

#include "moc_result_loader.cpp"
