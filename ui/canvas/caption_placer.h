#pragma once

#include <QRectF>
#include <QSizeF>
#include <optional>
#include <vector>

namespace eyrie::ui {

/// Finds room for labels beside their objects. Arithmetic only, logical px.
/// Labels never overlap one another nor an object; one that finds no room is left out, so crowded places thin out.
class CaptionPlacer {
 public:
    /// `view`: where labels may stand. `objects`: upright rectangles around all objects, which labels keep clear of.
    CaptionPlacer(const QRectF& view, std::vector<QRectF> objects);

    /// Places a label of this size beside `object`: above, below, right, then left of it. Call in order of importance.
    std::optional<QRectF> place(const QRectF& object, QSizeF label);

 private:
    bool isFree(const QRectF& rectangle, const QRectF& own) const;

    QRectF view_;
    std::vector<QRectF> objects_;
    std::vector<QRectF> placed_;
};

}  // namespace eyrie::ui
