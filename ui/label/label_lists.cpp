#include "label/label_lists.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "annotation/edits/object_pieces.h"
#include "annotation/keyframes/interpolation.h"
#include "annotation/review/join_suggestions.h"
#include "label/label_classes.h"
#include "label/object_colours.h"
#include "widgets/display_text.h"

namespace eyrie::ui {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("eyrie::ui::LabelRows", text);
}

/// Way over the ground from the first keyframe to the last, keyframe by keyframe where there are few of them.
double meanSpeed(const LabelledObject& object, const CameraMotion& camera) {
    const auto& keyframes = object.keyframes;
    const FrameIndex frames = keyframes.back().frame - keyframes.front().frame;
    if (frames <= 0) return 0;
    constexpr std::size_t kPieces = 8;
    const std::size_t step = std::max<std::size_t>(1, (keyframes.size() - 1) / kPieces);
    double way = 0;
    for (std::size_t i = 0; i + 1 < keyframes.size(); i += step) {
        const Keyframe& from = keyframes[i];
        const Keyframe& to = keyframes[std::min(i + step, keyframes.size() - 1)];
        const cv::Point2d moved = carriedPoint(to.box.centre, to.frame, from.frame, camera) - from.box.centre;
        way += std::hypot(moved.x, moved.y);
    }
    return way / frames;
}

void addState(ObjectRow& row, const std::vector<ReviewSpan>& spans) {
    int frames = 0;
    int checked = 0;
    bool questionable = false;
    for (const ReviewSpan& span : spans) {
        const int length = span.last_frame - span.first_frame + 1;
        frames += length;
        if (span.state == ReviewState::checked) checked += length;
        questionable = questionable || span.state == ReviewState::questionable;
    }
    row.checked_share = frames > 0 ? static_cast<double>(checked) / frames : 0;
    row.state = questionable                      ? ReviewState::questionable
                : frames > 0 && checked == frames ? ReviewState::checked
                                                  : ReviewState::unseen;
}

void addFlagSpans(ObjectTimelineRow& row, const LabelledObject& object) {
    const auto& keyframes = object.keyframes;
    for (std::size_t i = 0; i < keyframes.size(); ++i) {
        const FrameIndex last = i + 1 < keyframes.size() ? keyframes[i + 1].frame - 1 : object.last_frame;
        const Keyframe& keyframe = keyframes[i];
        if (keyframe.outside) {
            row.spans.push_back({RowSpan::Kind::outside, keyframe.frame, last});
            continue;
        }
        if (keyframe.occlusion != Occlusion::none) row.spans.push_back({RowSpan::Kind::occluded, keyframe.frame, last});
        if (keyframe.ignore) row.spans.push_back({RowSpan::Kind::ignored, keyframe.frame, last});
    }
}

QString sourceText(const LabelledBox& box, bool lives, const Keyframe* keyframe) {
    if (!lives) return tr("predicted here; move it to extend the object to this frame");
    if (box.outside) return tr("outside the image");
    switch (box.source) {
        case BoxSource::keyframe:
            return keyframe != nullptr && keyframe->computed ? tr("keyframe, computed") : tr("keyframe");
        case BoxSource::ground:
            return tr("interpolated over the ground");
        case BoxSource::image:
            return tr("interpolated in the image (not registered here)");
        case BoxSource::none:
            break;
    }
    return {};
}

cv::Point2d placeOf(const LabelledObject& object) {
    cv::Point2d sum(0, 0);
    for (const Keyframe& keyframe : object.keyframes) sum += keyframe.box.centre;
    return sum / static_cast<double>(object.keyframes.size());
}

int computedKeyframesOf(const LabelledObject& object) {
    return static_cast<int>(std::count_if(object.keyframes.begin(), object.keyframes.end(),
                                          [](const Keyframe& keyframe) { return keyframe.computed; }));
}

}  // namespace

