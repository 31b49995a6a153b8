#include "widgets/tables/table_sort_proxy.h"

#include <algorithm>

#include "widgets/tables/table_roles.h"

namespace eyrie::ui {

TableSortProxy::TableSortProxy(QObject* parent) : QSortFilterProxyModel(parent) {
    setSortRole(sort_role);
    setSortLocaleAware(true);
    setSortCaseSensitivity(Qt::CaseInsensitive);
}

void TableSortProxy::setFilterText(const QString& text) {
    words_ = text.simplified().split(QLatin1Char(' '), Qt::SkipEmptyParts);
    invalidateFilter();
}

void TableSortProxy::setRowFilter(RowFilter filter) {
    row_filter_ = std::move(filter);
    invalidateFilter();
}

bool TableSortProxy::filterAcceptsRow(int source_row, const QModelIndex& source_parent) const {
    if (row_filter_ && !row_filter_(source_row)) return false;
    const auto is_in_row = [&](const QString& word) {
        for (int column = 0; column < sourceModel()->columnCount(source_parent); ++column) {
            const QString text = sourceModel()->index(source_row, column, source_parent).data().toString();
            if (text.contains(word, Qt::CaseInsensitive)) return true;
        }
        return false;
    };
    return std::all_of(words_.begin(), words_.end(), is_in_row);
}

}  // namespace eyrie::ui
