#include "canvas/view_transform.h"

#include <QPolygonF>
#include <algorithm>
#include <cmath>

namespace eyrie::ui {

namespace {
/// Share of the view, or of the image if that is smaller, that panning always leaves covered.
constexpr double kReachableShare = 0.2;

QPointF turned(QPointF vector, double radians) {
    if (radians == 0) return vector;
    const double cosine = std::cos(radians);
    const double sine = std::sin(radians);
    return {vector.x() * cosine - vector.y() * sine, vector.x() * sine + vector.y() * cosine};
}
}  // namespace

void ViewTransform::setImageSize(QSize image) {
    if (image == image_) return;
    image_ = image;
    fit();
}

void ViewTransform::setView(QSizeF view, double device_pixel_ratio) {
    const QPointF old_centre = imageFromView(middle());
    const double old_zoom = zoom();
    view_ = QSizeF(std::max(1.0, view.width()), std::max(1.0, view.height()));
    device_pixel_ratio_ = device_pixel_ratio > 0 ? device_pixel_ratio : 1;
    if (fitted_) {
        fit();
        return;
    }
    scale_ = old_zoom / device_pixel_ratio_;
    centreOn(old_centre);
}

QPointF ViewTransform::viewFromImage(QPointF image_point) const {
    return middle() + turned(unturnedFromImage(image_point) - middle(), rotation_);
}

QPointF ViewTransform::imageFromView(QPointF view_point) const {
    const QPointF unturned = middle() + turned(view_point - middle(), -rotation_);
    return (unturned - origin_) / scale_ - QPointF(0.5, 0.5);
}

QPointF ViewTransform::unturnedFromImage(QPointF image_point) const {
    return origin_ + (image_point + QPointF(0.5, 0.5)) * scale_;
}

QPointF ViewTransform::viewVector(QPointF image_vector) const {
    return turned(image_vector, rotation_) * scale_;
}

QPointF ViewTransform::imageVector(QPointF view_vector) const {
    return turned(view_vector, -rotation_) / scale_;
}

QTransform ViewTransform::turn() const {
    if (rotation_ == 0) return {};
    return QTransform()
        .translate(middle().x(), middle().y())
        .rotateRadians(rotation_)
        .translate(-middle().x(), -middle().y());
}

void ViewTransform::setRotation(double radians) {
    rotation_ = radians;
}

QRectF ViewTransform::imageRect() const {
    return {origin_, QSizeF(image_.width() * scale_, image_.height() * scale_)};
}

QRectF ViewTransform::visibleImage() const {
    const QRectF whole(-0.5, -0.5, image_.width(), image_.height());
    const double right = view_.width();
    const double bottom = view_.height();
    const QPolygonF seen{
        {imageFromView({0, 0}), imageFromView({right, 0}), imageFromView({right, bottom}), imageFromView({0, bottom})}};
    return seen.boundingRect().intersected(whole);
}

double ViewTransform::fitScale() const {
    if (image_.isEmpty()) return 1;
    return std::min(view_.width() / image_.width(), view_.height() / image_.height());
}

void ViewTransform::fit() {
    fitted_ = true;
    scale_ = std::min(fitScale(), kMaxZoom / device_pixel_ratio_);
    origin_ = QPointF((view_.width() - image_.width() * scale_) / 2, (view_.height() - image_.height() * scale_) / 2);
}

void ViewTransform::zoomAround(QPointF view_point, double factor) {
    setZoomAround(view_point, zoom() * factor);
}

void ViewTransform::setZoomAround(QPointF view_point, double zoom) {
    const double smallest = std::min(1.0, fitScale() * device_pixel_ratio_) / 4;
    const double new_scale = std::clamp(zoom, smallest, kMaxZoom) / device_pixel_ratio_;
    const QPointF fixed = middle() + turned(view_point - middle(), -rotation_);
    origin_ = fixed + (origin_ - fixed) * (new_scale / scale_);
    scale_ = new_scale;
    fitted_ = false;
}

void ViewTransform::panBy(QPointF view_delta) {
    origin_ += turned(view_delta, -rotation_);
    fitted_ = false;
    keepReachable();
}

void ViewTransform::centreOn(QPointF image_point) {
    fitted_ = false;
    origin_ += middle() - unturnedFromImage(image_point);
    keepReachable();
}

void ViewTransform::keepReachable() {
    const QRectF image = imageRect();
    const double keep_x = kReachableShare * std::min(image.width(), view_.width());
    const double keep_y = kReachableShare * std::min(image.height(), view_.height());
    origin_.setX(std::clamp(origin_.x(), keep_x - image.width(), view_.width() - keep_x));
    origin_.setY(std::clamp(origin_.y(), keep_y - image.height(), view_.height() - keep_y));
}

}  // namespace eyrie::ui
