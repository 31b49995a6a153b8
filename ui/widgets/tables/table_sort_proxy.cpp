#include "widgets/tables/table_sort_proxy.h"

#include <QLocale>
#include <QScopedValueRollback>
#include <QVariant>
#include <algorithm>
#include <optional>

#include "widgets/tables/table_roles.h"

namespace eyrie::ui {

namespace {

/// The whole number that a word is; nothing: it is none.
std::optional<double> wholeNumberOf(const QString& word) {
    constexpr qsizetype kMostDigits = 15;
    const bool digits = std::all_of(word.begin(), word.end(), [](QChar c) { return c >= u'0' && c <= u'9'; });
    return digits && word.size() <= kMostDigits ? std::optional(word.toDouble()) : std::nullopt;
}

/// Whether a cell says this number, alone or among words and units: "5", "5.0", "★ 5", "3, 5", but not "15"; nothing
/// where it says none, such as a time does: "0:12".
std::optional<bool> saysNumber(const QString& cell, double number) {
    const QLocale locale;
    bool any = false;
    for (QString part : cell.split(QLatin1Char(' '), Qt::SkipEmptyParts)) {
        while (!part.isEmpty() && !part.back().isDigit()) part.chop(1);
        bool is_number = false;
        const double value = locale.toDouble(part, &is_number);
        if (is_number && value == number) return true;
        any = any || is_number;
    }
    return any ? std::optional(false) : std::nullopt;
}

bool isNumber(const QVariant& value) {
    switch (value.typeId()) {
        case QMetaType::Int:
        case QMetaType::UInt:
        case QMetaType::Long:
        case QMetaType::ULong:
        case QMetaType::LongLong:
        case QMetaType::ULongLong:
        case QMetaType::Float:
        case QMetaType::Double:
            return true;
        default:
            return false;
    }
}

}  // namespace

TableSortProxy::TableSortProxy(QObject* parent) : QSortFilterProxyModel(parent) {
    setSortRole(sort_role);
    setSortLocaleAware(true);
    setSortCaseSensitivity(Qt::CaseInsensitive);
}

void TableSortProxy::setFilterText(const QString& text) {
    words_ = text.simplified().split(QLatin1Char(' '), Qt::SkipEmptyParts);
    applyFilter();
}

void TableSortProxy::setRowFilter(RowFilter filter) {
    row_filter_ = std::move(filter);
    applyFilter();
}

void TableSortProxy::applyFilter() {
    {
        const QScopedValueRollback<bool> at_work(filtering_, true);
        invalidateFilter();
    }
    emit filtered();
}

bool TableSortProxy::filterAcceptsRow(int source_row, const QModelIndex& source_parent) const {
    if (row_filter_ && !row_filter_(source_row)) return false;
    const auto is_in_row = [&](const QString& word) {
        const std::optional<double> number = wholeNumberOf(word);
        for (int column = 0; column < sourceModel()->columnCount(source_parent); ++column) {
            const QModelIndex cell = sourceModel()->index(source_row, column, source_parent);
            const QString text = cell.data().toString();
            const auto said = number && isNumber(cell.data(sort_role)) ? saysNumber(text, *number) : std::nullopt;
            if (said.value_or(text.contains(word, Qt::CaseInsensitive))) return true;
        }
        return false;
    };
    return std::all_of(words_.begin(), words_.end(), is_in_row);
}

}  // namespace eyrie::ui

#include "moc_table_sort_proxy.cpp"
