#pragma once

#include <QStringList>

class QTableView;
class QTableWidget;

namespace eyrie::ui {

/// How every list looks: rows that are selected whole, all of one height, without grid and numbers.
void lookAsList(QTableView& table);

/// A table with these columns that is only read, a row at a time.
QTableWidget* tableToRead(const QStringList& columns);

}  // namespace eyrie::ui
