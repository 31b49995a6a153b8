#pragma once

#include <QList>
#include <QString>

class QAbstractItemModel;

namespace eyrie::ui {

/// Rows of a table as text for spreadsheets: tabs between `columns`, a line per row, the headers first.
QString tableText(const QAbstractItemModel& model, const QList<int>& rows, const QList<int>& columns);

}  // namespace eyrie::ui
