#include "review/watch/steady_watch.h"

#include <QLocale>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "canvas/video_view.h"
#include "review/watch/watched_ground.h"
#include "widgets/message_bar.h"
#include "workspace/session_reactions.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

constexpr double kShareOfView = 0.12;  ///< of its smaller side, that a followed vehicle is long
const QString kFollowTopic = QStringLiteral("follow");

QTransform qtMap(const cv::Matx33d& m) {
    return {m(0, 0), m(1, 0), m(2, 0), m(0, 1), m(1, 1), m(2, 1), m(0, 2), m(1, 2), m(2, 2)};
}

}  // namespace

SteadyWatch::SteadyWatch(const SteadyParts& parts, QObject* parent) : QObject(parent), parts_(parts) {
    bindSwitches(this, {{parts_.actions.steady, [this](bool on) { setSteady(on); }},
                        {parts_.actions.follow_object, [this](bool on) { setFollowing(on); }}});
    whenAny(&parts_.canvas, this, &SteadyWatch::showFrame, &VideoView::frameGiven);
    whenAny(&parts_.ground, this, &SteadyWatch::groundChanged, &WatchedGround::changed);
    followSession(parts_.session, this,
                  {{SessionChange::selection,
                    [this] {
                        follow();
                        if (following_) tellWhetherFollowed();
                    }},
                   {SessionChange::video, [this] {
                        parts_.actions.steady->setChecked(false);
                        parts_.actions.follow_object->setChecked(false);
                    }}});
    enableActions();
}

void SteadyWatch::setActive(bool active) {
    active_ = active;
    if (!active) {
        parts_.actions.follow_object->setChecked(false);
        parts_.canvas.setGround(std::nullopt);
    }
    enableActions();
    showFrame();
}

void SteadyWatch::enableActions() {
    parts_.actions.steady->setEnabled(active_ && parts_.ground.ground() != nullptr);
    parts_.actions.follow_object->setEnabled(active_ && parts_.session.video().has_value());
}

void SteadyWatch::setSteady(bool on) {
    laying_ = false;
    if (on)
        groundChanged();
    else
        parts_.ground.forgetSheets();
}

void SteadyWatch::groundChanged() {
    enableActions();
    // The anchor is the frame that was seen when it was switched on, or when another run was chosen.
    const bool wanted = parts_.actions.steady->isChecked() && parts_.ground.ground() != nullptr;
    if (!parts_.ground.ground()) laying_ = false;
    if (wanted && !laying_ && !parts_.ground.sheets()) {
        laying_ = true;
        parts_.ground.lay(parts_.canvas.frame().index);
    }
    showFrame();
}

void SteadyWatch::showFrame() {
    if (!active_) return;
    layOnGround();
    follow();
}

void SteadyWatch::layOnGround() {
    const auto& sheets = parts_.ground.sheets();
    const FrameIndex frame = parts_.canvas.frame().index;
    if (sheets && parts_.actions.steady->isChecked() && sheets->sheetOf(frame) >= 0)
        parts_.canvas.setGround(qtMap(sheets->sheetFromImage(frame)));
    else
        parts_.canvas.setGround(std::nullopt);
}

// ---- following ------------------------------------------------------------------------------------------------------

void SteadyWatch::setFollowing(bool on) {
    if (on == following_) return;
    following_ = on;
    VideoView& canvas = parts_.canvas;
    if (on) {
        was_fitted_ = canvas.transform().fitted();
        near_.reset();
        follow();
        tellWhetherFollowed();
        return;
    }
    parts_.messages.dismissTopic(kFollowTopic);
    canvas.setRotation(0);
    if (was_fitted_) canvas.fit();
}

std::optional<FollowedPose> SteadyWatch::poseOf(int track) const {
    const ViewFrame& frame = parts_.canvas.frame();
    if (const auto& ground = parts_.ground.ground())
        if (const EventTrack* known = ground->track(track))
            return followedPose(*known, frame.index, ground->run->footage.camera);
    // While a run works, and of tracks that it left out, all that is known is the frame itself.
    const TrackState* state = stateOf(frame, track);
    if (state == nullptr) return std::nullopt;
    return FollowedPose{state->box.centre, state->box.heading, state->box.length};
}

void SteadyWatch::tellWhetherFollowed() {
    const auto track = parts_.session.selectedTrack();
    if (!active_ || (track && poseOf(*track))) {
        parts_.messages.dismissTopic(kFollowTopic);
    } else if (track) {
        tellNotInFrame(*track);
    } else {
        parts_.messages.showTopic(kFollowTopic, MessageKind::info,
                                  tr("No vehicle is selected. Click one, and the view will follow it."));
    }
}

void SteadyWatch::tellNotInFrame(int track) {
    const auto& ground = parts_.ground.ground();
    const EventTrack* known = ground ? ground->track(track) : nullptr;
    if (known == nullptr || known->boxes.empty()) {
        parts_.messages.showTopic(
            kFollowTopic, MessageKind::info,
            tr("Track %1 is not in this frame. Go to one that shows it, and the view will follow it.").arg(track));
        return;
    }
    const FrameIndex here = parts_.canvas.frame().index;
    const auto nearest =
        std::min_element(known->boxes.begin(), known->boxes.end(), [here](const TrackedBox& a, const TrackedBox& b) {
            return std::abs(a.frame - here) < std::abs(b.frame - here);
        });
    const QLocale locale;
    const FrameIndex there = nearest->frame;
    parts_.messages.showTopic(
        kFollowTopic, MessageKind::info,
        tr("Track %1 is not in this frame: it was seen from frame %2 to %3. The view will follow it there.")
            .arg(track)
            .arg(locale.toString(known->boxes.front().frame), locale.toString(known->boxes.back().frame)),
        tr("Go to frame %1").arg(locale.toString(there)), [this, there] { parts_.session.goToFrame(there); });
}

void SteadyWatch::follow() {
    if (!active_ || !following_ || !parts_.session.selectedTrack()) return;
    const int track = *parts_.session.selectedTrack();
    const auto pose = poseOf(track);
    if (!pose) return;
    parts_.messages.dismissTopic(kFollowTopic);
    VideoView& canvas = parts_.canvas;
    const QPointF centre(pose->centre.x, pose->centre.y);
    if (near_ != track) {
        near_ = track;
        const QPointF along = canvas.transform().viewVector({pose->length, 0}, centre);
        const double wanted = kShareOfView * std::min(canvas.width(), canvas.height());
        const double seen = std::hypot(along.x(), along.y());
        if (seen > 0 && seen < wanted) canvas.restore(canvas.transform().zoom() * wanted / seen, centre);
    }
    const ViewTransform& shown = canvas.transform();
    const QPointF ahead = shown.viewVector({std::cos(pose->heading), std::sin(pose->heading)}, centre);
    canvas.setRotation(shown.rotation() - std::atan2(ahead.y(), ahead.x()) - std::numbers::pi / 2);
    canvas.centreOn(centre);
}

}  // namespace eyrie::ui

#include "moc_steady_watch.cpp"
