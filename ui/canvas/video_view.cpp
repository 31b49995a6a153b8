#include "canvas/video_view.h"

#include <QContextMenuEvent>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QWheelEvent>
#include <cmath>

#include "canvas/canvas_tool.h"
#include "canvas/layers/overlay_table.h"
#include "canvas/layers/track_layer.h"

namespace eyrie::ui {

namespace {
constexpr double kWheelStep = 1.25;
constexpr double kDragThreshold = 4;
constexpr double kHitMargin = 4;  ///< logical px around a box that still count as hit
}  // namespace

VideoView::VideoView(OverlaySettings& settings, QWidget* parent) : QWidget(parent), settings_(settings) {
    for (const OverlayRow& row : overlayTable()) layers_.emplace_back(row.kind, row.make());
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setAccessibleName(tr("Video"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    connect(&settings_, &OverlaySettings::changed, this, &VideoView::pictureWasChanged);
}

VideoView::~VideoView() = default;

void VideoView::setFrame(ViewFrame frame) {
    if (frame.index != frame_.index) pointer_.forgetPlace();
    frame_ = std::move(frame);
    adoptSize();
    pictureWasChanged();
    emit frameGiven(frame_.index);
}

void VideoView::clear(QSize image_size) {
    frame_ = {};
    transform_.setImageSize(image_size);
    transformWasChanged();
}

void VideoView::adoptSize() {
    QSize size = frame_.image.size();
    if (size.isEmpty() && frame_.result)
        size = QSize(frame_.result->motion.image_size.width, frame_.result->motion.image_size.height);
    if (size.isEmpty() || size == transform_.imageSize()) return;
    transform_.setImageSize(size);
    transformWasChanged();
}

void VideoView::setSelectedTrack(std::optional<TrackId> track) {
    if (selected_track_ == track) return;
    selected_track_ = track;
    pictureWasChanged();
}

void VideoView::setStacks(FrameIndex frame, std::vector<StackMark> stacks) {
    if (frame != frame_.index) return;
    frame_.stacks = std::move(stacks);
    pictureWasChanged();
}

void VideoView::setZones(FrameIndex frame, std::vector<ZoneMark> zones) {
    if (frame != frame_.index || (zones.empty() && frame_.zones.empty())) return;
    frame_.zones = std::move(zones);
    pictureWasChanged();
}

void VideoView::setNorth(FrameIndex frame, std::optional<double> north_deg) {
    if (frame != frame_.index || north_deg == frame_.north_deg) return;
    frame_.north_deg = north_deg;
    pictureWasChanged();
}

void VideoView::setVerdicts(FrameIndex frame, bool evaluated, std::vector<VerdictMark> verdicts,
                            std::vector<BoxRecord> ground_truth) {
    if (frame != frame_.index) return;
    frame_.evaluated = evaluated;
    frame_.verdicts = std::move(verdicts);
    frame_.ground_truth = std::move(ground_truth);
    pictureWasChanged();
}

void VideoView::setInspectedArea(std::optional<OrientedBox> area) {
    if (!area && !inspected_area_) return;
    inspected_area_ = area;
    pictureWasChanged();
}

void VideoView::setPlaceMark(std::optional<PlaceMark> mark) {
    if (!mark && !place_mark_) return;
    place_mark_ = std::move(mark);
    pictureWasChanged();
}

void VideoView::setBadge(const QString& text) {
    if (badge_ == text) return;
    badge_ = text;
    pictureWasChanged();
}

void VideoView::setBadgeOnRight(bool on_right) {
    badge_on_right_ = on_right;
    pictureWasChanged();
}

void VideoView::setCovered(int covered_px) {
    if (covered_px == covered_px_) return;
    covered_px_ = covered_px;
    if (!badge_.isEmpty()) pictureWasChanged();
    update();  // the hint of a tool
}

void VideoView::setTool(CanvasTool* tool) {
    tool_ = tool;
    under_tool_ = {};
    hideKeyPointer();
    updateCursorShape();
    pictureWasChanged();
}

bool VideoView::toolTakes(bool (CanvasTool::*handler)(const QMouseEvent&, const CanvasPlace&),
                          const QMouseEvent& event) {
    if (tool_ == nullptr || space_held_) return false;
    const bool taken = (tool_->*handler)(event, place());
    if (!drag_from_) updateCursorShape();
    return taken;
}

bool VideoView::toolTakesKeys() const {
    return tool_ != nullptr && tool_->takesPlaces();
}

std::optional<QPointF> VideoView::keyPointer() const {
    return toolTakesKeys() ? pointer_.at() : std::nullopt;
}

void VideoView::hideKeyPointer() {
    if (!pointer_.at()) return;
    pointer_.hide();
    emit cursorMoved(std::nullopt);
    update();
}

void VideoView::moveKeyPointer(QPointF view_point) {
    mouseTakesOver();
    if (!toolTakesKeys()) return;
    pointer_.showAt(view_point);
    pointer_.point(*tool_, place(true));
    reportCursor(view_point);
    update();
}

CanvasPlace VideoView::place(bool by_keys) const {
    return {transform_, frame_.image, QRectF(rect()), by_keys};
}

bool VideoView::finishesByKey(const QKeyEvent& key) {
    const bool enter = key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter;
    const bool plain = (key.modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
    // Where the cross is, Enter sets a place as a click does.
    return enter && plain && !pointer_.at() && tool_->finishByKey();
}

bool VideoView::takesToolKey(const QKeyEvent& key) {
    if (!toolTakesKeys() || !KeyPointer::owns(key)) return false;
    if (const auto step = KeyPointer::stepOf(key)) {
        movePointer(*step);
    } else if (key.key() == Qt::Key_Backspace) {
        if (tool_->takeBack()) pointer_.forget();
    } else if (!key.isAutoRepeat() && !finishesByKey(key)) {
        setByKey(key);
    }
    update();
    return true;
}

void VideoView::movePointer(QPointF step) {
    pointer_.showAt(anchor());
    const QPointF beyond = pointer_.moveBy(step / devicePixelRatioF(), QRectF(rect()).adjusted(0, 0, -1, -1));
    if (!beyond.isNull() && !transform_.fitted()) {  // the picture comes to meet it
        transform_.panBy(-beyond);
        transformWasChanged();
    }
    pointer_.point(*tool_, place(true));
    reportCursor(*pointer_.at());
}

void VideoView::setByKey(const QKeyEvent& key) {
    // The first one shows where it would be.
    if (pointer_.at())
        pointer_.set(key, *tool_, place(true));
    else
        pointer_.showAt(anchor());
    updateCursorShape();
    update();
}

void VideoView::mouseTakesOver() {
    // What keys took hold of would be held for ever: nobody lets it go.
    if (pointer_.holds() && tool_ != nullptr) tool_->takeBack();
    hideKeyPointer();
}

void VideoView::fit() {
    transform_.fit();
    transformWasChanged();
}

void VideoView::showOneToOne() {
    transform_.setZoomAround(anchor(), 1);
    transformWasChanged();
}

void VideoView::zoomBy(double factor) {
    transform_.zoomAround(anchor(), factor);
    transformWasChanged();
}

void VideoView::restore(double zoom, QPointF centre) {
    transform_.setZoomAround(QPointF(width() / 2.0, height() / 2.0), zoom);
    transform_.centreOn(centre);
    transformWasChanged();
}

void VideoView::centreOn(QPointF image_point) {
    transform_.centreOn(image_point);
    transformWasChanged();
}

void VideoView::setRotation(double radians) {
    if (radians == transform_.rotation()) return;
    transform_.setRotation(radians);
    transformWasChanged();
}

void VideoView::setGround(const std::optional<QTransform>& ground_from_image) {
    if (!ground_from_image && !transform_.onGround()) return;
    const bool was_on_ground = transform_.onGround();
    const QPointF looked_at = transform_.imageFromView({width() / 2.0, height() / 2.0});
    transform_.setGround(ground_from_image);
    if (transform_.onGround() && was_on_ground)
        transform_.keepInView();
    else if (transform_.fitted())
        transform_.fit();
    else
        transform_.centreOn(looked_at);
    transformWasChanged();
}

void VideoView::pictureWasChanged() {
    picture_changed_ = true;
    update();
}

QPointF VideoView::anchor() const {
    if (const auto at = keyPointer()) return *at;
    const QPointF cursor = mapFromGlobal(QPointF(QCursor::pos()));
    if (underMouse() && rect().contains(cursor.toPoint())) return cursor;
    return {width() / 2.0, height() / 2.0};
}

void VideoView::transformWasChanged() {
    pointer_.forgetPlace();
    pictureWasChanged();
    emit transformChanged();
}

void VideoView::resizeEvent(QResizeEvent*) {
    transform_.setView(size(), devicePixelRatioF());
    transformWasChanged();
}

void VideoView::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::FontChange) pictureWasChanged();  // captions are written in it
}

void VideoView::wheelEvent(QWheelEvent* event) {
    const double steps = event->angleDelta().y() / 120.0;
    if (steps == 0) return;
    transform_.zoomAround(event->position(), std::pow(kWheelStep, steps));
    transformWasChanged();
    reportCursor(event->position());
    event->accept();
}

bool VideoView::event(QEvent* event) {
    if (event->type() == QEvent::NativeGesture) {
        const auto* gesture = static_cast<QNativeGestureEvent*>(event);
        if (gesture->gestureType() == Qt::ZoomNativeGesture) {
            transform_.zoomAround(gesture->position(), 1 + gesture->value());
            transformWasChanged();
            return true;
        }
    }
    if (event->type() == QEvent::ShortcutOverride) {
        // The space bar both plays (tapped) and pans (held while dragging), so the canvas decides on its release.
        const auto* key = static_cast<QKeyEvent*>(event);
        const bool space = key->key() == Qt::Key_Space && key->modifiers() == Qt::NoModifier;
        // Arrows step frames or move boxes, Backspace rejects: not while a tool waits for places.
        if (space || (toolTakesKeys() && KeyPointer::owns(*key))) {
            event->accept();
            return true;
        }
    }
    return QWidget::event(event);
}

void VideoView::mousePressEvent(QMouseEvent* event) {
    mouseTakesOver();
    if (toolTakes(&CanvasTool::press, *event)) return;
    if (event->button() != Qt::LeftButton && event->button() != Qt::MiddleButton) return;
    drag_from_ = event->position();
    pressed_at_ = event->position();
    dragged_ = false;
}

void VideoView::mouseMoveEvent(QMouseEvent* event) {
    mouseTakesOver();
    reportCursor(event->position());
    if (toolTakesKeys()) update();  // the hint makes way
    if (toolTakes(&CanvasTool::move, *event)) return;
    if (!drag_from_) return;
    if (!dragged_ && QLineF(pressed_at_, event->position()).length() < kDragThreshold) return;
    dragged_ = true;
    space_panned_ = space_held_;
    updateCursorShape();
    transform_.panBy(event->position() - *drag_from_);
    drag_from_ = event->position();
    transformWasChanged();
}

void VideoView::mouseReleaseEvent(QMouseEvent* event) {
    if (toolTakes(&CanvasTool::release, *event)) return;
    const bool was_click = drag_from_.has_value() && !dragged_ && event->button() == Qt::LeftButton;
    drag_from_.reset();
    dragged_ = false;
    updateCursorShape();
    if (!was_click || !frame_.result || tool_ != nullptr) return;
    const QPointF point = transform_.imageFromView(event->position());
    const double margin = kHitMargin / transform_.scaleAt(point);
    std::optional<TrackId> clicked;
    if (settings_.isDrawn(TrackLayer::kKind)) {
        clicked = trackAt(frame_.result->tracks, settings_.style(), point, margin);
        if (!clicked) clicked = trackAt(frame_.doubtful, settings_.style(), point, margin);
    }
    emit trackClicked(clicked);
    emit placeClicked(point, margin);
}

void VideoView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || toolTakes(&CanvasTool::doubleClick, *event)) return;
    if (transform_.fitted())
        transform_.setZoomAround(event->position(), 2);
    else
        transform_.fit();
    transformWasChanged();
}

