#pragma once

#include <QSortFilterProxyModel>
#include <QStringList>
#include <functional>

namespace eyrie::ui {

/// Sorts a table by `sort_role`, numbers as numbers, and shows only rows that hold every word of a search text in any
/// of their columns. A whole number is searched for as one where a column sorts by numbers: 5 does not find 15 there.
class TableSortProxy : public QSortFilterProxyModel {
    Q_OBJECT
 public:
    /// Decides by the source row.
    using RowFilter = std::function<bool(int source_row)>;

    explicit TableSortProxy(QObject* parent = nullptr);
    void setFilterText(const QString& text);
    /// A further condition; empty: none.
    void setRowFilter(RowFilter filter);

 protected:
    bool filterAcceptsRow(int source_row, const QModelIndex& source_parent) const override;

 private:
    QStringList words_;
    RowFilter row_filter_;
};

}  // namespace eyrie::ui
