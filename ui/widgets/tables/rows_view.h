#pragma once

#include <QTableView>
#include <optional>

namespace eyrie::ui {

/// A table in which rows are chosen, not cells: it moves sideways only for who goes to another column by keys. A click
/// on a wide cell, or a program that selects a row, leaves the columns where they are.
class RowsView : public QTableView {
    Q_OBJECT

 public:
    using QTableView::QTableView;
    void scrollTo(const QModelIndex& index, ScrollHint hint = EnsureVisible) override;

 protected:
    void keyPressEvent(QKeyEvent* event) override;

 private:
    std::optional<int> column_before_key_;  ///< while a key is taken
};

}  // namespace eyrie::ui
