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

/// What a map does to a small way at a place.
QPointF alongMap(const QTransform& map, QPointF vector, QPointF at) {
    const double w = map.m13() * at.x() + map.m23() * at.y() + map.m33();
    const QPointF point = map.map(at);
    const double dw = map.m13() * vector.x() + map.m23() * vector.y();
    return {(map.m11() * vector.x() + map.m21() * vector.y() - point.x() * dw) / w,
            (map.m12() * vector.x() + map.m22() * vector.y() - point.y() * dw) / w};
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
    const QPointF point = (unturned - origin_) / scale_ - QPointF(0.5, 0.5);
    return on_ground_ ? image_from_ground_.map(point) : point;
}

QPointF ViewTransform::groundFromImage(QPointF image_point) const {
    return on_ground_ ? ground_from_image_.map(image_point) : image_point;
}

QPointF ViewTransform::unturnedFromImage(QPointF image_point) const {
    return origin_ + (groundFromImage(image_point) + QPointF(0.5, 0.5)) * scale_;
}

QPointF ViewTransform::viewVector(QPointF image_vector, QPointF at) const {
    return turned(on_ground_ ? alongMap(ground_from_image_, image_vector, at) : image_vector, rotation_) * scale_;
}

QPointF ViewTransform::imageVector(QPointF view_vector, QPointF at) const {
    const QPointF vector = turned(view_vector, -rotation_) / scale_;
    return on_ground_ ? alongMap(image_from_ground_, vector, ground_from_image_.map(at)) : vector;
}

double ViewTransform::scaleAt(QPointF image_point) const {
    if (!on_ground_) return scale_;
    const QPointF right = viewVector({1, 0}, image_point);
    const QPointF down = viewVector({0, 1}, image_point);
    return std::sqrt(std::abs(right.x() * down.y() - right.y() * down.x()));
}

double ViewTransform::turnAt(QPointF image_point) const {
    const QPointF right = viewVector({1, 0}, image_point);
    return std::atan2(right.y(), right.x());
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

void ViewTransform::setGround(const std::optional<QTransform>& ground_from_image) {
    bool invertible = true;
    const QTransform back = ground_from_image ? ground_from_image->inverted(&invertible) : QTransform();
    on_ground_ = ground_from_image.has_value() && invertible;
    ground_from_image_ = on_ground_ ? *ground_from_image : QTransform();
    image_from_ground_ = on_ground_ ? back : QTransform();
}

QRectF ViewTransform::groundRect() const {
    const QRectF image(-0.5, -0.5, image_.width(), image_.height());
    return on_ground_ ? ground_from_image_.map(QPolygonF(image)).boundingRect() : image;
}

QRectF ViewTransform::imageRect() const {
    const QRectF ground = groundRect();
    return {origin_ + (ground.topLeft() + QPointF(0.5, 0.5)) * scale_, ground.size() * scale_};
}

QTransform ViewTransform::drawing() const {
    const QTransform placed =
        QTransform().translate(origin_.x(), origin_.y()).scale(scale_, scale_).translate(0.5, 0.5);
    return ground_from_image_ * placed * turn();
}

bool ViewTransform::keepInView() {
    // How far the middle of the picture may be from that of the view: little where the whole picture is seen, farther
    // where a part of it is looked at, which may stand still until it is nearly gone.
    constexpr double kLoose = 0.25;
    const QRectF picture = imageRect();
    const auto away = [](double from_middle, double picture_half, double view_half) {
        const double allowed = std::max(0.0, picture_half - view_half) + kLoose * std::min(picture_half, view_half);
        return from_middle - std::clamp(from_middle, -allowed, allowed);
    };
    const QPointF from_middle = picture.center() - middle();
    const QPointF too_far(away(from_middle.x(), picture.width() / 2, view_.width() / 2),
                          away(from_middle.y(), picture.height() / 2, view_.height() / 2));
    if (too_far.isNull()) return false;
    origin_ -= too_far;
    return true;
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
    const QSizeF size = groundRect().size();
    return std::min(view_.width() / size.width(), view_.height() / size.height());
}

void ViewTransform::fit() {
    fitted_ = true;
    scale_ = std::min(fitScale(), kMaxZoom / device_pixel_ratio_);
    const QRectF ground = groundRect();
    origin_ = middle() - (ground.center() + QPointF(0.5, 0.5)) * scale_;
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
    const QPointF kept(std::clamp(image.left(), keep_x - image.width(), view_.width() - keep_x),
                       std::clamp(image.top(), keep_y - image.height(), view_.height() - keep_y));
    origin_ += kept - image.topLeft();
}

}  // namespace eyrie::ui
