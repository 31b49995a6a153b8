#include "tune/inspect/inspection.h"

#include <functional>

#include "tune/inspect/cluster_choice.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

Inspection::Inspection(ProjectSession& session, QObject* parent)
    : QObject(parent),
      session_(session),
      loader_({
          .show_progress = std::bind_front(&Inspection::showProgress, this),
          .show = std::bind_front(&Inspection::showView, this),
          .fail = std::bind_front(&Inspection::showProblem, this),
      }) {
    whenChanged(session_, this,
                {{SessionChange::current_run, [this] { runChanged(); }},
                 {SessionChange::picture, [this] { frameShown(); }},
                 {SessionChange::selection,
                  [this] {
                      if (session_.selectedTrack()) chosen_ = false;  // one selection: the track's
                      frameShown();
                  }},
                 {SessionChange::following, [this] {
                      request();
                      emit changed(InspectionChange::choice);
                  }}});
    runChanged();
}

void Inspection::showProgress(FrameIndex frame, int left) {
    if (frame != session_.shownFrame()) return;
    frames_left_ = left;
    emit changed(InspectionChange::progress);
}

void Inspection::showView(const std::shared_ptr<const ReplayView>& view) {
    view_ = view;
    problem_.clear();
    emit changed(InspectionChange::view);
}

void Inspection::showProblem(const QString& message) {
    view_.reset();
    problem_ = message;
    emit changed(InspectionChange::choice);
}

void Inspection::wantStages(bool wanted) {
    if (std::exchange(stages_wanted_, wanted) != wanted) request();
}

void Inspection::wantStacks(StackPictures pictures) {
    if (std::exchange(stacks_wanted_, pictures) != pictures) request();
}

void Inspection::wantStackOverlay(bool wanted) {
    if (std::exchange(overlay_wanted_, wanted) != wanted) request();
}

void Inspection::wantGeneralSegmentation(bool wanted) {
    if (std::exchange(general_wanted_, wanted) != wanted) request();
}

void Inspection::choose(QPointF image_point, double margin) {
    const auto& result = session_.viewFrame().result;
    setCluster(result ? clusterAt(*result, image_point, margin) : std::nullopt);
}

void Inspection::step(int clusters) {
    const auto& result = session_.viewFrame().result;
    if (!result || result->clusters.empty()) return;
    const int count = static_cast<int>(result->clusters.size());
    const int next = cluster_ ? (*cluster_ + clusters % count + count) % count : 0;
    session_.selectTrack(std::nullopt);
    setCluster(next);
}

void Inspection::clear() {
    session_.selectTrack(std::nullopt);
    setCluster(std::nullopt);
}

std::optional<OrientedBox> Inspection::area() const {
    const auto& result = session_.viewFrame().result;
    if (!cluster_ || !result) return std::nullopt;
    const auto index = static_cast<std::size_t>(*cluster_);
    if (index < result->rois.size() && result->rois[index].area() > 0) return result->rois[index];
    return index < result->clusters.size() ? std::optional(result->clusters[index].box) : std::nullopt;
}

void Inspection::runChanged() {
    chosen_ = false;
    cluster_.reset();
    view_.reset();
    problem_.clear();
    if (session_.currentRun() && session_.media())
        loader_.useRun(ReplayRun{*session_.media(), session_.project(), *session_.currentRun()});
    else
        loader_.useRun(std::nullopt);
    emit changed(InspectionChange::choice);
}

void Inspection::frameShown() {
    resolve();
    request();
}

void Inspection::resolve() {
    const auto& result = session_.viewFrame().result;
    std::optional<int> cluster;
    if (result && session_.selectedTrack())
        cluster = clusterOfTrack(*result, *session_.selectedTrack());
    else if (result && chosen_ && !corners_.empty())
        cluster = clusterWith(*result, corners_);
    else if (result && chosen_)
        cluster = clusterAt(*result, {place_.centre.x, place_.centre.y}, place_.length / 2);
    if (cluster) remember(*result, *cluster);
    cluster_ = cluster;
    emit changed(InspectionChange::choice);
}

void Inspection::setCluster(std::optional<int> cluster) {
    const auto& result = session_.viewFrame().result;
    chosen_ = result && cluster;
    if (chosen_) remember(*result, *cluster);
    cluster_ = cluster;
    emit changed(InspectionChange::choice);
    request();
}

void Inspection::remember(const FrameResult& result, int cluster) {
    corners_ = cornersOf(result, cluster);
    place_ = result.clusters[static_cast<std::size_t>(cluster)].box;
}

void Inspection::request() {
    const ViewFrame& frame = session_.viewFrame();
    const bool wanted = stages_wanted_ || stacks_wanted_ != StackPictures::none || overlay_wanted_;
    // A run at work needs the processor for itself, and its newest frames are gone before they could be replayed.
    if (!wanted || !frame.result || session_.following()) {
        loader_.cancel();
        return;
    }
    loader_.request(
        {frame.index, stages_wanted_ && cluster_ ? *cluster_ : -1, stages_wanted_ && general_wanted_, stacks_wanted_});
}

QString Inspection::progressText() const {
    return tr("%1 frames before this one are replayed…").arg(frames_left_);
}

QString Inspection::waitingText() const {
    return tr("This frame is being replayed…");
}

}  // namespace eyrie::ui

#include "moc_inspection.cpp"
