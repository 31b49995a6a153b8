#include "label/canvas/label_tool.h"

#include <QLineF>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/mark_colours.h"
#include "label/canvas/label_layer.h"

namespace eyrie::ui {

namespace {
const QColor kRegionColour(255, 160, 40);
constexpr double kHandleHitMargin = 4;    ///< logical px
constexpr double kToolDragThreshold = 4;  ///< logical px
constexpr double kLoupeFactor = 2;        ///< of the canvas' own scale …
constexpr double kLeastMagnification = 6;
constexpr double kMostMagnification = 16;
constexpr int kNudged_ms = 1500;
constexpr double kShortest = 2;      ///< px: clicks nearer than this are one
constexpr double kSmallestArea = 1;  ///< px², of a triangle of corners

/// Whether three of the corners are no line. An outline may cross itself: what it winds around is ignored.
bool hasArea(const std::vector<cv::Point2d>& corners) {
    for (std::size_t i = 2; i < corners.size(); ++i)
        if (std::abs((corners[1] - corners[0]).cross(corners[i] - corners[0])) >= 2 * kSmallestArea) return true;
    return false;
}
}  // namespace

LabelTool::LabelTool(QObject* parent) : QObject(parent), nudged_(kNudged_ms, [this] { emit repaintNeeded(); }) {}

void LabelTool::setScene(LabelScene scene) {
    const bool another = scene.frame != scene_.frame || scene.selected != scene_.selected;
    scene_ = std::move(scene);
    // What was dragged in another frame, or of another object, must not be let go here.
    if (another && handle_) {
        handle_.reset();
        draft_.reset();
    }
    emit repaintNeeded();
}

const LabelMark* LabelTool::selectedMark() const {
    if (!scene_.selected) return nullptr;
    for (const LabelMark& mark : scene_.marks)
        if (isObject(mark.kind) && mark.id == *scene_.selected) return &mark;
    return nullptr;
}

void LabelTool::startRegion() {
    cancel();
    region_.emplace();
    commands_.show_region_drawing(true);
    emit repaintNeeded();
}

void LabelTool::finishRegion() {
    if (!region_) return;
    const std::vector<cv::Point2d> polygon = *region_;
    if (!polygon.empty() && !hasArea(polygon)) {  // drawing goes on: what is there can be mended
        region_refused_ = true;
        emit repaintNeeded();
        return;
    }
    cancel();
    if (!polygon.empty()) commands_.add_region(polygon, scene_.frame);
}

void LabelTool::addRegionCorner(QPointF point) {
    const cv::Point2d corner(point.x(), point.y());
    // The second click of a double one is no corner.
    if (!region_->empty() && cv::norm(region_->back() - corner) < kShortest) return;
    region_->push_back(corner);
    region_refused_ = false;
    emit repaintNeeded();
}

void LabelTool::startDrawing(std::optional<ObjectId> object) {
    cancel();
    redrawn_ = object;
    drawing_ = true;
    commands_.show_drawing(true);
    emit repaintNeeded();
}

bool LabelTool::cancel() {
    const bool something = drawing_ || handle_ || region_;
    const bool was_region = std::exchange(region_, std::nullopt).has_value();
    const bool was_drawing = std::exchange(drawing_, false);
    region_refused_ = false;
    redrawn_.reset();
    rear_.reset();
    front_.reset();
    handle_.reset();
    draft_.reset();
    pressed_view_.reset();
    if (was_drawing) commands_.show_drawing(false);
    if (was_region) commands_.show_region_drawing(false);
    if (something) emit repaintNeeded();
    return something;
}

double LabelTool::usualWidth(QPointF rear, QPointF front) const {
    const QPointF middle = (rear + front) / 2;
    if (scene_.drawn_width > 0) return scene_.drawn_width * scene_.slope.factorAt({middle.x(), middle.y()});
    return QLineF(rear, front).length() * scene_.width_of_length;
}

void LabelTool::finishDrawing(const OrientedBox& box) {
    const FrameIndex frame = scene_.frame;
    const std::optional<ObjectId> object = redrawn_;
    cancel();
    if (object)
        commands_.redraw_box(*object, frame, box);
    else
        commands_.add_box(box, frame);
}

void LabelTool::updateDraft(QPointF point) {
    if (!rear_) {
        draft_.reset();
        return;
    }
    if (!front_) {
        draft_ = boxFromRearToFront(*rear_, point, usualWidth(*rear_, point));
        return;
    }
    OrientedBox box = boxFromRearToFront(*rear_, *front_, 1);
    box.width = std::max(1.0, 2 * std::abs(box.toBox({point.x(), point.y()}).y));
    draft_ = box;
}

bool LabelTool::press(const QMouseEvent& event, const CanvasPlace& place) {
    if (region_ && event.button() == Qt::RightButton) {
        finishRegion();
        return true;
    }
    if (region_ && event.button() == Qt::LeftButton) {
        addRegionCorner(place.transform.imageFromView(event.position()));
        return true;
    }
    if (event.button() == Qt::RightButton && drawing_) {
        cancel();
        return true;
    }
    if (event.button() != Qt::LeftButton) return false;
    pressed_view_ = event.position();
    pressed_image_ = place.transform.imageFromView(event.position());
    dragging_ = false;
    if (drawing_) return true;
    const LabelMark* selected = selectedMark();
    if (selected != nullptr && scene_.editable) {
        handle_ = handleAt(selected->box, place.transform, event.position());
        if (handle_) {
            start_box_ = selected->box;
            return true;
        }
    }
    return false;
}

bool LabelTool::move(const QMouseEvent& event, const CanvasPlace& place) {
    cursor_view_ = event.position();
    cursor_image_ = place.transform.imageFromView(event.position());
    if (region_) {
        emit repaintNeeded();
        return true;
    }
    const QPointF point = place.transform.imageFromView(event.position());
    if (pressed_view_ && QLineF(*pressed_view_, event.position()).length() >= kToolDragThreshold) dragging_ = true;
    if (drawing_) {
        if (pressed_view_ && dragging_ && !rear_)
            draft_ = boxFromCorners(pressed_image_, point, place.transform.rotation());
        else
            updateDraft(point);
        emit repaintNeeded();
        return true;
    }
    if (handle_) {
        if (!dragging_) return true;
        draft_ = draggedBox(start_box_, *handle_, pressed_image_, point);
        emit repaintNeeded();
        return true;
    }
    if (event.buttons() == Qt::NoButton) {
        const LabelMark* selected = selectedMark();
        const auto hovered = selected != nullptr && scene_.editable
                                 ? handleAt(selected->box, place.transform, event.position())
                                 : std::nullopt;
        if (hovered != hovered_) {
            hovered_ = hovered;
            emit repaintNeeded();
        }
    }
    return false;
}

bool LabelTool::release(const QMouseEvent& event, const CanvasPlace& place) {
    if (region_) return true;
    if (event.button() != Qt::LeftButton) return drawing_;
    const bool was_pressed = pressed_view_.has_value();
    pressed_view_.reset();
    const QPointF point = place.transform.imageFromView(event.position());
    if (drawing_) {
        if (!was_pressed) return true;
        if (dragging_ && !rear_) {
            finishDrawing(boxFromCorners(pressed_image_, point, place.transform.rotation()));
        } else if (!rear_) {
            rear_ = point;
        } else if (!front_) {
            const double length = std::hypot(point.x() - rear_->x(), point.y() - rear_->y());
            if (length < kShortest) return true;
            const bool asks_width = (event.modifiers() & Qt::ShiftModifier) != 0;
            if (asks_width)
                front_ = point;
            else
                finishDrawing(boxFromRearToFront(*rear_, point, usualWidth(*rear_, point)));
        } else {
            updateDraft(point);
            finishDrawing(OrientedBox(*draft_));
        }
        dragging_ = false;
        emit repaintNeeded();
        return true;
    }
    if (handle_) {
        const BoxHandle handle = *handle_;
        const auto box = draft_;
        handle_.reset();
        draft_.reset();
        if (dragging_ && box && scene_.selected) {
            const bool turned = handle == BoxHandle::turn;
            const bool resized = !turned && handle != BoxHandle::centre;
            commands_.change_box(*scene_.selected, scene_.frame, *box, turned, resized);
        } else if (!dragging_) {
            // A click inside the selected box may mean a smaller one in it.
            const LabelMark* hit = markAt(scene_, point, kHandleHitMargin / place.transform.scale());
            if (hit != nullptr && isObject(hit->kind))
                commands_.choose_object(hit->id, event.modifiers() & (Qt::ControlModifier | Qt::ShiftModifier));
        }
        dragging_ = false;
        emit repaintNeeded();
        return true;
    }
    if (!was_pressed || dragging_) return false;
    const LabelMark* hit = markAt(scene_, point, kHandleHitMargin / place.transform.scale());
    const bool add = (event.modifiers() & (Qt::ControlModifier | Qt::ShiftModifier)) != 0;
    if (hit != nullptr && hit->kind == LabelKind::proposal)
        commands_.choose_proposal(hit->id, add);
    else
        commands_.choose_object(hit != nullptr ? std::optional<ObjectId>(hit->id) : std::nullopt, add);
    return false;  // the canvas ends its own press
}

bool LabelTool::doubleClick(const QMouseEvent& event, const CanvasPlace& place) {
    if (region_) {
        addRegionCorner(place.transform.imageFromView(event.position()));
        finishRegion();
        return true;
    }
    // Two quick clicks draw as two slow ones do; on an object they do not zoom.
    if (drawing_) return press(event, place);
    const QPointF point = place.transform.imageFromView(event.position());
    return markAt(scene_, point, kHandleHitMargin / place.transform.scale()) != nullptr;
}

void LabelTool::leave() {
    cursor_view_.reset();
    cursor_image_.reset();
    hovered_.reset();
    emit repaintNeeded();
}

bool LabelTool::takeBack() {
    if (region_ && !region_->empty()) {
        region_->pop_back();
        region_refused_ = false;
    } else if (front_)
        front_.reset();
    else if (rear_)
        rear_.reset();
    else
        return false;
    if (cursor_image_ && drawing_) updateDraft(*cursor_image_);
    emit repaintNeeded();
    return true;
}

QString LabelTool::hint(const CanvasPlace& place) const {
    if (region_) {
        const QString begin = region_refused_ ? tr("An ignore region needs three corners that are not on one line.")
                                              : tr("Click the corners of the ignore region.");
        // Where the cross is, Enter clicks.
        const QString done = place.by_keys ? tr("Double-click: done") : tr("Double-click or Enter: done");
        return tr("%1 %2 · Backspace: remove the last one · Esc: cancel").arg(begin, done);
    }
    if (!drawing_) return {};
    if (front_) return tr("Click a side of the object. Backspace: choose its front again · Esc: cancel");
    if (rear_)
        return tr("Click the front of the object (Shift: then a side). Backspace: choose its rear again · Esc: cancel");
    return tr("Click the rear of the object, or drag a box around it. Esc: cancel");
}

bool LabelTool::finishByKey() {
    if (!region_ || region_->empty()) return false;
    finishRegion();
    return true;
}

const QCursor* LabelTool::cursor() const {
    static const QCursor cross(Qt::CrossCursor);
    static const QCursor move_all(Qt::SizeAllCursor);
    static const QCursor hand(Qt::PointingHandCursor);
    if (drawing_ || region_) return &cross;
    const auto handle = handle_ ? handle_ : hovered_;
    if (!handle) return nullptr;
    return *handle == BoxHandle::centre ? &move_all : &hand;
}

void LabelTool::paint(QPainter& painter, const CanvasPlace& place) const {
    const LabelMark* selected = selectedMark();
    if (draft_ && handle_ && selected != nullptr) {
        LabelScene shown = scene_;
        for (LabelMark& mark : shown.marks)
            if (isObject(mark.kind) && mark.id == *scene_.selected) {
                mark.box = *draft_;
                mark.kind = LabelKind::keyframe;
            }
        paintLabels(painter, shown, place.transform, place.view);
    } else {
        paintLabels(painter, scene_, place.transform, place.view);
    }
    if (selected != nullptr && scene_.editable && !drawing_) {
        const OrientedBox& box = draft_ ? *draft_ : selected->box;
        const auto handles = boxHandles(box, place.transform);
        QVector<QLineF> arm{{handles[static_cast<std::size_t>(BoxHandle::front)].second, handles.back().second}};
        drawEdgedLines(painter, arm, {selected->colour, edgeColour(), 1.2});
        for (const auto& [handle, at] : handles) {
            const bool hot = handle == (handle_ ? handle_ : hovered_);
            const double size = hot ? 5 : handle == BoxHandle::centre ? 2.5 : 3.5;
            painter.setPen(QPen(edgeColour(), 1.2));
            painter.setBrush(hot ? QColor(255, 255, 255) : selected->colour);
            if (handle == BoxHandle::turn || handle == BoxHandle::centre)
                painter.drawEllipse(at, size + 0.5, size + 0.5);
            else
                painter.drawRect(QRectF(at - QPointF(size, size), QSizeF(2 * size, 2 * size)));
        }
        painter.setBrush(Qt::NoBrush);
    }
    if (drawing_ && draft_) {
        QVector<QLineF> lines;
        appendBox(lines, *draft_, place.transform, place.view);
        appendHeading(lines, *draft_, place.transform, place.view);
        drawEdgedLines(painter, lines, {scene_.drawn_colour, edgeColour(), 2});
    }
    if (region_) {
        QPolygonF corners;
        for (const cv::Point2d& corner : *region_) corners << place.transform.viewFromImage({corner.x, corner.y});
        if (cursor_view_) corners << *cursor_view_;
        painter.setPen(QPen(kRegionColour, 1.6, Qt::DashLine));
        painter.setBrush(QBrush(QColor(255, 160, 40, 50)));
        painter.drawPolygon(corners);
        painter.setBrush(Qt::NoBrush);
    }
    paintLoupes(painter, place);
}

void LabelTool::paintLoupes(QPainter& painter, const CanvasPlace& place) const {
    if (!loupe_shown_ || place.transform.scale() >= kMostMagnification) return;
    const LabelMark* selected = selectedMark();
    Loupe loupe;
    loupe.view = place.view;
    loupe.magnification = std::clamp(place.transform.scale() * kLoupeFactor, kLeastMagnification, kMostMagnification);
    loupe.rotation = place.transform.rotation();
    if ((drawing_ || (handle_ && dragging_)) && cursor_view_) {
        loupe.view_point = *cursor_view_;
        loupe.image_point = place.transform.imageFromView(*cursor_view_);
        loupe.box = draft_;
        loupe.colour = drawing_ ? scene_.drawn_colour : selected ? selected->colour : Qt::white;
    } else if (nudged_.pending() && selected != nullptr) {
        // All of the box, beside it; where the canvas shows it larger only the stack is worth a loupe.
        const OrientedBox& box = selected->box;
        constexpr double kShare = 0.8;
        loupe.magnification = std::min(loupe.magnification, kShare * kLoupeSide / std::hypot(box.length, box.width));
        const LoupeStack* stack = stackHere();
        if (loupe.magnification < place.transform.scale() && (stack == nullptr || stack->image.isNull())) return;
        loupe.image_point = {box.centre.x, box.centre.y};
        loupe.view_point = place.transform.viewFromImage(loupe.image_point);
        for (const cv::Point2d& corner : box.corners()) {
            const QPointF at = place.transform.viewFromImage({corner.x, corner.y});
            loupe.view_point = {std::max(loupe.view_point.x(), at.x()), std::min(loupe.view_point.y(), at.y())};
        }
        loupe.box = box;
        loupe.colour = selected->colour;
    } else {
        return;
    }
    paintLoupe(painter, place.image, loupe, drawing_ && !redrawn_ ? nullptr : stackHere());
}

void LabelTool::setStack(std::optional<LoupeStack> stack) {
    stack_ = std::move(stack);
    emit repaintNeeded();
}

void LabelTool::setStackShown(bool shown) {
    stack_shown_ = shown;
    emit repaintNeeded();
}

const LoupeStack* LabelTool::stackHere() const {
    const bool here = stack_shown_ && stack_ && scene_.selected == stack_->object && scene_.frame == stack_->frame;
    return here ? &*stack_ : nullptr;
}

void LabelTool::showNudged() {
    nudged_.start();
    emit repaintNeeded();
}

}  // namespace eyrie::ui

#include "moc_label_tool.cpp"
