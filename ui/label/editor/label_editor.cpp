#include "label/editor/label_editor.h"

#include <QtMath>
#include <cmath>
#include <exception>
#include <utility>

#include "annotation/edits/object_pieces.h"
#include "annotation/review/proposals.h"
#include "core/time/utc_time.h"
#include "label/label_classes.h"
#include "label/object_colours.h"

namespace eyrie::ui {

namespace {

/// Moves by 0.1 px must not be lost to what a double rounds.
bool sameBox(const OrientedBox& a, const OrientedBox& b) {
    const auto near = [](double x, double y) { return std::abs(x - y) < 1e-9; };
    return near(a.centre.x, b.centre.x) && near(a.centre.y, b.centre.y) && near(a.length, b.length) &&
           near(a.width, b.width) && near(a.heading, b.heading);
}

/// Where a box goes on to when it keeps the pace it had between two frames.
OrientedBox movedOn(const LabelledObject& object, FrameIndex at, FrameIndex towards, FrameIndex frame,
                    const CameraMotion& camera) {
    LabelledObject lasting = object;
    lasting.last_frame = std::max(lasting.last_frame, std::max(at, frame));
    const OrientedBox last = boxAt(lasting, at, camera).box;
    const OrientedBox before = boxAt(lasting, towards, camera).box;
    OrientedBox box = carriedBox(last, at, frame, camera).value_or(last);
    const cv::Point2d here = carriedPoint(last.centre, at, frame, camera);
    const cv::Point2d there = carriedPoint(before.centre, towards, frame, camera);
    box.centre = here + (here - there) * (static_cast<double>(frame - at) / (at - towards));
    return box;
}

}  // namespace

LabelEditor::LabelEditor(ProjectSession& session, LabelSession& labels, QObject* parent)
    : QObject(parent), session_(session), labels_(labels) {}

const LabelledObject* LabelEditor::object() const {
    return labels_.selected() ? labels_.object(*labels_.selected()) : nullptr;
}

bool LabelEditor::ready() const {
    return object() != nullptr;
}

std::optional<OrientedBox> LabelEditor::expectedBox(const LabelledObject& object, FrameIndex frame,
                                                    const CameraMotion& camera) {
    if (object.keyframes.empty()) return std::nullopt;
    const LabelledBox shown = boxAt(object, frame, camera);
    if (shown.exists()) return shown.box;
    const auto& keyframes = object.keyframes;
    if (frame > object.last_frame) {
        const FrameIndex last = keyframes.back().frame;
        return movedOn(object, last, keyframes.size() > 1 ? last - 1 : last + 1, frame, camera);
    }
    const FrameIndex first = keyframes.front().frame;
    if (keyframes.size() > 1) return movedOn(object, first, first + 1, frame, camera);
    return carriedBox(keyframes.front().box, first, frame, camera).value_or(keyframes.front().box);
}

std::optional<OrientedBox> LabelEditor::shownBox() const {
    const LabelledObject* selected = object();
    return selected ? expectedBox(*selected, frame(), labels_.camera()) : std::nullopt;
}

QString LabelEditor::named(const QString& verb) const {
    const LabelledObject* selected = object();
    return selected ? verb.arg(QString::fromStdString(nameOf(*selected))) : verb;
}

bool LabelEditor::guarded(const std::function<void()>& work) {
    try {
        work();
        return true;
    } catch (const std::exception& error) {
        emit labels_.problem(QString::fromUtf8(error.what()));
        return false;
    }
}

bool LabelEditor::applyObject(const QString& name, LabelledObject object) {
    AnnotationEdit edit;
    guarded([&] { edit = editOf(name.toStdString(), labels_.annotations(), std::vector{std::move(object)}); });
    return labels_.apply(edit);
}

// ---- boxes ----------------------------------------------------------------------------------------------------------

std::optional<ObjectId> LabelEditor::add(const OrientedBox& box, FrameIndex frame) {
    if (!labels_.mayEdit()) return std::nullopt;
    LabelledObject object;
    object.id = labels_.newObjectId();
    object.object_class = labels_.drawnClass();
    object.origin = ObjectOrigin::hand;
    object.last_frame = frame;
    Keyframe keyframe;
    keyframe.frame = frame;
    keyframe.box = box;
    keyframe.heading_set = true;
    object.keyframes.push_back(keyframe);
    const ObjectId id = object.id;
    if (!applyObject(tr("Draw %1").arg(QString::fromStdString(nameOf(object))), object)) return std::nullopt;
    labels_.select(id);
    return id;
}

bool LabelEditor::carriesOn(const OrientedBox& box) const {
    // What the border cuts is no measure of the whole vehicle.
    return carries_corrections_ && session_.video() && !isCutByBorder(box, session_.video()->size);
}

bool LabelEditor::setBox(ObjectId id, FrameIndex frame, const OrientedBox& box, bool turned, const QString& what) {
    const LabelledObject* known = labels_.object(id);
    if (known == nullptr) return false;
    const Keyframe* present = keyframeAt(*known, frame);
    if (present != nullptr && sameBox(present->box, box)) return false;
    const bool heading_set = turned || (present != nullptr && present->heading_set);
    LabelledObject changed = carriesOn(box) ? withBoxCarriedOn(*known, frame, box, heading_set, labels_.camera())
                                            : withBox(*known, frame, box, heading_set);
    changed.origin = originAfterChange(changed.origin);
    const QString name = what.arg(QString::fromStdString(nameOf(changed)));
    return applyObject(name, std::move(changed));
}

void LabelEditor::nudge(double right_px, double down_px) {
    auto box = shownBox();
    if (!box) return;
    box->centre += cv::Point2d(right_px, down_px);
    setBox(*labels_.selected(), frame(), *box, false, tr("Move box of %1"));
}

void LabelEditor::turn(double radians) {
    auto box = shownBox();
    if (!box) return;
    box->heading += radians;
    setBox(*labels_.selected(), frame(), *box, true, tr("Turn box of %1"));
}

void LabelEditor::spreadSize() {
    const auto box = shownBox();
    if (!box) return;
    applyObject(named(tr("Size of %1 in all keyframes")), withSize(*object(), frame(), *box, labels_.camera()));
}

void LabelEditor::spreadCorrection() {
    if (!ready()) return;
    if (keyframeAt(*object(), frame()) == nullptr || object()->keyframes.size() < 2) {
        emit labels_.notice(tr("Correct the box here first; the change is then applied to the other keyframes."));
        return;
    }
    applyObject(named(tr("Correction of %1 in all keyframes")),
                withCorrectionSpread(*object(), frame(), labels_.camera()));
}

void LabelEditor::setKeyframe() {
    const auto box = shownBox();
    if (!box) return;
    if (const Keyframe* present = keyframeAt(*object(), frame()); present != nullptr) {
        if (!present->computed) return;
        Keyframe confirmed = *present;
        confirmed.computed = false;
        applyObject(named(tr("Confirm box of %1")), withKeyframe(*object(), confirmed));
        return;
    }
    setBox(*labels_.selected(), frame(), *box, false, tr("Set keyframe of %1"));
}

void LabelEditor::copyOn(int frames) {
    if (!ready()) return;
    // Who presses the key again before the next picture is there goes on from where that will be.
    const FrameIndex here = session_.currentFrame();
    const auto box = expectedBox(*object(), here, labels_.camera());
    const FrameIndex next = here + frames;
    if (!box || next < 0 || next > session_.lastFrame()) return;
    LabelledObject changed = *object();
    if (keyframeAt(changed, here) == nullptr) changed = withBox(std::move(changed), here, *box, false);
    const OrientedBox carried = carriedBox(*box, here, next, labels_.camera()).value_or(*box);
    changed = withBox(std::move(changed), next, carried, keyframeAt(changed, here)->heading_set);
    changed.origin = originAfterChange(changed.origin);
    if (applyObject(named(tr("Copy box of %1")), std::move(changed))) session_.step(frames);
}

void LabelEditor::deleteKeyframe() {
    if (!ready() || keyframeAt(*object(), frame()) == nullptr) return;
    if (object()->keyframes.size() == 1) {
        // The others that are selected have keyframes of their own.
        labels_.apply(deletionOf(named(tr("Delete %1")).toStdString(), labels_.annotations(), {object()->id}));
        return;
    }
    LabelledObject changed = withoutKeyframe(*object(), frame());
    changed.origin = originAfterChange(changed.origin);
    applyObject(named(tr("Delete keyframe of %1")), std::move(changed));
}

void LabelEditor::deleteObjects() {
    const auto& selection = labels_.selection();
    if (selection.empty()) return;
    const std::vector<ObjectId> ids(selection.begin(), selection.end());
    const QString name =
        ids.size() == 1 ? named(tr("Delete %1")) : tr("Delete %n objects", nullptr, static_cast<int>(ids.size()));
    labels_.apply(deletionOf(name.toStdString(), labels_.annotations(), ids));
}

void LabelEditor::endHere() {
    if (!ready()) return;
    if (frame() < firstFrameOf(*object())) {
        emit labels_.notice(tr("The object begins after this frame; it cannot end here."));
        return;
    }
    LabelledObject changed = *object();
    if (frame() == changed.last_frame) return;
    const FrameIndex end = frame();
    if (end < changed.last_frame && end < changed.keyframes.back().frame) {
        guarded([&] { changed = pieceOf(changed, firstFrameOf(changed), end, labels_.camera()); });
    }
    changed.last_frame = end;
    changed.origin = originAfterChange(changed.origin);
    const bool now_stands = standsAtItsEnd(changed) && !standsAtItsEnd(*object()) && changed.keyframes.size() > 1;
    const FrameIndex from = changed.keyframes.back().frame;
    if (applyObject(named(tr("End %1 here")), std::move(changed)) && now_stands)
        emit labels_.notice(tr("It brakes up to frame %1 and stands still from there on.").arg(from));
}

// ---- flags, class, review -------------------------------------------------------------------------------------------

void LabelEditor::toggleFlag(const QString& name, const std::function<void(Keyframe&)>& change) {
    if (!ready()) return;
    const LabelledBox shown = boxAt(*object(), frame(), labels_.camera());
    if (!shown.exists()) {
        emit labels_.notice(tr("The object does not exist in this frame."));
        return;
    }
    Keyframe keyframe = shownAt(*object(), frame(), labels_.camera());
    if (const Keyframe* present = keyframeAt(*object(), frame())) keyframe = *present;
    change(keyframe);
    LabelledObject changed = withKeyframe(*object(), keyframe);
    changed.origin = originAfterChange(changed.origin);
    applyObject(named(name), std::move(changed));
}

void LabelEditor::toggleOccluded() {
    toggleFlag(tr("Occlusion of %1"), [](Keyframe& keyframe) {
        keyframe.occlusion = static_cast<Occlusion>((static_cast<int>(keyframe.occlusion) + 1) % 3);
    });
}

void LabelEditor::toggleOutside() {
    toggleFlag(tr("Outside: %1"), [](Keyframe& keyframe) { keyframe.outside = !keyframe.outside; });
}

void LabelEditor::toggleIgnore() {
    toggleFlag(tr("Ignore: %1"), [](Keyframe& keyframe) { keyframe.ignore = !keyframe.ignore; });
}

void LabelEditor::setClass(const std::string& name) {
    labels_.setDrawnClass(name);
    std::vector<LabelledObject> changed;
    for (const ObjectId id : labels_.selection())
        if (const LabelledObject* known = labels_.object(id); known && known->object_class != name)
            changed.push_back(*known);
    if (changed.empty()) return;
    const ObjectColours colours(labels_.annotations());
    std::vector<std::uint32_t> own;
    for (const LabelledObject& each : changed) own.push_back(colours.isOwn(each) ? each.colour : 0);
    changed = withClass(std::move(changed), name, 0);
    for (std::size_t i = 0; i < changed.size(); ++i) changed[i].colour = own[i];
    labels_.apply(
        editOf(tr("Class %1").arg(QString::fromStdString(name)).toStdString(), labels_.annotations(), changed));
}

void LabelEditor::setColour(std::optional<std::uint32_t> colour) {
    std::vector<LabelledObject> changed;
    // Black is no colour that can be seen, and 0 says that there is none.
    const std::uint32_t stored = colour ? std::max<std::uint32_t>(*colour, 1) : 0;
    for (const ObjectId id : labels_.selection())
        if (const LabelledObject* known = labels_.object(id); known != nullptr && known->colour != stored) {
            changed.push_back(*known);
            changed.back().colour = stored;
        }
    if (changed.empty()) return;
    labels_.apply(editOf(named(tr("Colour of %1")).toStdString(), labels_.annotations(), changed));
}

void LabelEditor::setNotes(ObjectId id, const QString& notes) {
    const LabelledObject* known = labels_.object(id);
    if (known == nullptr || known->notes == notes.toStdString()) return;
    LabelledObject changed = *known;
    changed.notes = notes.toStdString();
    const QString name = tr("Notes of %1").arg(QString::fromStdString(nameOf(changed)));
    applyObject(name, std::move(changed));
}

void LabelEditor::mark(ReviewState state) {
    std::vector<ReviewMark> marks;
    const std::string when = nowUtc();
    for (const ObjectId id : labels_.selection()) {
        const LabelledObject* known = labels_.object(id);
        if (known == nullptr) continue;
        ReviewMark mark;
        mark.object = id;
        mark.first_frame = firstFrameOf(*known);
        mark.last_frame = known->last_frame;
        mark.state = state;
        mark.person = LabelSession::person().toStdString();
        mark.when_utc = when;
        marks.push_back(mark);
    }
    if (marks.empty()) return;
    const QString verb = state == ReviewState::checked        ? tr("Mark as checked")
                         : state == ReviewState::questionable ? tr("Mark as questionable")
                                                              : tr("Mark as not checked");
    labels_.apply(reviewEdit(verb.toStdString(), labels_.annotations(), marks));
}

// ---- going places ---------------------------------------------------------------------------------------------------

void LabelEditor::goTo(ObjectId id, std::optional<FrameIndex> frame) {
    const LabelledObject* known = labels_.object(id);
    if (known == nullptr) return;
    labels_.select(id);
    if (frame)
        session_.goToFrame(*frame);
    else if (session_.currentFrame() < firstFrameOf(*known) || session_.currentFrame() > known->last_frame)
        session_.goToFrame(firstFrameOf(*known));
}

void LabelEditor::stepObject(int objects) {
    const auto& all = labels_.annotations().objects;
    if (all.empty()) return;
    // Those of this frame first; where it has none, all.
    std::vector<ObjectId> ids;
    for (const auto& [id, known] : all)
        if (firstFrameOf(known) <= frame() && known.last_frame >= frame()) ids.push_back(id);
    if (ids.empty())
        for (const auto& [id, known] : all) ids.push_back(id);
    const auto size = static_cast<int>(ids.size());
    const ObjectId present = labels_.selected().value_or(0);
    const auto at = std::lower_bound(ids.begin(), ids.end(), present) - ids.begin();
    const bool there = at < size && ids[static_cast<std::size_t>(at)] == present;
    const int next = static_cast<int>(at) + (objects > 0 && !there ? objects - 1 : objects);
    goTo(ids[static_cast<std::size_t>(((next % size) + size) % size)]);
}

void LabelEditor::nextKeyframe() {
    if (!ready()) return;
    if (const Keyframe* next = eyrie::nextKeyframe(*object(), session_.currentFrame()))
        session_.goToFrame(next->frame);
    else
        session_.goToFrame(object()->last_frame);
}

void LabelEditor::previousKeyframe() {
    if (!ready()) return;
    if (const Keyframe* previous = eyrie::previousKeyframe(*object(), session_.currentFrame()))
        session_.goToFrame(previous->frame);
}

void LabelEditor::nextAttention() {
    const auto item =
        eyrie::nextAttention(labels_.attention(), session_.currentFrame(), labels_.selected().value_or(0));
    if (!item) {
        emit labels_.notice(tr("Nothing needs attention."));
        return;
    }
    goTo(item->object, item->frame);
    if (const LabelledObject* known = labels_.object(item->object))
        emit labels_.notice(tr("%1 in frame %2: %3")
                                .arg(QString::fromStdString(nameOf(*known)))
                                .arg(item->frame)
                                .arg(QString::fromStdString(item->text)));
}

void LabelEditor::nextUnchecked() {
    const auto place = labels_.review().nextUnchecked(labels_.selected().value_or(0), session_.currentFrame());
    if (place)
        goTo(place->object, place->frame);
    else
        emit labels_.notice(labels_.annotations().objects.empty() ? tr("There is nothing to check yet.")
                                                                  : tr("Everything is checked."));
}

}  // namespace eyrie::ui

#include "moc_label_editor.cpp"
