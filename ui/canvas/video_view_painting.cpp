#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

#include "canvas/canvas_tool.h"
#include "canvas/drawing/caption_placer.h"
#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/mark_colours.h"
#include "canvas/drawing/tool_hint.h"
#include "canvas/layers/overlay_layer.h"
#include "canvas/video_view.h"

namespace eyrie::ui {

// How the canvas paints: the picture, the overlays on it, and on top what a tool draws.

namespace {
const QColor kGround(34, 36, 40);          ///< around the picture, in both themes: overlays keep their contrast
const QColor kMissingPicture(58, 61, 66);  ///< where a picture should be and is not
const QColor kBadgeText(30, 24, 0);
constexpr double kInspectedWidth = 2.2;
constexpr double kHintRoom = 80;  ///< logical px at the lower edge that what a tool wants may cover
}  // namespace

QImage VideoView::emptyPicture() const {
    QImage image(size() * devicePixelRatioF(), QImage::Format_RGB32);
    image.setDevicePixelRatio(devicePixelRatioF());
    return image;
}

QImage VideoView::picture() const {
    QImage image = emptyPicture();
    QPainter painter(&image);
    painter.setFont(font());
    paint(painter);
    return image;
}

void VideoView::paintEvent(QPaintEvent*) {
    // A window moved to a screen of another density repaints without being resized.
    if (transform_.devicePixelRatio() != devicePixelRatioF()) {
        transform_.setView(size(), devicePixelRatioF());
        picture_changed_ = true;
    }
    QPainter painter(this);
    if (tool_ != nullptr)
        paintWithTool(painter);
    else
        paint(painter);
}

// A tool draws with every move of the mouse, over a picture that stays: that is painted once then. While the video
// plays it is another each time, and keeping it would be in vain.
void VideoView::paintWithTool(QPainter& painter) {
    if (std::exchange(picture_changed_, false)) {
        under_tool_ = {};
        paint(painter);
        return;
    }
    if (under_tool_.isNull()) {
        under_tool_ = emptyPicture();
        QPainter kept(&under_tool_);
        kept.setFont(font());
        paintPicture(kept);
    }
    painter.drawImage(QPointF(0, 0), under_tool_);
    prepareToDraw(painter);
    paintTool(painter);
}

void VideoView::paint(QPainter& painter) const {
    paintPicture(painter);
    if (tool_ != nullptr) paintTool(painter);
}

void VideoView::prepareToDraw(QPainter& painter) const {
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setRenderHint(QPainter::SmoothPixmapTransform, !transform_.sharp());
    QFont label_font = font();
    label_font.setPointSizeF(std::max(7.0, font().pointSizeF() * 0.85));
    label_font.setBold(true);
    painter.setFont(label_font);
}

void VideoView::paintPicture(QPainter& painter) const {
    painter.fillRect(rect(), kGround);
    paintImage(painter);
    prepareToDraw(painter);
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
}

void VideoView::paintTool(QPainter& painter) const {
    const CanvasPlace shown = place(pointer_.at().has_value());
    painter.setPen(QPen());
    painter.setBrush(Qt::NoBrush);
    tool_->paint(painter, shown);
    if (!tool_->takesPlaces()) return;
    pointer_.paint(painter);
    const QString wanted = tool_->hint(shown);
    // Where one works the hint would be in the way.
    const auto edge = anchor().y() > height() - kHintRoom ? HintEdge::upper : HintEdge::lower;
    paintToolHint(painter, shown.view.adjusted(0, covered_px_, 0, 0), edge,
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
    QRectF plate(10, 10 + covered_px_, text.width() + 20, text.height() + 10);
    if (badge_on_right_) plate.moveRight(width() - 10);
    painter.setPen(Qt::NoPen);
    painter.setBrush(toolColour());
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

}  // namespace eyrie::ui
