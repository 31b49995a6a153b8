#include "tune/inspect/why.h"

#include <limits>

#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

/// The smallest box under a point, of tracks first, then detections, then clusters.
std::optional<OrientedBox> boxAt(const FrameResult& result, cv::Point2d point, double margin,
                                 std::optional<TrackId>& track) {
    std::optional<OrientedBox> found;
    double smallest = std::numeric_limits<double>::max();
    const auto consider = [&](const OrientedBox& box) {
        if (box.area() >= smallest || !box.contains(point, margin)) return false;
        smallest = box.area();
        found = box;
        return true;
    };
    for (const TrackState& state : result.tracks)
        if (consider(state.box)) track = state.id;
    if (found) return found;
    for (const Detection& detection : result.detections) consider(detection.box);
    if (found) return found;
    for (const MotionCluster& cluster : result.clusters) consider(cluster.box);
    return found;
}

}  // namespace

Why::Why(ProjectSession& session, QObject* parent)
    : QObject(parent),
      session_(session),
      loader_({
          .show = [this](const auto& view) { adopt(view, {}); },
          .fail = [this](const QString& message) { adopt(nullptr, message); },
      }) {
    whenChanged(session_, this,
                {{SessionChange::current_run, [this] { runChanged(); }},
                 {SessionChange::picture, [this] { frameShown(); }},
                 {SessionChange::following, [this] { emit changed(); }}});
    runChanged();
}

void Why::adopt(const std::shared_ptr<const ExplanationView>& view, const QString& problem) {
    view_ = view;
    waiting_ = false;
    problem_ = problem;
    emit changed();
}

void Why::want(bool wanted) {
    if (std::exchange(wanted_, wanted) != wanted && wanted) request();
}

void Why::ask(QPointF image_point, double margin) {
    const auto& result = session_.viewFrame().result;
    const cv::Point2d point(image_point.x(), image_point.y());
    about_.clear();
    track_.reset();
    area_.reset();
    if (result) area_ = boxAt(*result, point, margin, track_);
    if (!area_) area_ = placeAt(point, session_.scale().in(session_.viewFrame().index));
    request();
}

void Why::askAbout(const OrientedBox& box, const QString& about) {
    about_ = about;
    track_.reset();
    area_ = box;
    view_.reset();
    request();
}

void Why::clear() {
    loader_.cancel();
    about_.clear();
    area_.reset();
    track_.reset();
    view_.reset();
    waiting_ = false;
    problem_.clear();
    emit changed();
}

void Why::runChanged() {
    clear();
    if (session_.currentRun() && session_.media())
        loader_.useRun(ReplayRun{*session_.media(), session_.project(), *session_.currentRun()});
    else
        loader_.useRun(std::nullopt);
}

void Why::frameShown() {
    if (!area_) return;
    const auto& result = session_.viewFrame().result;
    if (track_ && result) {
        for (const TrackState& state : result->tracks)
            if (state.id == *track_) area_ = state.box;
    }
    if (!view_ || view_->frame != session_.viewFrame().index) request();
}

void Why::request() {
    problem_.clear();
    const ViewFrame& frame = session_.viewFrame();
    // A run at work needs the processor for itself; playing, no answer would come in time.
    const bool can = wanted_ && area_ && frame.result && !session_.following() && !session_.playback().playing();
    waiting_ = can;
    if (can && frame.index != session_.currentFrame())
        loader_.cancel();  // asked when the frame has come
    else if (can)
        loader_.ask(frame.index, *area_);
    else
        loader_.cancel();
    emit changed();
}

}  // namespace eyrie::ui

#include "moc_why.cpp"
