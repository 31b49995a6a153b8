#include "workspace/timeline_binding.h"

#include <QStringList>
#include <algorithm>
#include <utility>

#include "canvas/timeline/timeline_view.h"
#include "widgets/charts/stage_times_chart.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

TimelineFrame timelineFrame(const FrameSummary& frame) {
    return {.done = true,
            .state = frame.state,
            .rms_px = frame.rms_px,
            .inliers = frame.inliers,
            .corners = frame.corners,
            .motion_vectors = frame.motion_vectors,
            .tracks = frame.tracks};
}

}  // namespace

TimelineBinding::TimelineBinding(ProjectSession& session, TimelineView& timeline, StageTimesChart& chart,
                                 QObject* parent)
    : QObject(parent), session_(session), timeline_(timeline), chart_(chart) {
    const auto mark = [this](FrameIndex frame) {
        timeline_.setCurrentFrame(frame);
        chart_.setCurrentFrame(frame);
    };
    whenChanged(session_, this,
                {
                    {SessionChange::video, [this] { showVideo(); }},
                    {SessionChange::length, [this] { showLength(); }},
                    {SessionChange::current_run, [this] { forgetRun(); }},
                    {SessionChange::run_data, [this] { showRun(); }},
                    {SessionChange::selection, [this] { showTrackLife(); }},
                    // While it plays, the mark keeps to the picture, which may be late; whoever steps or drags sees at
                    // once where to.
                    {SessionChange::frame,
                     [this, mark] {
                         if (!session_.playback().playing()) mark(session_.currentFrame());
                     }},
                    {SessionChange::picture,
                     [this, mark] {
                         if (session_.playback().playing()) mark(session_.shownFrame());
                     }},
                    {SessionChange::run_started, [this] { beginLive(); }},
                    {SessionChange::run_ended, [this] { endLive(); }},
                });
    timeline_.setDescription([this](FrameIndex frame) { return describe(frame); });
    connect(&session_, &ProjectSession::liveFrames, this, &TimelineBinding::addLive);
    connect(&timeline_, &TimelineView::frameRequested, &session_,
            [this](FrameIndex frame, bool) { session_.goToFrame(frame); });
    connect(&chart_, &StageTimesChart::frameActivated, &session_, &ProjectSession::goToFrame);
}

void TimelineBinding::showVideo() {
    timeline_.setTimes(session_.timesUs());
    std::vector<FrameIndex> seams;
    if (session_.video())
        for (const VideoPart& part : session_.video()->parts)
            if (part.first_frame > 0) seams.push_back(part.first_frame);
    timeline_.setSeams(std::move(seams));
    chart_.clear();
    if (session_.video()) chart_.setBudgetMs(1000 / std::max(0.001, session_.video()->frame_rate_hz));
}

QString TimelineBinding::describe(FrameIndex frame) const {
    QStringList lines{session_.partText(frame), clock_ ? clock_(frame) : QString()};
    lines.removeAll(QString());
    return lines.join(QLatin1Char('\n'));
}

void TimelineBinding::showLength() {
    timeline_.extendTimes(session_.timesUs());
    if (live_) timeline_.setRunRange(std::pair(0, session_.lastFrame()));
}

void TimelineBinding::forgetRun() {
    endLive();
    timeline_.setFrames({});
    timeline_.setTrackLife(std::nullopt);
    chart_.clear();
}

void TimelineBinding::showRun() {
    showTrackLife();
    if (!session_.runData()) return;
    if (live_) {  // what came live is newer than what was read; but a run that is gone on with has frames before it
        if (!std::exchange(known_before_, true)) addLive(session_.runData()->frames);
        return;
    }
    const RunRecord& run = session_.runData()->record;  // another program may be at work on it
    timeline_.setRunRange(run.live ? std::optional(std::pair(run.first_frame, run.last_frame)) : std::nullopt);
    std::vector<TimelineFrame> frames;
    for (const FrameSummary& frame : session_.runData()->frames) {
        if (frame.frame < 0) continue;
        if (frames.size() <= static_cast<size_t>(frame.frame)) frames.resize(static_cast<size_t>(frame.frame) + 1);
        frames[static_cast<size_t>(frame.frame)] = timelineFrame(frame);
    }
    timeline_.setFrames(std::move(frames));
    chart_.setFrames(session_.runData()->frames);
}

void TimelineBinding::beginLive() {
    live_ = true;
    known_before_ = false;
    if (const RunRecord* run = session_.ownRun())
        timeline_.setRunRange(std::pair(run->first_frame, std::min(run->last_frame, session_.lastFrame())));
}

void TimelineBinding::endLive() {
    live_ = false;
    timeline_.setRunRange(std::nullopt);
}

void TimelineBinding::addLive(const std::vector<FrameSummary>& frames) {
    if (!live_) return;
    for (const FrameSummary& frame : frames) {
        timeline_.setFrameDone(frame.frame, timelineFrame(frame));
        chart_.append(frame);
    }
}

void TimelineBinding::showTrackLife() {
    const auto track = session_.selectedTrack();
    if (track && session_.runData())
        for (const TrackSummary& summary : session_.runData()->tracks)
            if (summary.id == *track) {
                timeline_.setTrackLife(std::pair(summary.first_frame, summary.last_frame), tr("Track %1").arg(*track));
                return;
            }
    timeline_.setTrackLife(std::nullopt);
}

}  // namespace eyrie::ui

#include "moc_timeline_binding.cpp"