std::vector<ObjectRow> objectRows(const LabelSession& labels) {
    std::vector<ObjectRow> rows;
    ObjectColours colours(labels.annotations());
    for (const auto& [id, object] : labels.annotations().objects) {
        ObjectRow row;
        row.id = id;
        row.object_class = classText(object.object_class);
        row.colour = colours.of(object);
        row.first_frame = firstFrameOf(object);
        row.last_frame = object.last_frame;
        row.keyframes = static_cast<int>(object.keyframes.size());
        row.computed = computedKeyframesOf(object);
        row.speed_px = meanSpeed(object, labels.camera());
        row.place = placeOf(object);
        row.origin = object.origin;
        row.notes = QString::fromStdString(object.notes);
        addState(row, labels.review().spansOf(id));
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<ObjectTimelineRow> timelineRows(const LabelSession& labels) {
    std::vector<ObjectTimelineRow> rows;
    ObjectColours colours(labels.annotations());
    for (const auto& [id, object] : labels.annotations().objects) {
        ObjectTimelineRow row;
        row.id = id;
        row.name = QString::fromStdString(nameOf(object));
        row.colour = colours.of(object);
        row.first = firstFrameOf(object);
        row.last = object.last_frame;
        for (const Keyframe& keyframe : object.keyframes) {
            row.keyframes.push_back(keyframe.frame);
            if (keyframe.computed) row.computed.insert(keyframe.frame);
        }
        addFlagSpans(row, object);
        for (const ReviewSpan& span : labels.review().spansOf(id))
            if (span.state != ReviewState::unseen)
                row.spans.push_back(
                    {span.state == ReviewState::checked ? RowSpan::Kind::checked : RowSpan::Kind::questionable,
                     span.first_frame, span.last_frame});
        rows.push_back(std::move(row));
    }
    return rows;
}

QString joinText(const LabelSession& labels, ObjectId other, bool later, int gap, double distance_px) {
    const LabelledObject* object = labels.object(other);
    const QString name = object != nullptr ? QString::fromStdString(nameOf(*object)) : QString::number(other);
    return (later ? tr("%1, %2 frames later, %3 px away") : tr("%1, %2 frames earlier, %3 px away"))
        .arg(name)
        .arg(gap)
        .arg(distance_px, 0, 'f', 1);
}

ObjectDetails objectDetails(const LabelSession& labels, const LabelEditor& editor, const SceneScale& scale) {
    const LabelledObject& object = *editor.object();
    const FrameIndex frame = editor.frame();
    const LabelledBox shown = boxAt(object, frame, labels.camera());
    ObjectDetails details;
    details.id = object.id;
    details.title = QString::fromStdString(nameOf(object));
    if (labels.selection().size() > 1)
        details.title += tr(" and %1 more").arg(static_cast<int>(labels.selection().size()) - 1);
    const auto keyframes = static_cast<int>(object.keyframes.size());
    const int computed = computedKeyframesOf(object);
    details.life = tr("frames %1 to %2, %3; origin: %4")
                       .arg(firstFrameOf(object))
                       .arg(object.last_frame)
                       .arg(keyframesText(keyframes, computed), originText(object.origin, keyframes, computed));
    if (const auto box = editor.shownBox()) {
        double degrees = std::fmod(box->heading * 180 / std::numbers::pi, 360);
        if (degrees < 0) degrees += 360;
        QString figures =
            tr("%1, %2 px · %3 × %4 · %5°")
                .arg(box->centre.x, 0, 'f', 1)
                .arg(box->centre.y, 0, 'f', 1)
                .arg(lengthText(box->length, scale.at(box->centre)), lengthText(box->width, scale.at(box->centre)))
                .arg(degrees, 0, 'f', 1);
        // Lines break between figures only. What is said in words may break anywhere: in one piece it would be wider
        // than the dock and push the picture aside.
        figures.replace(QLatin1Char(' '), QChar(QChar::Nbsp));
        figures.replace(QStringLiteral("\u00a0·\u00a0"), QStringLiteral("\u00a0· "));
        details.box = tr("%1\u00a0· %2").arg(sourceText(shown, shown.exists(), keyframeAt(object, frame)), figures);
    }
    details.object_class = classText(object.object_class);
    ObjectColours colours(labels.annotations());
    details.colour = colours.of(object);
    details.own_colour = colours.isOwn(object);
    details.lives_here = shown.exists();
    details.occlusion = shown.occlusion;
    details.outside = shown.outside;
    details.ignore = shown.ignore;
    details.editable = labels.canEdit();
    details.notes = QString::fromStdString(object.notes);
    details.review = tr("Not checked yet");
    for (const ReviewSpan& span : labels.review().spansOf(object.id)) {
        if (span.state == ReviewState::unseen || frame < span.first_frame || frame > span.last_frame) continue;
        details.review =
            (span.state == ReviewState::checked ? tr("Checked by %1, %2") : tr("Marked questionable by %1, %2"))
                .arg(QString::fromStdString(span.person), localTimeText(span.when_utc));
    }
    for (const JoinSuggestion& offer : suggestJoins(labels.annotations(), object.id, labels.camera()))
        details.joins.push_back(
            {offer.object, joinText(labels, offer.object, offer.later, offer.gap, offer.distance_px)});
    return details;
}

}  // namespace eyrie::ui
