#include "label/computing/label_fitting.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "annotation/edits/identity_edits.h"
#include "annotation/edits/object_pieces.h"
#include "annotation/review/proposals.h"
#include "session/background/lru_cache.h"
#include "session/project/media.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

constexpr std::size_t kFittingBudget_bytes = 256U * 1024 * 1024;  ///< pictures kept while several objects are fitted

bool hasBoth(const LabelledObject& object) {
    const auto& keyframes = object.keyframes;
    const auto computed =
        std::count_if(keyframes.begin(), keyframes.end(), [](const Keyframe& k) { return k.computed; });
    return computed > 0 && computed < static_cast<std::ptrdiff_t>(keyframes.size());
}

bool sameKeyframes(const LabelledObject& a, const LabelledObject& b) {
    return std::equal(a.keyframes.begin(), a.keyframes.end(), b.keyframes.begin(), b.keyframes.end(),
                      [](const Keyframe& p, const Keyframe& q) {
                          return p.frame == q.frame && p.box.centre == q.box.centre && p.box.length == q.box.length &&
                                 p.box.width == q.box.width && p.box.heading == q.box.heading &&
                                 p.computed == q.computed && p.outside == q.outside && p.occlusion == q.occlusion &&
                                 p.ignore == q.ignore && p.heading_set == q.heading_set;
                      }) &&
           a.last_frame == b.last_frame;
}

}  // namespace

LabelFitting::LabelFitting(ProjectSession& session, LabelSession& labels, std::function<void()> working_changed,
                           QObject* parent)
    : QObject(parent), session_(session), labels_(labels), working_changed_(std::move(working_changed)) {
    connect(&labels_, &LabelSession::closed, this, &LabelFitting::stop);
    whenChanged(session_, this, {{SessionChange::work_ends, [this] { stop(); }}});
}

void LabelFitting::start() {
    if (working_ || !labels_.selected() || !session_.media() || !labels_.mayEdit()) return;
    std::vector<LabelledObject> objects;
    for (const ObjectId id : labels_.selection())
        if (const LabelledObject* object = labels_.object(id); object != nullptr && hasBoth(*object))
            objects.push_back(*object);
    if (objects.empty()) {
        emit labels_.notice(
            tr("There is nothing to refine: correct one box of an accepted proposal, or set a keyframe where its box "
               "is right; the others follow."));
        return;
    }
    working_.emplace();
    const auto work = [this, objects = std::move(objects), media = *session_.media(),
                       camera = labels_.sharedCamera()](const BackgroundTask& task) {
        std::vector<Fitted> fitted;
        const auto source = media.open({}, task.stop());
        LruCache<FrameIndex, cv::Mat> kept(kFittingBudget_bytes);
        const GrayFrames frames = [&kept, read = grayReader(*source)](FrameIndex frame) {
            if (const cv::Mat* known = kept.find(frame)) return *known;
            cv::Mat picture = read(frame).clone();
            if (!picture.empty()) kept.put(frame, picture, picture.total());  // else it is compared with others
            return picture;
        };
        for (const LabelledObject& object : objects) {
            PictureFit fit = fittedToPictures(object, *camera, frames, {}, task.stop());
            if (task.stop().stop_requested()) break;
            fitted.push_back({object, std::move(fit)});
        }
        task.tell([this, fitted = std::move(fitted)] { take(fitted, {}); });
    };
    fitting_ = query_.post(work, [this](const QString& failure) { take({}, failure); });
    working_changed_();
}

void LabelFitting::take(const std::vector<Fitted>& fitted, const QString& failure) {
    const auto due = std::exchange(working_, std::nullopt);  // until it is in the labels
    working_changed_();
    if (!failure.isEmpty()) emit labels_.problem(failure);
    std::vector<LabelledObject> changed;
    int frames = 0;
    int sure = 0;
    for (const auto& [before, fit] : fitted) {
        // What was changed meanwhile stays as it is.
        const LabelledObject* now = labels_.object(before.id);
        if (now == nullptr || !sameKeyframes(*now, before) || sameKeyframes(fit.object, before)) continue;
        LabelledObject object = *now;
        object.keyframes = fit.object.keyframes;
        object.origin = originAfterChange(object.origin);
        changed.push_back(std::move(object));
        frames += fit.frames;
        sure += fit.sure;
    }
    if (changed.empty()) {
        if (!fitted.empty()) emit labels_.notice(tr("The boxes already fit the pictures as well as they can."));
        return;
    }
    const QString name = changed.size() == 1
                             ? tr("Refine boxes of %1").arg(QString::fromStdString(nameOf(changed.front())))
                             : tr("Refine boxes of %1 objects").arg(changed.size());
    if (!labels_.apply(editOf(name.toStdString(), labels_.annotations(), std::move(changed)))) return;
    if (sure < frames)
        emit labels_.notice(tr("Boxes refined; %1 of %2 frames look different from the boxes set by hand.")
                                .arg(frames - sure)
                                .arg(frames));
}

}  // namespace eyrie::ui

#include "moc_label_fitting.cpp"
