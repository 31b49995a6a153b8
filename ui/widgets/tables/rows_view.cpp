#include "widgets/tables/rows_view.h"

#include <QScopedValueRollback>
#include <QScrollBar>

namespace eyrie::ui {

void RowsView::scrollTo(const QModelIndex& index, ScrollHint hint) {
    const int place = horizontalScrollBar()->value();
    QTableView::scrollTo(index, hint);
    if (column_before_key_.value_or(index.column()) == index.column()) horizontalScrollBar()->setValue(place);
}

void RowsView::keyPressEvent(QKeyEvent* event) {
    const QScopedValueRollback<std::optional<int>> taken(column_before_key_, currentIndex().column());
    QTableView::keyPressEvent(event);
}

}  // namespace eyrie::ui

#include "moc_rows_view.cpp"
