#pragma once

#include <QPointF>
#include <QRectF>
#include <QSize>
#include <QSizeF>
#include <QTransform>
#include <optional>

namespace eyrie::ui {

/// The map between an image and the widget that shows it. Arithmetic only: no widget, no screen.
/// Image coordinates: px, pixel centres at integers, so the image covers [−0.5, size − 0.5]. View coordinates: the
/// widget's logical pixels, origin at its top left. The picture may be turned around the middle of the view, and be
/// laid on the ground: then zoom and place are those of the ground, whose unit is a pixel of some other frame.
class ViewTransform {
 public:
    static constexpr double kMaxZoom = 64;  ///< screen pixels per image pixel
    /// From this zoom on, pixels are drawn as sharp squares.
    static constexpr double kSharpZoom = 4;

    /// Adopts a new image size; fits it when the size changed.
    void setImageSize(QSize image);
    /// Adopts a new widget size (logical px) and screen density. Keeps the image fitted if it was, else the view's
    /// centre.
    void setView(QSizeF view, double device_pixel_ratio);

    QSize imageSize() const { return image_; }
    QSizeF viewSize() const { return view_; }
    /// Logical view px per image px.
    double scale() const { return scale_; }
    /// Screen (device) pixels per image pixel: 1 is "100 %".
    double zoom() const { return scale_ * device_pixel_ratio_; }
    double devicePixelRatio() const { return device_pixel_ratio_; }
    bool fitted() const { return fitted_; }
    bool sharp() const { return zoom() >= kSharpZoom - 1e-9; }

    QPointF viewFromImage(QPointF image_point) const;
    QPointF imageFromView(QPointF view_point) const;
    /// A distance at a place of the image as it lies in the view, and back.
    QPointF viewVector(QPointF image_vector, QPointF at) const;
    QPointF imageVector(QPointF view_vector, QPointF at) const;
    /// Logical view px per image px at a place: scale(), unless the picture lies on the ground.
    double scaleAt(QPointF image_point) const;
    /// The direction of +x at a place of the image as it lies in the view, radians clockwise.
    double turnAt(QPointF image_point) const;
    /// Turns what is drawn where unturnedFromImage() says to where it belongs. Identity unless the picture is turned.
    QTransform turn() const;
    /// Where an image point lies before the turn.
    QPointF unturnedFromImage(QPointF image_point) const;
    /// The whole image in view coordinates, before the turn; on the ground, the upright rectangle around it.
    QRectF imageRect() const;
    /// What a painter needs to draw the image, px and pixel centres at integers, where it belongs.
    QTransform drawing() const;
    /// The part of the image (image coordinates) that can be seen: where the picture is turned, the upright rectangle
    /// around it.
    QRectF visibleImage() const;

    /// The whole image, as large as fits; stays fitted when the widget is resized.
    void fit();
    /// Multiplies the zoom; the image point under `view_point` stays there.
    void zoomAround(QPointF view_point, double factor);
    /// Sets the zoom (screen px per image px); the image point under `view_point` stays there.
    void setZoomAround(QPointF view_point, double zoom);
    /// Moves the image by a distance in view px; a part of it always stays in view.
    void panBy(QPointF view_delta);
    /// Brings an image point to the middle of the view.
    void centreOn(QPointF image_point);
    /// Turns the picture clockwise by this angle (radians), around the middle of the view; 0 is upright.
    void setRotation(double radians);
    double rotation() const { return rotation_; }
    /// Lays the image on the ground: a map from image coordinates that has the whole image before the camera. Zoom and
    /// place of the ground stay. Nothing: as filmed.
    void setGround(const std::optional<QTransform>& ground_from_image);
    bool onGround() const { return on_ground_; }
    /// Moves the ground by as little as brings the picture well into the view; answers whether it had to.
    bool keepInView();

 private:
    QPointF middle() const { return {view_.width() / 2, view_.height() / 2}; }
    QPointF groundFromImage(QPointF image_point) const;
    QRectF groundRect() const;
    double fitScale() const;
    void keepReachable();

    QSize image_;
    QSizeF view_{1, 1};
    double device_pixel_ratio_ = 1;
    double scale_ = 1;
    double rotation_ = 0;
    QPointF origin_{0, 0};  ///< view position of the image's top left edge (image −0.5, −0.5), or that of the ground
    bool fitted_ = true;
    bool on_ground_ = false;
    QTransform ground_from_image_;
    QTransform image_from_ground_;
};

}  // namespace eyrie::ui
