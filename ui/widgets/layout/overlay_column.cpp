#include "widgets/layout/overlay_column.h"

#include <QEvent>
#include <QVBoxLayout>

namespace eyrie::ui {

OverlayColumn::OverlayColumn(QWidget* parent) : QWidget(parent), rows_(new QVBoxLayout(this)) {
    rows_->setContentsMargins(0, 0, 0, 0);
    rows_->setSpacing(2);
    hide();
}

void OverlayColumn::add(QWidget& widget) {
    rows_->insertWidget(0, &widget);
    widget.installEventFilter(this);
    follow();
}

bool OverlayColumn::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::ShowToParent || event->type() == QEvent::HideToParent) follow();
    return QWidget::eventFilter(watched, event);
}

void OverlayColumn::follow() {
    bool any = false;
    for (int i = 0; i < rows_->count(); ++i) any = any || !rows_->itemAt(i)->widget()->isHidden();
    setVisible(any);
}

}  // namespace eyrie::ui

#include "moc_overlay_column.cpp"
