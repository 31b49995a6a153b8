#include "canvas/drawing/caption_placer.h"

#include <algorithm>
#include <array>
#include <utility>

namespace eyrie::ui {

namespace {
constexpr double kLabelGap = 3;
}  // namespace

CaptionPlacer::CaptionPlacer(const QRectF& view, std::vector<QRectF> objects)
    : view_(view), objects_(std::move(objects)) {}

void CaptionPlacer::keepClearOf(std::vector<QRectF> objects) {
    objects_ = std::move(objects);
}

std::optional<QRectF> CaptionPlacer::place(const QRectF& object, QSizeF label) {
    const double centred_x = object.center().x() - label.width() / 2;
    const double centred_y = object.center().y() - label.height() / 2;
    const std::array<QPointF, 4> places{
        QPointF(centred_x, object.top() - kLabelGap - label.height()), QPointF(centred_x, object.bottom() + kLabelGap),
        QPointF(object.right() + kLabelGap, centred_y), QPointF(object.left() - kLabelGap - label.width(), centred_y)};
    for (const QPointF& top_left : places) {
        const QRectF rectangle(top_left, label);
        if (!isFree(rectangle, object)) continue;
        placed_.push_back(rectangle);
        return rectangle;
    }
    return std::nullopt;
}

bool CaptionPlacer::isFree(const QRectF& rectangle, const QRectF& own) const {
    if (!view_.contains(rectangle)) return false;
    const auto hits = [&](const QRectF& other) { return rectangle.intersects(other); };
    if (std::any_of(placed_.begin(), placed_.end(), hits)) return false;
    return std::none_of(objects_.begin(), objects_.end(),
                        [&](const QRectF& other) { return other != own && rectangle.intersects(other); });
}

}  // namespace eyrie::ui
