#include "review/zones/zone_points_tool.h"

#include <QKeyEvent>
#include <QLineF>
#include <QMouseEvent>
#include <QPainter>

#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/mark_colours.h"
#include "canvas/video_view.h"

namespace eyrie::ui {

namespace {

constexpr double kPointReach = 9;        ///< of the mouse around a point, logical px
constexpr double kPointShake = 3;        ///< by which the mouse may move in a click, logical px
constexpr double kPointRounding = 0.01;  ///< by which keys may: they do not shake

}  // namespace

ZonePointsTool::ZonePointsTool(VideoView& canvas, QObject* parent) : QObject(parent), canvas_(canvas) {
    canvas_.installEventFilter(this);
}

ZonePointsTool::~ZonePointsTool() = default;

void ZonePointsTool::start(Points points, bool closed) {
    points_ = std::move(points);
    closed_ = closed;
    held_.reset();
    at_ = -1;
    started_ = true;
    canvas_.setTool(this);
    canvas_.setFocus();
}

void ZonePointsTool::setPoints(Points points) {
    if (held_) {
        Points before = points_;
        before[held_->point] = held_->from;
        if (before == points) return;  // what is held is held still
    }
    const bool let_go = std::exchange(held_, std::nullopt).has_value();
    points_ = std::move(points);
    if (const auto cross = canvas_.keyPointer(); let_go && cross) canvas_.moveKeyPointer(*cross);  // it holds no more
    canvas_.update();
}

void ZonePointsTool::end() {
    if (!active()) return;
    takeBack();
    started_ = false;
    canvas_.setTool(nullptr);
}

bool ZonePointsTool::active() const {
    return started_ && canvas_.tool() == this;  // another may have taken the canvas
}

bool ZonePointsTool::takeBack() {
    const auto held = std::exchange(held_, std::nullopt);
    if (!held) return false;
    points_[held->point] = held->from;
    canvas_.update();
    return true;
}

bool ZonePointsTool::finishByKey() {
    end();
    return true;
}

bool ZonePointsTool::eventFilter(QObject* watched, QEvent* event) {
    const bool override = event->type() == QEvent::ShortcutOverride;
    if (!active() || watched != &canvas_ || (!override && event->type() != QEvent::KeyPress))
        return QObject::eventFilter(watched, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool ends = key->key() == Qt::Key_Escape && key->modifiers() == Qt::NoModifier;
    const bool next = key->key() == Qt::Key_Tab && key->modifiers() == Qt::NoModifier;
    const bool previous = key->key() == Qt::Key_Backtab;
    if (!ends && !next && !previous) return QObject::eventFilter(watched, event);
    event->accept();  // whatever these keys do otherwise, they belong to the points now
    if (override) return true;
    if (ends)
        end();
    else
        goToPoint(next ? 1 : -1);
    return true;
}

void ZonePointsTool::goToPoint(int further) {
    if (points_.empty() || held_) return;
    const int count = static_cast<int>(points_.size());
    at_ = at_ < 0 ? (further > 0 ? 0 : count - 1) : (at_ + further + count) % count;
    const cv::Point2d& point = points_[static_cast<std::size_t>(at_)];
    const QPointF image_point(point.x, point.y);
    if (!QRectF(canvas_.rect()).contains(canvas_.transform().viewFromImage(image_point))) canvas_.centreOn(image_point);
    canvas_.moveKeyPointer(canvas_.transform().viewFromImage(image_point));
}

// ---- mouse ----------------------------------------------------------------------------------------------------------

std::optional<std::size_t> ZonePointsTool::pointAt(QPointF view_point, const ViewTransform& transform) const {
    std::optional<std::size_t> best;
    double nearest = kPointReach;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const double distance = QLineF(transform.viewFromImage({points_[i].x, points_[i].y}), view_point).length();
        if (distance > nearest) continue;
        nearest = distance;
        best = i;
    }
    return best;
}

bool ZonePointsTool::press(const QMouseEvent& event, const CanvasPlace& place) {
    if (event.button() != Qt::LeftButton) return false;
    const auto point = pointAt(event.position(), place.transform);
    if (!point) return false;  // the view is moved
    held_ = Held{*point, points_[*point], event.position()};
    return true;
}

bool ZonePointsTool::move(const QMouseEvent& event, const CanvasPlace& place) {
    if (!held_) return false;
    const double way = QLineF(held_->pressed_at, event.position()).length();
    held_->moved = held_->moved || way > (place.by_keys ? kPointRounding : kPointShake);
    if (!held_->moved) return true;
    const QPointF to = place.transform.imageFromView(event.position());
    points_[held_->point] = {to.x(), to.y()};
    canvas_.update();
    return true;
}

bool ZonePointsTool::release(const QMouseEvent& event, const CanvasPlace&) {
    if (event.button() != Qt::LeftButton || !held_) return false;
    const Held held = *std::exchange(held_, std::nullopt);
    if (held.moved) moved_(held.point, points_[held.point]);
    return true;
}

bool ZonePointsTool::doubleClick(const QMouseEvent& event, const CanvasPlace& place) {
    return dragsFrom(event.position(), place);  // its first click was one
}

const QCursor* ZonePointsTool::cursor() const {
    static const QCursor cross(Qt::CrossCursor);
    return held_ ? &cross : nullptr;
}

// ---- painting -------------------------------------------------------------------------------------------------------

void ZonePointsTool::paint(QPainter& painter, const CanvasPlace& place) const {
    if (!active()) return;
    QVector<QPointF> dots;
    for (const cv::Point2d& point : points_) dots << place.transform.viewFromImage({point.x, point.y});
    QVector<QLineF> lines;
    for (int i = 1; i < dots.size(); ++i) lines.append({dots[i - 1], dots[i]});
    if (closed_ && dots.size() > 2) lines.append({dots.back(), dots.front()});
    drawEdgedLines(painter, lines, {toolColour(), edgeColour(), 1.8});
    drawEdgedDots(painter, dots, 9, toolColour(), edgeColour());
}

QString ZonePointsTool::hint(const CanvasPlace&) const {
    return tr("Drag a point to move it. Tab: next point, to be taken hold of with Enter · Esc: done");
}

}  // namespace eyrie::ui

#include "moc_zone_points_tool.cpp"
