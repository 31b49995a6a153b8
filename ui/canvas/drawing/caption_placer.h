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
    /// `view`: where labels may stand. `objects`: as keepClearOf().
    explicit CaptionPlacer(const QRectF& view, std::vector<QRectF> objects = {});

    /// Upright rectangles around all objects, in place of those before: the labels to come keep clear of them. Labels
    /// that were placed stay where they are.
    void keepClearOf(std::vector<QRectF> objects);

    /// Places a label of this size beside `object`: above, below, right, then left of it. Call in order of importance.
    std::optional<QRectF> place(const QRectF& object, QSizeF label);

 private:
    bool isFree(const QRectF& rectangle, const QRectF& own) const;

    QRectF view_;
    std::vector<QRectF> objects_;
    std::vector<QRectF> placed_;
};

}  // namespace eyrie::ui
