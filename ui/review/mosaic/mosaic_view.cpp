#include "review/mosaic/mosaic_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/mark_colours.h"

namespace eyrie::ui {

namespace {

const QColor kUnseen(34, 36, 40);  ///< in both themes, as around the video
constexpr double kClosest = 16;    ///< view px per px of the picture
constexpr double kStep = 1.25;
constexpr double kArrowStep = 40;  ///< px
constexpr double kClickSlop = 4;   ///< px
constexpr double kCross = 9;       ///< px

/// Keys that belong to the view while it has the focus.
bool isMosaicKey(const QKeyEvent& key) {
    if (key.modifiers() & ~Qt::KeypadModifier) return false;
    switch (key.key()) {
        case Qt::Key_Left:
        case Qt::Key_Right:
        case Qt::Key_Up:
        case Qt::Key_Down:
        case Qt::Key_Plus:
        case Qt::Key_Equal:
        case Qt::Key_Minus:
        case Qt::Key_0:
        case Qt::Key_Return:
        case Qt::Key_Enter:
            return true;
        default:
            return false;
    }
}

}  // namespace

MosaicView::MosaicView(std::function<void(QPointF)> ask, QWidget* parent) : QWidget(parent), ask_(std::move(ask)) {
    setFocusPolicy(Qt::StrongFocus);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setAccessibleName(tr("Mosaic of the ground"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

const SheetPicture* MosaicView::picture() const {
    if (!mosaic_ || sheet_ < 0 || sheet_ >= static_cast<int>(mosaic_->pictures.size())) return nullptr;
    return &mosaic_->pictures[static_cast<std::size_t>(sheet_)];
}

void MosaicView::show(const std::shared_ptr<const MosaicPicture>& mosaic, int sheet) {
    const bool same = mosaic && mosaic_ && mosaic->sheets == mosaic_->sheets && sheet == sheet_;
    mosaic_ = mosaic;
    sheet_ = mosaic ? sheet : -1;
    if (!same) {
        tint_ = {};
        place_.reset();
        fit();
    }
    changeStill();
}

void MosaicView::setFrame(FrameIndex frame) {
    frame_ = frame;
    update();
}

void MosaicView::setSelectedTrack(std::optional<TrackId> track) {
    selected_ = track;
    update();
}

void MosaicView::setPlace(std::optional<QPointF> on_sheet) {
    place_ = on_sheet;
    update();
}

void MosaicView::setColours(const OverlayColours& colours) {
    colours_ = colours;
    changeStill();
}

void MosaicView::setCoverage(CoverageLook look) {
    if (look == coverage_look_) return;
    coverage_look_ = look;
    tint_ = {};
    changeStill();
}

const SheetCoverage* MosaicView::coverage() const {
    if (picture() == nullptr || !mosaic_->coverage) return nullptr;
    return &mosaic_->coverage->at(static_cast<std::size_t>(sheet_));
}

// ---- place ----------------------------------------------------------------------------------------------------------

QPointF MosaicView::viewFromSheet(QPointF on_sheet) const {
    const SheetPicture* shown = picture();
    return shown == nullptr ? QPointF() : origin_ + shown->imageFromSheet(on_sheet) * scale_;
}

QPointF MosaicView::sheetFromView(QPointF in_view) const {
    const SheetPicture* shown = picture();
    return shown == nullptr ? QPointF() : shown->sheetFromImage((in_view - origin_) / scale_);
}

double MosaicView::unitsPerPx() const {
    const SheetPicture* shown = picture();
    return shown == nullptr ? 1 : 1 / (scale_ * shown->px_per_unit);
}

void MosaicView::fit() {
    fitted_ = true;
    const SheetPicture* shown = picture();
    if (shown == nullptr || shown->image.isNull()) return;
    const QSizeF size = shown->image.size();
    scale_ = std::min({width() / size.width(), height() / size.height(), kClosest});
    origin_ = QPointF(width() - size.width() * scale_, height() - size.height() * scale_) / 2;
    changeStill();
}

void MosaicView::zoomAround(QPointF in_view, double factor) {
    const SheetPicture* shown = picture();
    if (shown == nullptr) return;
    const QSizeF size = shown->image.size();
    const double least = std::min(width() / size.width(), height() / size.height()) / 2;
    const double scale = std::clamp(scale_ * factor, std::min(least, kClosest), kClosest);
    origin_ = in_view + (origin_ - in_view) * (scale / scale_);
    scale_ = scale;
    fitted_ = false;
    keepReachable();
    changeStill();
}

void MosaicView::panBy(QPointF way) {
    origin_ += way;
    fitted_ = false;
    keepReachable();
    changeStill();
}

void MosaicView::keepReachable() {
    const SheetPicture* shown = picture();
    if (shown == nullptr) return;
    constexpr double kKept = 30;  // px of it stay in view
    const QSizeF size = QSizeF(shown->image.size()) * scale_;
    origin_.setX(std::clamp(origin_.x(), kKept - size.width(), width() - kKept));
    origin_.setY(std::clamp(origin_.y(), kKept - size.height(), height() - kKept));
}

// ---- painting -------------------------------------------------------------------------------------------------------

void MosaicView::changeStill() {
    still_ = {};
    update();
}

QVector<QLineF> MosaicView::waysOf(const SheetPicture& shown, std::optional<TrackId> track) const {
    QVector<QLineF> ways;
    for (const SheetPath& path : *shown.paths) {
        if (track && *track != path.track) continue;
        for (std::size_t i = 1; i < path.points.size(); ++i)
            ways.append({viewFromSheet({path.points[i - 1].at.x, path.points[i - 1].at.y}),
                         viewFromSheet({path.points[i].at.x, path.points[i].at.y})});
    }
    return ways;
}

void MosaicView::paintTint(QPainter& painter, const SheetPicture& shown) {
    const SheetCoverage* covered = coverage();
    if (coverage_look_ == CoverageLook::none || covered == nullptr) return;
    if (tint_.isNull()) tint_ = coverageTint(*covered, coverage_look_);
    const cv::Rect2d& area = covered->area;
    painter.save();
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    // The last cells reach beyond the ground.
    painter.setClipRect(QRectF(origin_, QSizeF(shown.image.size()) * scale_));
    painter.drawImage(QRectF(viewFromSheet({area.x, area.y}), viewFromSheet({area.br().x, area.br().y})), tint_);
    painter.restore();
}

void MosaicView::paintStill(const SheetPicture& shown) {
    still_ = QPixmap(size() * devicePixelRatioF());
    still_.setDevicePixelRatio(devicePixelRatioF());
    still_.fill(kUnseen);
    QPainter painter(&still_);
    painter.setRenderHint(QPainter::SmoothPixmapTransform, scale_ < 4);
    painter.drawImage(QRectF(origin_, QSizeF(shown.image.size()) * scale_), shown.image);
    paintTint(painter, shown);
    painter.setRenderHint(QPainter::Antialiasing);
    drawEdgedLines(painter, waysOf(shown, std::nullopt), {colours_.track, colours_.edge, 1});
}

void MosaicView::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), kUnseen);
    const SheetPicture* shown = picture();
    if (shown == nullptr) return;
    if (still_.isNull() || still_.size() != size() * devicePixelRatioF()) paintStill(*shown);
    painter.drawPixmap(0, 0, still_);
    painter.setRenderHint(QPainter::Antialiasing);
    if (selected_) drawEdgedLines(painter, waysOf(*shown, selected_), {colours_.selected_track, colours_.edge, 2.4});
    if (mosaic_->sheets->sheetOf(frame_) == sheet_) {
        QPolygonF outline;
        for (const cv::Point2d& corner : mosaic_->sheets->outlineOf(frame_))
            outline << viewFromSheet({corner.x, corner.y});
        QVector<QLineF> sides;
        for (int i = 0; i < outline.size(); ++i) sides.append({outline[i], outline[(i + 1) % outline.size()]});
        drawEdgedLines(painter, sides, {Qt::white, colours_.edge, 1.4, Qt::DashLine});
    }
    if (place_) {
        const QPointF at = viewFromSheet(*place_);
        drawEdgedLines(
            painter,
            {{at - QPointF(kCross, 0), at + QPointF(kCross, 0)}, {at - QPointF(0, kCross), at + QPointF(0, kCross)}},
            {toolColour(), colours_.edge, 1.8});
    }
    if (hasFocus()) {
        // Return asks about the middle.
        const QPointF middle = QRectF(rect()).center();
        painter.setPen(QColor(255, 255, 255, 150));
        for (const QPointF way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
            painter.drawLine(middle + way * 3, middle + way * 7);
    }
}

void MosaicView::resizeEvent(QResizeEvent*) {
    if (fitted_) fit();
}

// ---- mouse and keys -------------------------------------------------------------------------------------------------

void MosaicView::wheelEvent(QWheelEvent* event) {
    zoomAround(event->position(), std::pow(kStep, event->angleDelta().y() / 120.0));
    event->accept();
}

void MosaicView::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    drag_from_ = pressed_at_ = event->position();
    dragged_ = false;
}

void MosaicView::mouseMoveEvent(QMouseEvent* event) {
    if (!drag_from_) return;
    if (!dragged_ && QLineF(pressed_at_, event->position()).length() < kClickSlop) return;
    dragged_ = true;
    panBy(event->position() - *drag_from_);
    drag_from_ = event->position();
}

void MosaicView::mouseReleaseEvent(QMouseEvent* event) {
    const bool clicked = drag_from_ && !dragged_ && event->button() == Qt::LeftButton;
    drag_from_.reset();
    if (clicked && picture() != nullptr) ask_(sheetFromView(event->position()));
}

void MosaicView::mouseDoubleClickEvent(QMouseEvent*) {
    fit();
}

bool MosaicView::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && isMosaicKey(*static_cast<QKeyEvent*>(event))) {
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

void MosaicView::keyPressEvent(QKeyEvent* event) {
    if (!isMosaicKey(*event)) {
        QWidget::keyPressEvent(event);
        return;
    }
    const QPointF middle = QRectF(rect()).center();
    switch (event->key()) {
        case Qt::Key_Left:
            return panBy({kArrowStep, 0});
        case Qt::Key_Right:
            return panBy({-kArrowStep, 0});
        case Qt::Key_Up:
            return panBy({0, kArrowStep});
        case Qt::Key_Down:
            return panBy({0, -kArrowStep});
        case Qt::Key_Minus:
            return zoomAround(middle, 1 / kStep);
        case Qt::Key_0:
            return fit();
        case Qt::Key_Return:
        case Qt::Key_Enter:
            if (picture() != nullptr) ask_(sheetFromView(middle));
            return;
        default:
            return zoomAround(middle, kStep);
    }
}

}  // namespace eyrie::ui

#include "moc_mosaic_view.cpp"
