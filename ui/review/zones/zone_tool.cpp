#include "review/zones/zone_tool.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPolygonF>
#include <cmath>

#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/mark_colours.h"
#include "canvas/video_view.h"

namespace eyrie::ui {

namespace {

constexpr double kSamePoint = 4;     ///< logical px: the second click of a double one is no point
constexpr double kSamePlace = 0.01;  ///< the same for keys, which do not shake: what is lost in rounding

}  // namespace

ZoneTool::ZoneTool(VideoView& canvas, QObject* parent) : QObject(parent), canvas_(canvas) {
    canvas_.installEventFilter(this);
}

ZoneTool::~ZoneTool() = default;

void ZoneTool::start(ZoneShape shape) {
    shape_ = shape;
    points_.clear();
    mouse_.reset();
    canvas_.setTool(this);
    canvas_.setFocus();
    emit drawingChanged();
}

void ZoneTool::movePoints(std::vector<cv::Point2d> points) {
    points_ = std::move(points);
    canvas_.update();
}

void ZoneTool::cancel() {
    if (!shape_) return;
    shape_.reset();
    points_.clear();
    if (canvas_.tool() == this) canvas_.setTool(nullptr);
    emit drawingChanged();
}

void ZoneTool::finish() {
    if (!shape_) return;
    Zone zone;
    zone.shape = *shape_;
    zone.points = points_;
    const std::string fault = faultOf(zone);
    if (!fault.empty()) {  // drawing goes on: what is there can be mended
        refused_(QString::fromStdString(fault));
        return;
    }
    cancel();
    finished_(zone.shape, zone.points);
}

bool ZoneTool::takeBack() {
    if (points_.empty()) return false;
    points_.pop_back();
    canvas_.update();
    return true;
}

bool ZoneTool::finishByKey() {
    if (points_.empty()) return false;
    finish();
    return true;
}

bool ZoneTool::eventFilter(QObject* watched, QEvent* event) {
    const bool override = event->type() == QEvent::ShortcutOverride;
    if (!shape_ || watched != &canvas_ || (!override && event->type() != QEvent::KeyPress))
        return QObject::eventFilter(watched, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    if (key->modifiers() & ~Qt::KeypadModifier || key->key() != Qt::Key_Escape)
        return QObject::eventFilter(watched, event);
    event->accept();  // whatever it does otherwise, it belongs to the drawing now
    if (!override) cancel();
    return true;
}

// ---- mouse ----------------------------------------------------------------------------------------------------------

bool ZoneTool::press(const QMouseEvent& event, const CanvasPlace& place) {
    if (event.button() == Qt::RightButton) return true;  // ends it when released: until then no menu opens
    if (event.button() != Qt::LeftButton) return false;
    mouse_ = event.position();
    const QPointF point = place.transform.imageFromView(event.position());
    if (!points_.empty()) {
        const QPointF last = place.transform.viewFromImage({points_.back().x, points_.back().y});
        const double same = place.by_keys ? kSamePlace : kSamePoint;
        if (std::hypot(last.x() - event.position().x(), last.y() - event.position().y()) < same) return true;
    }
    points_.emplace_back(point.x(), point.y());
    canvas_.update();
    return true;
}

bool ZoneTool::move(const QMouseEvent& event, const CanvasPlace&) {
    mouse_ = event.position();
    canvas_.update();
    return (event.buttons() & Qt::MiddleButton) == 0;
}

bool ZoneTool::release(const QMouseEvent& event, const CanvasPlace&) {
    if (event.button() == Qt::RightButton) finish();
    return event.button() != Qt::MiddleButton;
}

bool ZoneTool::doubleClick(const QMouseEvent& event, const CanvasPlace& place) {
    press(event, place);
    finish();
    return true;
}

void ZoneTool::leave() {
    mouse_.reset();
    canvas_.update();
}

const QCursor* ZoneTool::cursor() const {
    static const QCursor cross(Qt::CrossCursor);
    return shape_ ? &cross : nullptr;
}

// ---- painting -------------------------------------------------------------------------------------------------------

void ZoneTool::paint(QPainter& painter, const CanvasPlace& place) const {
    if (!shape_) return;
    QPolygonF corners;
    for (const cv::Point2d& point : points_) corners << place.transform.viewFromImage({point.x, point.y});
    const QPolygonF set = corners;
    if (mouse_) corners << *mouse_;
    if (*shape_ == ZoneShape::area && corners.size() > 2) {
        QColor ground = toolColour();
        ground.setAlpha(50);
        painter.setPen(Qt::NoPen);
        painter.setBrush(ground);
        painter.drawPolygon(corners);
        painter.setBrush(Qt::NoBrush);
    }
    QVector<QLineF> lines;
    for (int i = 1; i < corners.size(); ++i) lines.append({corners[i - 1], corners[i]});
    drawEdgedLines(painter, lines, {toolColour(), edgeColour(), 1.8});
    if (*shape_ == ZoneShape::area && corners.size() > 2)
        drawEdgedLines(painter, {QLineF(corners.back(), corners.front())},
                       {toolColour(), edgeColour(), 1.2, Qt::DashLine});
    QVector<QPointF> dots;
    for (const QPointF& corner : set) dots << corner;
    drawEdgedDots(painter, dots, 7, toolColour(), edgeColour());
}

QString ZoneTool::hint(const CanvasPlace&) const {
    if (!shape_) return {};
    const auto begin = [this] {
        switch (*shape_) {
            case ZoneShape::area:
                break;
            case ZoneShape::line:
                return tr("Click along the line.");
            case ZoneShape::arrow:
                return tr("Click along the lane in the right direction.");
        }
        return tr("Click the corners.");
    };
    // Where the cross is, Enter clicks.
    const QString done = canvas_.keyPointer() ? tr("Double-click: done") : tr("Double-click or Enter: done");
    return tr("%1 %2 · Backspace: remove the last one · Esc: cancel").arg(begin(), done);
}

}  // namespace eyrie::ui

#include "moc_zone_tool.cpp"
