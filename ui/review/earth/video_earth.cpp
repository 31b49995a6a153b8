#include "review/earth/video_earth.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "core/time/utc_time.h"
#include "events/stored_events.h"
#include "session/background/pace.h"
#include "store/labels/annotation_store.h"
#include "store/project/video_start.h"
#include "store/review/control_points.h"
#include "widgets/display_text.h"
#include "workspace/session_reactions.h"

namespace eyrie::ui {

namespace {

/// What a person said of when and where a video was taken.
struct SaidOfVideo {
    std::vector<ControlPoint> control;
    std::optional<std::int64_t> start_us;
};

/// Of the video of this identity; nothing where the project cannot be read.
SaidOfVideo saidOf(const std::filesystem::path& path, const std::string& identity) {
    if (path.empty()) return {};
    try {
        ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
        for (const SequenceRecord& sequence : sequencesOf(project))
            if (sequence.path == identity)
                return {readControlPoints(project, sequence.id), videoStartOf(project, sequence.id)};
    } catch (const Error&) {
        // Told by whoever shows the project; places are a help besides.
    }
    return {};
}

}  // namespace

VideoEarth::VideoEarth(ProjectSession& session, QObject* parent) : QObject(parent), session_(session) {
    followSession(session_, this,
                  {{SessionChange::video, [this] { readMetadata(); }},
                   {{SessionChange::project, SessionChange::opened}, [this] { layOnEarth(); }},
                   {SessionChange::runs, [this] {
                        // The lists of the project are there anew. Compared with what is known here, not with the lists
                        // before: the file may have been read in between.
                        if (session_.givenStart() != given_start_us_ || session_.givenControl() != control_)
                            layOnEarth();
                    }}});
}

VideoEarth::~VideoEarth() = default;

void VideoEarth::setRun(const std::shared_ptr<const StoredTracks>& run) {
    if (run == run_) return;
    run_ = run;
    layOnEarth();
}

// ---- metadata -------------------------------------------------------------------------------------------------------

void VideoEarth::readMetadata() {
    metadata_query_.cancel();
    world_query_.cancel();
    found_.reset();
    world_.reset();
    given_start_us_.reset();
    control_.clear();
    read_share_ = 0;
    viewed_ = -1;
    setClock();
    emit changed();
    if (!session_.media()) return;
    const auto work = [this, media = *session_.media()](const BackgroundTask& task) {
        const auto source = media.open({}, task.stop());
        Pace pace;
        FoundMetadata found = metadataOf(*source, task.stop(), [&](double share) {
            if (!pace.isDue()) return;
            task.tell([this, share] {
                read_share_ = share;
                emit readOn();
            });
        });
        task.tell([this, found = std::move(found)] { adopt(found); });
    };
    metadata_query_.ask(work, [this](const QString& message) {
        adopt(FoundMetadata{nullptr, message.toStdString(), {}});
    });
}

void VideoEarth::adopt(FoundMetadata found) {
    found_ = std::make_shared<const FoundMetadata>(std::move(found));
    setClock();
    emit changed();
    layOnEarth();
}

void VideoEarth::setClock() {
    clock_ = {};
    if (found_)
        clock_ = VideoClock::of(*found_, given_start_us_);
    else if (given_start_us_ && session_.video() && session_.video()->parts.empty())
        // Of several parts the metadata tell what was not recorded between them.
        clock_ = VideoClock::startingAt(*given_start_us_);
    emit clockChanged();
}

std::optional<MetadataState> VideoEarth::stateOf(const VideoMetadata& stream, FrameIndex frame) const {
    const auto& times = session_.timesUs();
    if (frame < 0 || static_cast<std::size_t>(frame) >= times.size()) return std::nullopt;
    return stream.timeline().at(times[static_cast<std::size_t>(frame)]);
}

std::optional<std::int64_t> VideoEarth::momentOf(FrameIndex frame) const {
    const auto& times = session_.timesUs();
    if (frame < 0 || static_cast<std::size_t>(frame) >= times.size()) return std::nullopt;
    return clock_.at(times[static_cast<std::size_t>(frame)]);
}

ClockOfFrames VideoEarth::clock() const {
    return {.time =
                [this](FrameIndex frame) {
                    const auto utc_us = momentOf(frame);
                    return utc_us ? QString::fromStdString(timeOfDayText(*utc_us)) : QString();
                },
            .text = [this](FrameIndex frame) { return clockText(frame); },
            .origin = [this] { return clockOrigin(); },
            .frame_of_day = [this](double seconds, double near) { return frameOfDay(seconds, near); }};
}

std::optional<FrameIndex> VideoEarth::frameOfDay(double seconds, double near) const {
    constexpr std::int64_t kDay_us = 86'400'000'000;
    const auto& times = session_.timesUs();
    if (times.empty()) return std::nullopt;
    const auto begin = clock_.at(times.front()), end = clock_.at(times.back());
    if (!begin || !end) return std::nullopt;
    std::int64_t midnight = *begin - *begin % kDay_us;
    const std::int64_t middle = midnight + std::llround(near * 1e6);
    // The day after or before, where that is nearer to the video.
    if (middle < *begin && middle + kDay_us - *end < *begin - middle) midnight += kDay_us;
    if (middle > *end && *begin - (middle - kDay_us) < middle - *end) midnight -= kDay_us;
    const std::int64_t wanted = midnight + std::llround(seconds * 1e6);
    const auto place = std::partition_point(times.begin(), times.end(), [&](std::int64_t video_us) {
        const auto utc_us = clock_.at(video_us);
        return utc_us && *utc_us < wanted;
    });
    return static_cast<FrameIndex>(place - times.begin());
}

QString VideoEarth::clockText(FrameIndex frame) const {
    const auto utc_us = momentOf(frame);
    return utc_us ? utcMomentText(*utc_us) : QString();
}

const GroundView* VideoEarth::viewOf(FrameIndex frame) const {
    if (!found_ || !found_->metadata || !session_.video()) return nullptr;
    if (viewed_ != frame) {
        const auto state = stateOf(*found_->metadata, frame);
        view_ = state ? groundViewOf(*state, session_.video()->size) : GroundView();
        viewed_ = frame;
    }
    return &view_;
}

// ---- places ---------------------------------------------------------------------------------------------------------

void VideoEarth::layOnEarth() {
    if (!session_.video() || !session_.media()) return;
    GeoFootage footage;
    footage.image_size = session_.video()->size;
    footage.last_frame = session_.video()->frame_count - 1;
    footage.frame_rate_hz = session_.video()->frame_rate_hz;
    const auto work = [this, found = found_, run = run_, footage = std::move(footage), times = session_.timesUs(),
                       project = session_.project(),
                       identity = session_.media()->identity](const BackgroundTask& task) mutable {
        const SaidOfVideo said = saidOf(project, identity);
        footage.control = said.control;
        // At once: places take a while, and may not come at all.
        task.tell([this, start_us = said.start_us] {
            if (std::exchange(given_start_us_, start_us) != start_us) setClock();
        });
        if (run) {
            footage.first_frame = run->footage.first_frame;
            footage.last_frame = std::min(footage.last_frame, run->footage.last_frame);
            footage.camera = run->footage.camera;
        }
        footage.time_us = [&times](FrameIndex frame) { return times.at(static_cast<std::size_t>(frame)); };
        // Without registration there is nothing to steady each frame's own statement with.
        const FoundMetadata used = run && found ? *found : FoundMetadata();
        auto world = std::make_shared<const VideoWorld>(videoWorldOf(used, std::move(footage)));
        task.tell([this, world, control = said.control] {
            world_ = world;
            control_ = control;
            emit changed();
        });
    };
    world_query_.ask(work, [this](const QString&) {
        world_.reset();
        emit changed();
    });
}

std::optional<GeoPoint> VideoEarth::placeOf(FrameIndex frame, QPointF px) const {
    const cv::Point2d at(px.x(), px.y());
    if (world_) {
        const auto place = world_->places.placeOf(frame, at);
        if (place || world_->places.isByHand()) return place;
    }
    const GroundView* view = viewOf(frame);
    return view != nullptr ? view->placeOf(at) : std::nullopt;
}

std::optional<QPointF> VideoEarth::carried(QPointF px, FrameIndex from, FrameIndex to) const {
    if (from == to) return px;
    const auto map = run_ ? run_->footage.camera.map(from, to) : std::nullopt;
    if (!map) return std::nullopt;
    const cv::Vec3d at = map->matrix * cv::Vec3d(px.x(), px.y(), 1);
    if (!(at[2] * map->matrix(2, 2) > 0)) return std::nullopt;  // behind the camera
    return QPointF(at[0] / at[2], at[1] / at[2]);
}

std::optional<double> VideoEarth::northOf(FrameIndex frame) const {
    if (world_) {
        const auto north = world_->places.northOf(frame);
        if (north || world_->places.isByHand()) return north;
    }
    const GroundView* view = viewOf(frame);
    return view != nullptr ? view->north_deg : std::nullopt;
}

std::optional<double> VideoEarth::courseOf(FrameIndex frame, QPointF px, double heading) const {
    constexpr double kStep_px = 4;  // far enough for what places are rounded to, near enough for any perspective
    const auto here = placeOf(frame, px);
    const auto ahead = placeOf(frame, px + kStep_px * QPointF(std::cos(heading), std::sin(heading)));
    if (!here || !ahead || *here == *ahead) return std::nullopt;
    const cv::Point2d way = LocalPlane(*here).metresOf(*ahead);
    return degreesFromRadians(std::atan2(way.x, way.y));
}

QString VideoEarth::origin() const {
    if (world_ && world_->places.known()) return QString::fromStdString(world_->places.origin());
    const GroundView* view = viewOf(session_.shownFrame());
    if (view == nullptr || !view->footprint) return {};
    return tr("%1 in the metadata of the frame").arg(QString::fromUtf8(nameOf(view->source)));
}

}  // namespace eyrie::ui

#include "moc_video_earth.cpp"
