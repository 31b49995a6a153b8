#pragma once

#include <QColor>
#include <QImage>
#include <QString>
#include <optional>

#include "core/geometry/oriented_box.h"
#include "core/values/ids.h"

class QPainter;

namespace eyrie::ui {

/// What an object looks like over many frames, as it lies in the frame shown.
struct LoupeStack {
    int object = 0;
    FrameIndex frame = 0;
    OrientedBox area;  ///< px of the frame; its heading points to the right in `image`
    QImage image;
    int layers = 0;
    QString missing;  ///< where there is no image: why not
};

/// The part of the picture under a loupe and where the loupe stands.
struct Loupe {
    QPointF image_point;
    QPointF view_point;        ///< what it stands beside
    QRectF view;               ///< what it must stay in
    double magnification = 8;  ///< logical px per image px
    std::optional<OrientedBox> box;
    QColor colour;
    double rotation = 0;  ///< of the picture, radians clockwise
};

inline constexpr double kLoupeSide = 168;  ///< logical px

/// The picture around an image point, magnified: raw pixels as squares, and a box over them. With a stack a second
/// loupe beside it shows the same place there.
void paintLoupe(QPainter& painter, const QImage& image, const Loupe& loupe, const LoupeStack* stack = nullptr);

}  // namespace eyrie::ui
