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
    /// Whether rows come and go because another filter is being applied: in as many steps as there are gaps between
    /// them. What looks through the rows waits for filtered().
    bool filtering() const { return filtering_; }

 signals:
    /// Another filter holds, and all rows are as it leaves them.
    void filtered();

 protected:
    bool filterAcceptsRow(int source_row, const QModelIndex& source_parent) const override;

 private:
    void applyFilter();

    QStringList words_;
    RowFilter row_filter_;
    bool filtering_ = false;
};

}  // namespace eyrie::ui
