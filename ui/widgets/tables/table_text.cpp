#include "widgets/tables/table_text.h"

#include <QAbstractItemModel>

namespace eyrie::ui {
namespace {

/// Tabs and line ends inside a text would move all that follows.
QString cell(const QVariant& value) {
    return value.toString().simplified();
}

}  // namespace

QString tableText(const QAbstractItemModel& model, const QList<int>& rows, const QList<int>& columns) {
    QStringList lines;
    QStringList cells;
    for (const int column : columns) cells << cell(model.headerData(column, Qt::Horizontal));
    lines << cells.join(QLatin1Char('\t'));
    for (const int row : rows) {
        cells.clear();
        for (const int column : columns) cells << cell(model.index(row, column).data());
        lines << cells.join(QLatin1Char('\t'));
    }
    return lines.join(QLatin1Char('\n')) + QLatin1Char('\n');
}

}  // namespace eyrie::ui
