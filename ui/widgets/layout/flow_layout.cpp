#include "widgets/layout/flow_layout.h"

#include <algorithm>

namespace eyrie::ui {

FlowLayout::FlowLayout(QWidget* parent, int spacing) : QLayout(parent) {
    setSpacing(spacing);
    setContentsMargins(0, 0, 0, 0);
}

FlowLayout::~FlowLayout() {
    qDeleteAll(items_);
}

QLayoutItem* FlowLayout::takeAt(int index) {
    return index >= 0 && index < items_.size() ? items_.takeAt(index) : nullptr;
}

QSize FlowLayout::minimumSize() const {
    QSize size;
    for (const QLayoutItem* item : items_) size = size.expandedTo(item->minimumSize());
    const QMargins margins = contentsMargins();
    return size + QSize(margins.left() + margins.right(), margins.top() + margins.bottom());
}

void FlowLayout::setGeometry(const QRect& rectangle) {
    QLayout::setGeometry(rectangle);
    arrange(rectangle, true);
}

int FlowLayout::arrange(const QRect& rectangle, bool place) const {
    const QRect room = rectangle.marginsRemoved(contentsMargins());
    int x = room.left();
    int y = room.top();
    int row_height = 0;
    for (QLayoutItem* item : items_) {
        if (item->isEmpty()) continue;
        const QSize wish(std::min(item->sizeHint().width(), room.width()), item->sizeHint().height());
        if (x > room.left() && x + wish.width() > room.left() + room.width()) {
            x = room.left();
            y += row_height + spacing();
            row_height = 0;
        }
        if (place) item->setGeometry(QRect(QPoint(x, y), wish));
        x += wish.width() + spacing();
        row_height = std::max(row_height, wish.height());
    }
    return y + row_height - rectangle.top() + contentsMargins().bottom();
}

}  // namespace eyrie::ui
