#include "widgets/tables/table_look.h"

#include <QHeaderView>
#include <QTableWidget>

namespace eyrie::ui {

namespace {
constexpr int kRowMargins_px = 6;  ///< above and below the text together
}  // namespace

void lookAsList(QTableView& table) {
    table.setSelectionBehavior(QAbstractItemView::SelectRows);
    table.setSelectionMode(QAbstractItemView::ExtendedSelection);
    table.setShowGrid(false);
    table.setWordWrap(false);
    table.setTabKeyNavigation(false);
    table.verticalHeader()->hide();
    // Rows of one height keep tables of thousands of tracks quick.
    table.verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    table.verticalHeader()->setDefaultSectionSize(table.fontMetrics().height() + kRowMargins_px);
    table.horizontalHeader()->setHighlightSections(false);
}

QTableWidget* tableToRead(const QStringList& columns) {
    auto* made = new QTableWidget(0, static_cast<int>(columns.size()));
    made->setHorizontalHeaderLabels(columns);
    made->verticalHeader()->hide();
    made->setSelectionBehavior(QAbstractItemView::SelectRows);
    made->setSelectionMode(QAbstractItemView::SingleSelection);
    made->setEditTriggers(QAbstractItemView::NoEditTriggers);
    made->setAlternatingRowColors(true);
    made->setShowGrid(false);
    made->setWordWrap(false);
    made->horizontalHeader()->setStretchLastSection(true);
    made->horizontalHeader()->setHighlightSections(false);
    made->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    return made;
}

}  // namespace eyrie::ui
