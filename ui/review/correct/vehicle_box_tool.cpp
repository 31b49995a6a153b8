#include "review/correct/vehicle_box_tool.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <numbers>
#include <utility>

#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/mark_colours.h"
#include "canvas/video_view.h"

namespace eyrie::ui {

namespace {

constexpr double kSmallest_px = 3;  ///< of the frame: less can be no vehicle, and not be followed

}  // namespace

VehicleBoxTool::VehicleBoxTool(VideoView& canvas, QObject* parent) : QObject(parent), canvas_(canvas) {
    canvas_.installEventFilter(this);
}

void VehicleBoxTool::start() {
    drawing_ = true;
    pressed_.reset();
    canvas_.setTool(this);
    canvas_.setFocus();
    drawing_changed_();
}

void VehicleBoxTool::cancel() {
    if (!std::exchange(drawing_, false)) return;
    pressed_.reset();
    if (canvas_.tool() == this) canvas_.setTool(nullptr);
    drawing_changed_();
}

bool VehicleBoxTool::eventFilter(QObject* watched, QEvent* event) {
    const bool override = event->type() == QEvent::ShortcutOverride;
    if (!drawing_ || watched != &canvas_ || (!override && event->type() != QEvent::KeyPress))
        return QObject::eventFilter(watched, event);
    if (static_cast<QKeyEvent*>(event)->key() != Qt::Key_Escape) return QObject::eventFilter(watched, event);
    event->accept();
    if (!override) cancel();
    return true;
}

bool VehicleBoxTool::press(const QMouseEvent& event, const CanvasPlace& place) {
    if (event.button() != Qt::LeftButton) return false;
    pressed_ = dragged_ = place.transform.imageFromView(event.position());
    return true;
}

bool VehicleBoxTool::move(const QMouseEvent& event, const CanvasPlace& place) {
    if (!pressed_) return false;
    dragged_ = place.transform.imageFromView(event.position());
    canvas_.update();
    return true;
}

bool VehicleBoxTool::release(const QMouseEvent& event, const CanvasPlace& place) {
    if (event.button() != Qt::LeftButton || !pressed_) return false;
    move(event, place);
    const QRectF drawn = QRectF(*pressed_, dragged_).normalized();
    pressed_.reset();
    canvas_.update();
    if (drawn.width() < kSmallest_px || drawn.height() < kSmallest_px) return true;  // a click: drawing goes on
    cancel();
    // Until its motion tells more, a vehicle points along its longer side.
    const cv::Point2d centre(drawn.center().x(), drawn.center().y());
    const bool upwards = drawn.height() > drawn.width();
    finished_(upwards ? OrientedBox{centre, drawn.height(), drawn.width(), -std::numbers::pi / 2}
                      : OrientedBox{centre, drawn.width(), drawn.height(), 0});
    return true;
}

bool VehicleBoxTool::doubleClick(const QMouseEvent& event, const CanvasPlace& place) {
    return press(event, place);
}

bool VehicleBoxTool::takeBack() {
    if (!pressed_) return false;
    pressed_.reset();
    canvas_.update();
    return true;
}

const QCursor* VehicleBoxTool::cursor() const {
    static const QCursor cross(Qt::CrossCursor);
    return drawing_ ? &cross : nullptr;
}

void VehicleBoxTool::paint(QPainter& painter, const CanvasPlace& place) const {
    if (!drawing_) return;
    if (pressed_) {
        const QRectF drawn = QRectF(*pressed_, dragged_).normalized();
        const QPointF corners[] = {drawn.topLeft(), drawn.topRight(), drawn.bottomRight(), drawn.bottomLeft()};
        QVector<QLineF> lines;
        for (int i = 0; i < 4; ++i)
            lines.append(
                {place.transform.viewFromImage(corners[i]), place.transform.viewFromImage(corners[(i + 1) % 4])});
        drawEdgedLines(painter, lines, {toolColour(), edgeColour(), 1.8});
    }
}

QString VehicleBoxTool::hint(const CanvasPlace&) const {
    return tr("Drag a tight box around the vehicle. Esc: cancel");
}

}  // namespace eyrie::ui

#include "moc_vehicle_box_tool.cpp"
