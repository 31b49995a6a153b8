#include "review/watch/measure_tool.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/mark_colours.h"
#include "canvas/video_view.h"
#include "review/watch/watched_ground.h"
#include "session/project_session.h"
#include "widgets/display_text.h"

namespace eyrie::ui {

namespace {

QString metresText(double metres) {
    return QStringLiteral("%1 m").arg(numberText(metres, metres < 100 ? 1 : 0));
}

}  // namespace

MeasureTool::MeasureTool(ProjectSession& session, VideoView& canvas, WatchedGround& ground, QObject* parent)
    : QObject(parent), session_(session), canvas_(canvas), ground_(ground) {
    canvas_.installEventFilter(this);
}

MeasureTool::~MeasureTool() = default;

void MeasureTool::start() {
    if (measuring_) return;
    if (canvas_.tool() != nullptr) {  // something is being drawn
        emit measuringChanged();
        return;
    }
    measuring_ = true;
    from_.reset();
    to_.reset();
    mouse_.reset();
    canvas_.setTool(this);
    canvas_.setFocus();
    emit measuringChanged();
}

void MeasureTool::end() {
    if (!measuring_) return;
    measuring_ = false;
    if (canvas_.tool() == this) canvas_.setTool(nullptr);
    emit measuringChanged();
}

bool MeasureTool::eventFilter(QObject* watched, QEvent* event) {
    const bool override = event->type() == QEvent::ShortcutOverride;
    if (!measuring_ || watched != &canvas_ || (!override && event->type() != QEvent::KeyPress))
        return QObject::eventFilter(watched, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    if (key->key() != Qt::Key_Escape || key->modifiers() != Qt::NoModifier) return QObject::eventFilter(watched, event);
    event->accept();
    if (!override) end();
    return true;
}

// ---- what is measured -----------------------------------------------------------------------------------------------

std::optional<FramePoint> MeasureTool::shownHere(const FramePoint& point) const {
    const FrameIndex frame = canvas_.frame().index;
    if (point.frame == frame) return point;
    if (!ground_.ground()) return std::nullopt;
    return carriedTo(ground_.ground()->stretches, point, frame);
}

std::optional<FramePoint> MeasureTool::farEnd() const {
    if (to_) return to_;
    if (!mouse_) return std::nullopt;
    return FramePoint{canvas_.frame().index, {mouse_->x(), mouse_->y()}};
}

std::optional<GroundMeasure> MeasureTool::between(const FramePoint& from, const FramePoint& to) const {
    if (ground_.ground())
        if (const auto measure = measureBetween(ground_.ground()->stretches, from, to)) return measure;
    if (from.frame != to.frame) return std::nullopt;
    // Without a run the picture alone is measured.
    return measureInFrame(session_.scale().in(from.frame), from.at, to.at);
}

QString MeasureTool::text() const {
    if (!from_) return tr("Click where to begin · Esc: done");
    const auto to = farEnd();
    if (!to) return tr("Click where to end; in another frame, to measure a speed");
    const auto measure = between(*from_, *to);
    if (!measure)
        return ground_.ground()
                   ? tr("The ground of frame %1 is not connected with that of this one: nothing to measure by")
                         .arg(from_->frame)
                   : tr("Measuring across frames needs a finished run, which knows how the ground moves");
    const SceneScale scale = session_.scale();
    const QString length =
        scale.gsd_known ? metresText(measure->metres) : QStringLiteral("%1 px").arg(numberText(measure->px, 1));
    const int frames = std::abs(to->frame - from_->frame);
    if (frames == 0) return length;
    // Across frames there is a run.
    const StoredTracks& run = *ground_.ground()->run;
    const double seconds = std::abs(run.secondsOf(to->frame) - run.secondsOf(from_->frame));
    const double km_per_hour = seconds > 0 ? measure->metres / seconds * 3.6 : 0;
    const QString speed = scale.gsd_known ? QStringLiteral("%1 km/h").arg(numberText(km_per_hour, 1))
                                          : QStringLiteral("%1 px/frame").arg(numberText(measure->px / frames, 2));
    return tr("%1 in %2: %3").arg(length, durationText(seconds), speed);
}

// ---- mouse ----------------------------------------------------------------------------------------------------------

bool MeasureTool::press(const QMouseEvent& event, const CanvasPlace& place) {
    if (event.button() != Qt::LeftButton) return event.button() == Qt::RightButton;
    const QPointF at = place.transform.imageFromView(event.position());
    const FramePoint point{canvas_.frame().index, {at.x(), at.y()}};
    mouse_ = at;
    if (!from_ || to_) {
        from_ = point;
        to_.reset();
    } else {
        to_ = point;
    }
    canvas_.update();
    return true;
}

bool MeasureTool::move(const QMouseEvent& event, const CanvasPlace& place) {
    mouse_ = place.transform.imageFromView(event.position());
    canvas_.update();
    return (event.buttons() & Qt::MiddleButton) == 0;
}

bool MeasureTool::release(const QMouseEvent& event, const CanvasPlace&) {
    if (event.button() == Qt::RightButton) end();
    return event.button() != Qt::MiddleButton;
}

bool MeasureTool::doubleClick(const QMouseEvent& event, const CanvasPlace& place) {
    return press(event, place);
}

void MeasureTool::leave() {
    mouse_.reset();
    canvas_.update();
}

bool MeasureTool::takeBack() {
    if (!from_) return false;
    (to_ ? to_ : from_).reset();
    canvas_.update();
    return true;
}

const QCursor* MeasureTool::cursor() const {
    static const QCursor cross(Qt::CrossCursor);
    return measuring_ ? &cross : nullptr;
}

// ---- painting -------------------------------------------------------------------------------------------------------

std::optional<QPointF> MeasureTool::inView(const std::optional<FramePoint>& point, const CanvasPlace& place) const {
    const auto here = point ? shownHere(*point) : std::nullopt;
    if (!here) return std::nullopt;
    return place.transform.viewFromImage({here->at.x, here->at.y});
}

QString MeasureTool::hint(const CanvasPlace& place) const {
    // Beside a line that is seen its length stands there.
    if (from_ && inView(from_, place) && inView(farEnd(), place)) return tr("Click two places to measure · Esc: done");
    return text();
}

void MeasureTool::paint(QPainter& painter, const CanvasPlace& place) const {
    if (!measuring_) return;
    const auto from = inView(from_, place);
    const auto to = from_ ? inView(farEnd(), place) : std::nullopt;
    if (from && to) drawEdgedLines(painter, {QLineF(*from, *to)}, {toolColour(), edgeColour(), 1.8});
    QVector<QPointF> ends;
    if (from) ends << *from;
    if (to && to_) ends << *to;
    drawEdgedDots(painter, ends, 7, toolColour(), edgeColour());
    if (!from || !to) return;
    const QString words = text();
    QRectF plate = QRectF(painter.fontMetrics().boundingRect(words)).adjusted(-8, -4, 8, 4);
    plate.moveCenter((*from + *to) / 2 - QPointF(0, plate.height()));
    const QRectF room = place.view.adjusted(4, 4, -4, -4);
    plate.moveLeft(std::max(room.left(), std::min(plate.left(), room.right() - plate.width())));
    plate.moveTop(std::max(room.top(), std::min(plate.top(), room.bottom() - plate.height())));
    painter.setPen(Qt::NoPen);
    painter.setBrush(edgeColour(210));
    painter.drawRoundedRect(plate, 4, 4);
    painter.setPen(Qt::white);
    painter.setBrush(Qt::NoBrush);
    painter.drawText(plate, Qt::AlignCenter, words);
}

}  // namespace eyrie::ui

#include "moc_measure_tool.cpp"