void VideoView::keyPressEvent(QKeyEvent* event) {
    if (event->key() != Qt::Key_Space) {
        if (!takesToolKey(*event)) QWidget::keyPressEvent(event);
        return;
    }
    if (event->isAutoRepeat()) return;
    space_held_ = true;
    space_panned_ = false;
    updateCursorShape();
}

void VideoView::keyReleaseEvent(QKeyEvent* event) {
    if (event->key() != Qt::Key_Space || event->isAutoRepeat()) {
        QWidget::keyReleaseEvent(event);
        return;
    }
    const bool tapped = space_held_ && !space_panned_;
    space_held_ = false;
    updateCursorShape();
    if (!tapped) return;
    if (keyPointer())
        setByKey(*event);
    else
        emit playToggled();
}

void VideoView::contextMenuEvent(QContextMenuEvent* event) {
    if (tool_ != nullptr || !frame_.result) return;
    const QPointF point = transform_.imageFromView(event->pos());
    emit placeMenuRequested(point, kHitMargin / transform_.scaleAt(point), event->globalPos());
    event->accept();
}

void VideoView::leaveEvent(QEvent*) {
    if (tool_ != nullptr) tool_->leave();
    if (toolTakesKeys()) update();
    emit cursorMoved(std::nullopt);
}

void VideoView::reportCursor(QPointF view_point) {
    const QPointF point = transform_.imageFromView(view_point);
    const QRectF image(-0.5, -0.5, transform_.imageSize().width(), transform_.imageSize().height());
    emit cursorMoved(image.contains(point) ? std::optional(point) : std::nullopt);
}

void VideoView::updateCursorShape() {
    if (drag_from_ && dragged_)
        setCursor(Qt::ClosedHandCursor);
    else if (space_held_)
        setCursor(Qt::OpenHandCursor);
    else if (const QCursor* shape = tool_ != nullptr ? tool_->cursor() : nullptr)
        setCursor(*shape);
    else
        unsetCursor();
}

}  // namespace eyrie::ui

#include "moc_video_view.cpp"
