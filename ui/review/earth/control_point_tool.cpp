#include "review/earth/control_point_tool.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <utility>

#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/mark_colours.h"
#include "canvas/video_view.h"

namespace eyrie::ui {

namespace {

const QColor kSuspect(255, 90, 80);
constexpr double kArm = 9;          ///< of the crosses, logical px
constexpr double kReach = 9;        ///< of the mouse around a cross, logical px
constexpr double kShake = 3;        ///< by which the mouse may move in a click, logical px
constexpr double kRounding = 0.01;  ///< by which keys may, logical px: they do not shake

}  // namespace

ControlPointTool::ControlPointTool(VideoView& canvas, QObject* parent) : QObject(parent), canvas_(canvas) {
    canvas_.installEventFilter(this);
}

ControlPointTool::~ControlPointTool() = default;

void ControlPointTool::setMarks(std::vector<ControlPointMark> marks) {
    marks_ = std::move(marks);
    if (std::exchange(dragged_, std::nullopt)) pressed_px_.reset();  // what was held may be another now
    if (active_) canvas_.update();
}

void ControlPointTool::setDraft(std::optional<QPointF> px) {
    draft_ = px;
    canvas_.update();
}

void ControlPointTool::start() {
    if (!active_ && canvas_.tool() == nullptr) {
        active_ = true;
        canvas_.setTool(this);
        canvas_.setFocus();
    }
    emit activeChanged();
}

void ControlPointTool::end() {
    if (!active_) return;
    active_ = false;
    draft_.reset();
    takeBack();
    if (canvas_.tool() == this) canvas_.setTool(nullptr);
    emit activeChanged();
}

bool ControlPointTool::takeBack() {
    if (!std::exchange(pressed_px_, std::nullopt)) return false;
    const std::optional<int> dragged = std::exchange(dragged_, std::nullopt);
    for (ControlPointMark& mark : marks_)
        if (mark.number == dragged) mark.px = held_px_;
    canvas_.update();
    return true;
}

bool ControlPointTool::finishByKey() {
    end();
    return true;
}

bool ControlPointTool::eventFilter(QObject* watched, QEvent* event) {
    const bool override = event->type() == QEvent::ShortcutOverride;
    if (!active_ || watched != &canvas_ || (!override && event->type() != QEvent::KeyPress))
        return QObject::eventFilter(watched, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool plain = key->modifiers() == Qt::NoModifier;
    const bool undoes = key->matches(QKeySequence::Undo) || (plain && key->key() == Qt::Key_Z);
    const bool redoes = key->matches(QKeySequence::Redo);
    const bool ends = plain && key->key() == Qt::Key_Escape;
    if (!undoes && !redoes && !ends) return QObject::eventFilter(watched, event);
    event->accept();  // whatever these keys do otherwise, they belong to the points now
    if (override) return true;
    if (undoes) commands_.undo();
    if (redoes) commands_.redo();
    if (ends) end();
    return true;
}

// ---- mouse ----------------------------------------------------------------------------------------------------------

const ControlPointMark* ControlPointTool::markAt(QPointF view_point, const CanvasPlace& place) const {
    const ControlPointMark* best = nullptr;
    double nearest = kReach;
    for (const ControlPointMark& mark : marks_) {
        const double distance = QLineF(place.transform.viewFromImage(mark.px), view_point).length();
        if (!mark.own || distance > nearest) continue;
        nearest = distance;
        best = &mark;
    }
    return best;
}

bool ControlPointTool::press(const QMouseEvent& event, const CanvasPlace& place) {
    if (event.button() != Qt::LeftButton) return false;
    pressed_px_ = place.transform.imageFromView(event.position());
    moved_ = false;
    const ControlPointMark* held = markAt(event.position(), place);
    dragged_ = held != nullptr ? std::optional(held->number) : std::nullopt;
    if (held != nullptr) held_px_ = held->px;
    return true;
}

bool ControlPointTool::move(const QMouseEvent& event, const CanvasPlace& place) {
    if (!pressed_px_) return (event.buttons() & Qt::MiddleButton) == 0;
    const QLineF way(place.transform.viewFromImage(*pressed_px_), event.position());
    moved_ = moved_ || way.length() > (place.by_keys ? kRounding : kShake);
    if (!moved_) return true;
    for (ControlPointMark& mark : marks_)
        if (mark.number == dragged_) mark.px = place.transform.imageFromView(event.position());
    canvas_.update();
    return true;
}

bool ControlPointTool::release(const QMouseEvent& event, const CanvasPlace& place) {
    if (event.button() != Qt::LeftButton || !pressed_px_) return event.button() != Qt::MiddleButton;
    const QPointF down = *std::exchange(pressed_px_, std::nullopt);
    const std::optional<int> dragged = std::exchange(dragged_, std::nullopt);
    if (dragged && moved_) {
        commands_.move(*dragged, place.transform.imageFromView(event.position()));
    } else if (!dragged && !moved_) {
        commands_.add(down);
    }
    return true;
}

bool ControlPointTool::doubleClick(const QMouseEvent&, const CanvasPlace&) {
    return true;  // its first click was one
}

const QCursor* ControlPointTool::cursor() const {
    static const QCursor cross(Qt::CrossCursor);
    return active_ ? &cross : nullptr;
}

// ---- painting -------------------------------------------------------------------------------------------------------

void ControlPointTool::paint(QPainter& painter, const CanvasPlace& place) const {
    if (!active_) return;
    const auto cross = [&](QPointF px, const QColor& colour, Qt::PenStyle style) {
        const QPointF at = place.transform.viewFromImage(px);
        const QVector<QLineF> lines{{at - QPointF(kArm, 0), at + QPointF(kArm, 0)},
                                    {at - QPointF(0, kArm), at + QPointF(0, kArm)}};
        drawEdgedLines(painter, lines, {colour, edgeColour(), 1.8, style});
        return at;
    };
    for (const ControlPointMark& mark : marks_) {
        const QColor colour = mark.suspect ? kSuspect : toolColour();
        const QPointF at = cross(mark.px, colour, mark.own ? Qt::SolidLine : Qt::DotLine);
        const QString number = QString::number(mark.number);
        const QRectF plate(at + QPointF(5, -20),
                           QSizeF(painter.fontMetrics().size(Qt::TextSingleLine, number)) + QSizeF(8, 0));
        painter.setPen(Qt::NoPen);
        painter.setBrush(edgeColour());
        painter.drawRoundedRect(plate, 3, 3);
        painter.setPen(colour);
        painter.drawText(plate, Qt::AlignCenter, number);
        painter.setBrush(Qt::NoBrush);
    }
    if (draft_) cross(*draft_, Qt::white, Qt::SolidLine);
}

QString ControlPointTool::hint(const CanvasPlace&) const {
    return tr(
        "Click a place that a map also shows, then enter its latitude and longitude. Drag a point to move it · Z: "
        "undo · Esc: done");
}

}  // namespace eyrie::ui

#include "moc_control_point_tool.cpp"
