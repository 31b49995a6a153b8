#include "canvas/video_view.h"

#include <QContextMenuEvent>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QPainter>
#include <QWheelEvent>
#include <cmath>

#include "canvas/canvas_tool.h"
#include "canvas/drawing/caption_placer.h"
#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/tool_hint.h"
#include "canvas/layers/overlay_table.h"
#include "canvas/layers/track_layer.h"

namespace eyrie::ui {

namespace {
const QColor kGround(34, 36, 40);          ///< around the picture, in both themes: overlays keep their contrast
const QColor kMissingPicture(58, 61, 66);  ///< where a picture should be and is not
const QColor kBadgeGround(255, 200, 40);
const QColor kBadgeText(30, 24, 0);
constexpr double kWheelStep = 1.25;
constexpr double kDragThreshold = 4;
constexpr double kHitMargin = 4;  ///< logical px around a box that still count as hit
constexpr double kInspectedWidth = 2.2;
constexpr double kHintRoom = 80;  ///< logical px at the lower edge that what a tool wants may cover
}  // namespace

VideoView::VideoView(OverlaySettings& settings, QWidget* parent) : QWidget(parent), settings_(settings) {
    for (const OverlayRow& row : overlayTable()) layers_.emplace_back(row.kind, row.make());
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setAccessibleName(tr("Video"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    connect(&settings_, &OverlaySettings::changed, this, qOverload<>(&QWidget::update));
}

VideoView::~VideoView() = default;

void VideoView::setFrame(ViewFrame frame) {
    if (frame.index != frame_.index) pointer_.forgetPlace();
    frame_ = std::move(frame);
    adoptSize();
    update();
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
    update();
}

void VideoView::setStacks(FrameIndex frame, std::vector<StackMark> stacks) {
    if (frame != frame_.index) return;
    frame_.stacks = std::move(stacks);
    update();
}

void VideoView::setZones(FrameIndex frame, std::vector<ZoneMark> zones) {
    if (frame != frame_.index || (zones.empty() && frame_.zones.empty())) return;
    frame_.zones = std::move(zones);
    update();
}

void VideoView::setNorth(FrameIndex frame, std::optional<double> north_deg) {
    if (frame != frame_.index || north_deg == frame_.north_deg) return;
    frame_.north_deg = north_deg;
    update();
}

void VideoView::setVerdicts(FrameIndex frame, bool evaluated, std::vector<VerdictMark> verdicts,
                            std::vector<BoxRecord> ground_truth) {
    if (frame != frame_.index) return;
    frame_.evaluated = evaluated;
    frame_.verdicts = std::move(verdicts);
    frame_.ground_truth = std::move(ground_truth);
    update();
}

void VideoView::setInspectedArea(std::optional<OrientedBox> area) {
    if (!area && !inspected_area_) return;
    inspected_area_ = area;
    update();
}

void VideoView::setPlaceMark(std::optional<PlaceMark> mark) {
    if (!mark && !place_mark_) return;
    place_mark_ = std::move(mark);
    update();
}

void VideoView::setBadge(const QString& text) {
    if (badge_ == text) return;
    badge_ = text;
    update();
}

void VideoView::setBadgeOnRight(bool on_right) {
    badge_on_right_ = on_right;
    update();
}

void VideoView::setTool(CanvasTool* tool) {
    tool_ = tool;
    hideKeyPointer();
    updateCursorShape();
    update();
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

QPointF VideoView::anchor() const {
    if (const auto at = keyPointer()) return *at;
    const QPointF cursor = mapFromGlobal(QPointF(QCursor::pos()));
    if (underMouse() && rect().contains(cursor.toPoint())) return cursor;
    return {width() / 2.0, height() / 2.0};
}

void VideoView::transformWasChanged() {
    pointer_.forgetPlace();
    update();
    emit transformChanged();
}

QImage VideoView::picture() const {
    QImage image(size() * devicePixelRatioF(), QImage::Format_RGB32);
    image.setDevicePixelRatio(devicePixelRatioF());
    QPainter painter(&image);
    painter.setFont(font());
    paint(painter);
    return image;
}

void VideoView::paintEvent(QPaintEvent*) {
    // A window moved to a screen of another density repaints without being resized.
    if (transform_.devicePixelRatio() != devicePixelRatioF()) transform_.setView(size(), devicePixelRatioF());
    QPainter painter(this);
    paint(painter);
}

void VideoView::paint(QPainter& painter) const {
    painter.fillRect(rect(), kGround);
    paintImage(painter);
    painter.setRenderHint(QPainter::Antialiasing);
    QFont label_font = font();
    label_font.setPointSizeF(std::max(7.0, font().pointSizeF() * 0.85));
    label_font.setBold(true);
    painter.setFont(label_font);
    static const FrameResult nothing_found;
    const QRectF view = QRectF(rect()).adjusted(-8, -8, 8, 8);
    CaptionPlacer captions(view);
    const FrameResult& result = frame_.result ? *frame_.result : nothing_found;
    const OverlayScene scene{frame_, result, transform_, settings_.style(), selected_track_, view, captions};
    for (const auto& [kind, layer] : layers_)
        if (settings_.isDrawn(kind) && (frame_.result || !layer->needsResult())) layer->paint(painter, scene);
    // Marks of the review are in the way of who draws.
    const bool marked = tool_ == nullptr && !settings_.hidden();
    if (frame_.result && marked) paintInspectedArea(painter);
    if (marked) paintPlaceMark(painter);
    paintBadge(painter);
    if (tool_ != nullptr) paintTool(painter);
}

void VideoView::paintTool(QPainter& painter) const {
    const CanvasPlace shown = place(pointer_.at().has_value());
    tool_->paint(painter, shown);
    if (!tool_->takesPlaces()) return;
    pointer_.paint(painter);
    const QString wanted = tool_->hint(shown);
    // Where one works the hint would be in the way.
    const auto edge = anchor().y() > height() - kHintRoom ? HintEdge::upper : HintEdge::lower;
    paintToolHint(painter, shown.view, edge,
                  wanted.isEmpty() ? pointer_.hint() : wanted + QLatin1Char('\n') + pointer_.hint());
}

void VideoView::paintInspectedArea(QPainter& painter) const {
    if (!inspected_area_) return;
    QVector<QLineF> lines;
    appendBox(lines, *inspected_area_, transform_, rect());
    appendHeading(lines, *inspected_area_, transform_, rect());
    drawEdgedLines(painter, lines, {settings_.style().colours.stack, settings_.style().colours.edge, kInspectedWidth});
}

void VideoView::paintPlaceMark(QPainter& painter) const {
    if (!place_mark_) return;
    const OverlayColours& colours = settings_.style().colours;
    QVector<QLineF> lines;
    appendBox(lines, place_mark_->area, transform_, rect());
    drawEdgedLines(painter, lines, {Qt::white, colours.edge, kInspectedWidth, Qt::DotLine});
    const double size = std::clamp(transform_.scale(), 2.0, 7.0);
    for (const PlaceMark::Dot& dot : place_mark_->dots)
        drawEdgedDots(painter, {transform_.viewFromImage(dot.place)}, size, dot.colour, colours.edge);
}

void VideoView::paintBadge(QPainter& painter) const {
    if (badge_.isEmpty()) return;
    const QRectF text = painter.fontMetrics().boundingRect(badge_);
    QRectF plate(10, 10, text.width() + 20, text.height() + 10);
    if (badge_on_right_) plate.moveRight(width() - 10);
    painter.setPen(Qt::NoPen);
    painter.setBrush(kBadgeGround);
    painter.drawRoundedRect(plate, 4, 4);
    painter.setPen(kBadgeText);
    painter.drawText(plate, Qt::AlignCenter, badge_);
}

void VideoView::paintImage(QPainter& painter) const {
    if (frame_.image.isNull()) {
        if (transform_.imageSize().isEmpty()) return;
        painter.setTransform(transform_.drawing(), true);
        painter.fillRect(QRectF(QPointF(-0.5, -0.5), QSizeF(transform_.imageSize())), kMissingPicture);
        painter.resetTransform();
        return;
    }
    if (transform_.onGround()) {
        painter.setRenderHint(QPainter::SmoothPixmapTransform, !transform_.sharp());
        painter.setTransform(transform_.drawing(), true);
        painter.drawImage(QPointF(-0.5, -0.5), frame_.image);
        painter.resetTransform();
        return;
    }
    const QRectF visible = transform_.visibleImage();
    if (visible.isEmpty()) return;
    // Whole pixels around what is seen, so that the edges of the view show parts of pixels, not shifted ones.
    const int left = static_cast<int>(std::floor(visible.left() + 0.5));
    const int top = static_cast<int>(std::floor(visible.top() + 0.5));
    const int right = std::min(frame_.image.width(), static_cast<int>(std::ceil(visible.right() + 0.5)));
    const int bottom = std::min(frame_.image.height(), static_cast<int>(std::ceil(visible.bottom() + 0.5)));
    const QRectF source(left, top, right - left, bottom - top);
    const QRectF target(transform_.unturnedFromImage(source.topLeft() - QPointF(0.5, 0.5)),
                        source.size() * transform_.scale());
    painter.setRenderHint(QPainter::SmoothPixmapTransform, !transform_.sharp());
    painter.setTransform(transform_.turn(), true);
    painter.drawImage(target, frame_.image, source);
    painter.resetTransform();
}

void VideoView::resizeEvent(QResizeEvent*) {
    transform_.setView(size(), devicePixelRatioF());
    transformWasChanged();
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
