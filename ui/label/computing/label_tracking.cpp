#include "label/computing/label_tracking.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <utility>

#include "annotation/edits/identity_edits.h"
#include "annotation/edits/object_pieces.h"
#include "annotation/keyframes/keyframe_reduction.h"
#include "annotation/review/proposals.h"
#include "label/editor/label_editor.h"
#include "session/background/pace.h"
#include "session/project/media.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {
constexpr double kTolerance_px = 1;
}  // namespace

LabelTracking::LabelTracking(ProjectSession& session, LabelSession& labels, LabelTrackingAnswers answers,
                             QObject* parent)
    : QObject(parent), session_(session), labels_(labels), answers_(std::move(answers)) {
    connect(&labels_, &LabelSession::closed, this, &LabelTracking::stop);
    whenChanged(session_, this, {{SessionChange::work_ends, [this] { stop(); }}});
}

void LabelTracking::start(int direction) {
    if (working_ || !labels_.selected() || !session_.media() || !labels_.mayEdit()) return;
    const LabelledObject* object = labels_.object(*labels_.selected());
    const FrameIndex from = session_.shownFrame();
    const auto box = LabelEditor::expectedBox(*object, from, labels_.camera());
    if (!box) return;
    // A keyframe that is there already is never touched: the way goes up to it.
    FrameIndex last = direction > 0 ? session_.lastFrame() : 0;
    if (const Keyframe* next = direction > 0 ? nextKeyframe(*object, from) : previousKeyframe(*object, from))
        last = next->frame - direction;
    if (last == from || (last - from > 0) != (direction > 0)) {
        answers_.show_end(from, tr("Nothing to track: there is no frame between this keyframe and the next one."));
        return;
    }
    working_.emplace();
    // Other labels may be open by the time it ends; they have objects of these numbers, too.
    const auto of_these = [this, project = labels_.projectPath(), video = labels_.sequence().path] {
        return labels_.projectPath() == project && labels_.sequence().path == video;
    };
    const auto ended_with = [this, of_these, id = object->id, from, box = *box](const FollowResult& result,
                                                                                const QString& failure) {
        const auto due = std::exchange(working_, std::nullopt);  // until it is in the labels
        answers_.working_changed();
        if (!of_these()) return;
        if (!failure.isEmpty()) emit labels_.problem(failure);
        take(id, from, box, result);
    };
    const TrackingAdvance advance{QString::fromStdString(nameOf(*object)), from, 0, std::abs(last - from), -1};
    const auto work = [this, of_these, ended_with, advance, media = *session_.media(), box = *box, from, last,
                       camera = labels_.sharedCamera()](const BackgroundTask& task) {
        const auto source = media.open({}, task.stop());
        const GrayFrames frames = grayReader(*source);
        Pace pace;
        const FollowProgress progress = [&, advance](const FollowedBox& followed) {
            if (!pace.isDue()) return;
            TrackingAdvance reached = advance;
            reached.frame = followed.frame;
            reached.done = std::abs(followed.frame - from);
            reached.seconds_left = pace.secondsLeft(reached.done, reached.most - reached.done);
            task.tell([this, of_these, reached] {
                if (of_these()) answers_.show_advance(reached);
            });
        };
        const FollowResult result = followBox(box, from, last, frames, *camera, {}, progress, task.stop());
        task.tell([ended_with, result] { ended_with(result, {}); });
    };
    tracking_ = query_.post(work, [ended_with](const QString& failure) { ended_with({}, failure); });
    answers_.show_advance(advance);
    answers_.working_changed();
}

void LabelTracking::take(ObjectId id, FrameIndex start, const OrientedBox& box, const FollowResult& result) {
    const LabelledObject* object = labels_.object(id);
    if (object == nullptr) {
        answers_.show_end(start, tr("Tracking ended: the object was deleted meanwhile."));
        return;
    }
    FrameIndex end = start;
    if (!result.boxes.empty()) {
        std::vector<FrameBox> boxes{{start, box}};
        for (const FollowedBox& followed : result.boxes) boxes.push_back({followed.frame, followed.box});
        std::sort(boxes.begin(), boxes.end(), [](const FrameBox& a, const FrameBox& b) { return a.frame < b.frame; });
        end = result.boxes.back().frame;
        ReductionOptions options;
        options.tolerance_px = kTolerance_px;
        LabelledObject changed = *object;
        for (const Keyframe& keyframe : reduceToKeyframes(boxes, labels_.camera(), options))
            if (keyframeAt(*object, keyframe.frame) == nullptr) {
                changed = withBox(std::move(changed), keyframe.frame, keyframe.box, keyframe.heading_set);
                Keyframe computed = *keyframeAt(changed, keyframe.frame);
                computed.computed = true;
                changed = withKeyframe(std::move(changed), computed);
            }
        changed.last_frame = std::max(changed.last_frame, end);
        changed.origin = originAfterChange(changed.origin);
        const QString name = tr("Track %1").arg(QString::fromStdString(nameOf(changed)));
        labels_.apply(editOf(name.toStdString(), labels_.annotations(), std::vector{std::move(changed)}));
    }
    const QString reason = QString::fromStdString(result.reason);
    answers_.show_end(end, reason.isEmpty() ? QString() : tr("Tracking %1.").arg(reason));
}

}  // namespace eyrie::ui

#include "moc_label_tracking.cpp"
