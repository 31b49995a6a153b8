#include "tune/compare/live_preview.h"

#include <functional>

#include "rerun/replay.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

std::vector<ParameterDifference> differencesBetween(const ChainOptions& first, const ChainOptions& second) {
    const auto a = parameterValues(first);
    const auto b = parameterValues(second);
    std::vector<ParameterDifference> differences;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].second != b[i].second) differences.push_back({a[i].first, a[i].second, b[i].second});
    return differences;
}

LivePreview::LivePreview(ProjectSession& session, QObject* parent)
    : QObject(parent),
      session_(session),
      loader_({
          .show = std::bind_front(&LivePreview::showView, this),
          .show_progress = std::bind_front(&LivePreview::showProgress, this),
          .fail = std::bind_front(&LivePreview::showProblem, this),
      }) {
    const auto use_run = [this] {
        end();
        if (session_.currentRun() && session_.media())
            loader_.useRun(ReplayRun{*session_.media(), session_.project(), *session_.currentRun()});
        else
            loader_.useRun(std::nullopt);
    };
    whenChanged(session_, this,
                {{SessionChange::current_run, use_run},
                 {SessionChange::run_preparing, [this] { end(); }},
                 {SessionChange::picture, [this] {
                      if (active_ && (!view_ || view_->frame != session_.shownFrame())) request();
                  }}});
    use_run();
}

void LivePreview::showView(const std::shared_ptr<const PreviewView>& view) {
    if (!active_) return;
    view_ = view;
    frames_left_ = view->frames_left;
    problem_.clear();
    emit changed();
}

void LivePreview::showProgress(FrameIndex frame, int left) {
    if (!active_ || frame != session_.shownFrame()) return;
    frames_left_ = left;
    emit changed();
}

void LivePreview::showProblem(const QString& message) {
    if (!active_) return;
    view_.reset();
    problem_ = message;
    emit changed();
}

void LivePreview::setEnabled(bool enabled) {
    if (enabled_ == enabled) return;
    enabled_ = enabled;
    if (enabled)
        parametersEdited();
    else
        end();
}

void LivePreview::setRange(int frames) {
    range_ = std::max(0, frames);
    if (active_) request();
}

void LivePreview::parametersEdited() {
    const auto& run = session_.runData();
    if (!enabled_ || !run || session_.following() || session_.running()) return;
    differences_ = differencesBetween(storedOptions(run->parameters), session_.settings().options);
    if (differences_.empty()) {
        end();
        return;
    }
    active_ = true;
    request();
    emit changed();
}

void LivePreview::warmUp() {
    const ViewFrame& frame = session_.viewFrame();
    if (!enabled_ || !frame.result || session_.following() || session_.running() || session_.playback().playing())
        return;
    loader_.warmUp(frame.index);
}

void LivePreview::discard() {
    end();
}

std::shared_ptr<const PreviewView> LivePreview::view() const {
    return view_ && view_->frame == session_.viewFrame().index ? view_ : nullptr;
}

void LivePreview::end() {
    loader_.cancel();
    if (!active_) return;
    active_ = false;
    view_.reset();
    differences_.clear();
    frames_left_ = 0;
    problem_.clear();
    emit changed();
}

void LivePreview::request() {
    problem_.clear();
    const ViewFrame& frame = session_.viewFrame();
    if (!frame.result || session_.following()) return;
    // Playing, only the frame itself: its tracks would come too late.
    loader_.request(frame.index, session_.settings().options, session_.playback().playing() ? 0 : range_);
}

}  // namespace eyrie::ui

#include "moc_live_preview.cpp"
