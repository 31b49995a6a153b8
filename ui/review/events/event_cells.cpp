#include "review/events/event_cells.h"

#include <QPainter>
#include <algorithm>

namespace eyrie::ui {

namespace {

constexpr int kNarrowestNote_px = 240;

/// The pictures on the ground of rows that are not selected, for which their colours were chosen.
QPixmap onGround(const QPixmap& picture, const QColor& ground) {
    QPixmap whole(picture.size());
    whole.setDevicePixelRatio(picture.devicePixelRatio());
    whole.fill(Qt::transparent);
    QPainter painter(&whole);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(ground);
    painter.drawRoundedRect(QRectF(QPointF(0, 0), whole.deviceIndependentSize()), 3, 3);
    painter.drawPixmap(QPointF(0, 0), picture);
    return whole;
}

}  // namespace

void EventCells::updateEditorGeometry(QWidget* editor, const QStyleOptionViewItem& option,
                                      const QModelIndex& /*index*/) const {
    const QRect seen = editor->parentWidget()->rect();
    QRect line = option.rect;
    line.setRight(std::min(line.right(), seen.right()));
    line.setLeft(std::max(line.left(), seen.left()));
    if (line.width() < kNarrowestNote_px) {
        line.setRight(std::min(seen.right(), std::max(line.right(), kNarrowestNote_px - 1)));
        line.setLeft(std::max(seen.left(), line.right() - kNarrowestNote_px + 1));
    }
    editor->setGeometry(line);
}

void EventCells::initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const {
    QStyledItemDelegate::initStyleOption(option, index);
    const auto picture = index.data(Qt::DecorationRole).value<QPixmap>();
    if (!option->state.testFlag(QStyle::State_Selected) || picture.isNull()) return;
    // Styles tint what is selected with the very colour that it lies on.
    const QPixmap readable = onGround(picture, option->palette.color(QPalette::Base));
    option->icon = QIcon();
    option->icon.addPixmap(readable, QIcon::Selected);
    option->decorationSize = readable.deviceIndependentSize().toSize();
}

}  // namespace eyrie::ui

#include "moc_event_cells.cpp"
