#include "widgets/tables/table_panel.h"

#include <QApplication>
#include <QClipboard>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMenu>
#include <QScopedValueRollback>
#include <QScrollBar>
#include <QSettings>
#include <QStackedLayout>
#include <QTableView>
#include <QTextDocument>
#include <QToolTip>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/empty_state.h"
#include "widgets/tables/rows_view.h"
#include "widgets/tables/table_look.h"
#include "widgets/tables/table_roles.h"
#include "widgets/tables/table_text.h"
#include "widgets/wiring.h"

namespace eyrie::ui {
namespace {

constexpr QLatin1String kFittedKey("_fitted");
constexpr QLatin1String kKnownKey("_known");
constexpr int kLeastTable_px = 48;  ///< the header and a row; what columns of docks need in a small window
constexpr int kWidening_ms = 1000;

}  // namespace

TablePanel::TablePanel(QAbstractItemModel* model, const QString& settings_key, QWidget* parent,
                       std::optional<int> sort_column)
    : QWidget(parent),
      model_(model),
      settings_key_(QStringLiteral("columns/") + settings_key),
      proxy_(new TableSortProxy(this)),
      filter_(new QLineEdit(this)),
      tool_row_(new QHBoxLayout),
      table_(new RowsView(this)),
      empty_(new EmptyState(this)),
      nothing_found_(new EmptyState(this)),
      stack_(new QStackedLayout),
      widening_due_(kWidening_ms, [this] { widenColumns(); }) {
    proxy_->setSourceModel(model_);
    filter_->setPlaceholderText(tr("Filter"));
    filter_->setClearButtonEnabled(true);
    filter_->setAccessibleName(tr("Show only rows with these words"));
    filter_->installEventFilter(this);
    onEdited(
        this, [this] { setFilterText(filter_->text()); }, filter_);
    bindCommands(this, {{nothing_found_->button(), [this] {
                             filter_->clear();
                             showHidden();
                         }}});

    table_->setMinimumHeight(kLeastTable_px);
    tool_row_->addWidget(filter_, 1);
    stack_->addWidget(table_);
    stack_->addWidget(empty_);
    stack_->addWidget(nothing_found_);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    layout->addLayout(tool_row_);
    layout->addLayout(stack_, 1);

    buildTable(sort_column);
    whenAny(proxy_, this, &TablePanel::keepSelection, &QAbstractItemModel::rowsInserted,
            &QAbstractItemModel::rowsRemoved, &QAbstractItemModel::modelReset);
    connect(proxy_, &TableSortProxy::filtered, this, [this] {
        if (selection_due_) keepSelection();
    });
    // The proxy lets go of rows before the model does.
    connect(model_, &QAbstractItemModel::rowsRemoved, this, &TablePanel::showTableOrEmptyState);
    connect(proxy_, &QAbstractItemModel::layoutChanged, this, &TablePanel::showTableOrEmptyState);
    showTableOrEmptyState();
}

TablePanel::~TablePanel() {
    saveColumns();
}

void TablePanel::buildTable(std::optional<int> sort_column) {
    // When rows go, the view moves the current row on; that must not count as the user's choice. Connected before the
    // view connects itself.
    const auto pause = [this] { telling_ = false; };
    const auto resume = [this] { telling_ = true; };
    whenAny(proxy_, this, pause, &QAbstractItemModel::rowsAboutToBeRemoved, &QAbstractItemModel::modelAboutToBeReset);
    whenAny(proxy_, this, resume, &QAbstractItemModel::rowsRemoved, &QAbstractItemModel::modelReset);
    table_->setModel(proxy_);
    all_columns_ = proxy_->columnCount();
    lookAsList(*table_);
    table_->setSortingEnabled(true);
    table_->sortByColumn(sort_column.value_or(-1), Qt::AscendingOrder);
    table_->horizontalHeader()->setSortIndicatorClearable(!sort_column);
    table_->setAlternatingRowColors(true);
    table_->setEditTriggers(QAbstractItemView::EditKeyPressed);
    table_->horizontalHeader()->setSectionsMovable(true);
    table_->horizontalHeader()->setStretchLastSection(true);
    table_->horizontalHeader()->setContextMenuPolicy(Qt::CustomContextMenu);
    table_->setContextMenuPolicy(Qt::CustomContextMenu);
    table_->installEventFilter(this);
    table_->viewport()->installEventFilter(this);
    // Widths follow the rows in view and these many more.
    table_->horizontalHeader()->setResizeContentsPrecision(100);
    restoreColumns();
    whenAny(proxy_, this, &TablePanel::widenColumnsSoon, &QAbstractItemModel::dataChanged,
            &QAbstractItemModel::headerDataChanged, &QAbstractItemModel::rowsInserted, &QAbstractItemModel::modelReset);
    connect(table_->verticalScrollBar(), &QScrollBar::valueChanged, this, &TablePanel::widenColumnsSoon);

    connect(table_->horizontalHeader(), &QHeaderView::sortIndicatorChanged, this, [this](int column) {
        // Widths that somebody chose stay.
        QHeaderView* header = table_->horizontalHeader();
        if (fitted_widths_.value(column, -1) != header->sectionSize(column)) return;
        fitted_widths_[column] = std::max(header->sectionSize(column), header->sectionSizeHint(column));
        header->resizeSection(column, fitted_widths_[column]);
    });
    connect(table_->horizontalHeader(), &QWidget::customContextMenuRequested, this, &TablePanel::showHeaderMenu);
    connect(table_, &QWidget::customContextMenuRequested, this, &TablePanel::showRowMenu);
    connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this, [this](const QModelIndex& now) {
        const int id = idOf(now);
        if (!telling_ || id == 0) return;
        kept_id_ = id;
        // The row is current, but not selected yet: who selects what was told would undo what Ctrl adds to.
        const QScopedValueRollback<int> telling(told_id_, id);
        rowSelected(id);
    });
    connect(table_, &QTableView::clicked, this,
            [this](const QModelIndex& at) { rowClicked(idOf(at), proxy_->mapToSource(at).column()); });
    connect(table_, &QTableView::doubleClicked, this, [this](const QModelIndex& at) { rowDoubleClicked(idOf(at)); });
}

int TablePanel::idOf(const QModelIndex& index) const {
    return index.isValid() ? index.data(id_role).toInt() : 0;
}

int TablePanel::currentId() const {
    const QModelIndexList rows = table_->selectionModel()->selectedRows();
    return rows.isEmpty()
               ? 0
               : idOf(table_->selectionModel()->isRowSelected(table_->currentIndex().row()) ? table_->currentIndex()
                                                                                            : rows.first());
}

QList<int> TablePanel::selectedIds() const {
    QList<int> rows;
    for (const QModelIndex& row : table_->selectionModel()->selectedRows()) rows << row.row();
    std::sort(rows.begin(), rows.end());
    QList<int> ids;
    for (const int row : rows) ids << idOf(proxy_->index(row, 0));
    return ids;
}

QString TablePanel::hiddenText() const {
    return tr("All entries are hidden.");
}

void TablePanel::selectId(int id) {
    const QScopedValueRollback<bool> quiet(telling_, false);
    kept_id_ = id;
    if (id != 0 && id == told_id_) return;
    const int row = shownRowOf(id);
    if (row < 0) {
        table_->selectionModel()->clear();
        return;
    }
    const QModelIndex found = proxy_->index(row, shownColumns().value(0));
    if (table_->currentIndex().row() != row || currentId() != id)
        table_->selectionModel()->setCurrentIndex(found,
                                                  QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    table_->scrollTo(found);
}

int TablePanel::shownRowOf(int id) const {
    if (id == 0) return -1;
    const auto id_in = [this](int row) { return model_->index(row, 0).data(id_role).toInt(); };
    const auto known = rows_.constFind(id);
    if (known == rows_.constEnd() || *known >= model_->rowCount() || id_in(*known) != id) {
        rows_.clear();
        for (int row = model_->rowCount() - 1; row >= 0; --row) rows_.insert(id_in(row), row);
        if (!rows_.contains(id)) return -1;
    }
    return proxy_->mapFromSource(model_->index(rows_.value(id), 0)).row();
}

void TablePanel::keepPlace(const std::function<void()>& change) {
    const QModelIndex top = table_->indexAt({0, 0});
    const int id = table_->verticalScrollBar()->value() > 0 && top.isValid() ? idOf(top) : 0;
    change();
    for (int row = 0; id != 0 && row < proxy_->rowCount(); ++row) {
        if (idOf(proxy_->index(row, 0)) != id) continue;
        table_->scrollTo(proxy_->index(row, top.column()), QAbstractItemView::PositionAtTop);
        return;
    }
}

int TablePanel::neededWidth(int column) const {
    // The arrow of the order needs room in the column that has it only.
    constexpr int kMargin = 14;
    constexpr int kArrow = 18;
    const QHeaderView* header = table_->horizontalHeader();
    const QAbstractItemView* view = table_;
    const QString title = proxy_->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
    const int arrow = header->sortIndicatorSection() == column ? kArrow : 0;
    const int own = header->fontMetrics().horizontalAdvance(title) + kMargin + arrow;
    int needed = view->sizeHintForColumn(column) + 1;
    if (const auto most = mostCharacters(column))
        needed = std::min(needed, *most * view->fontMetrics().averageCharWidth());
    // Headers allow none narrower: one that counts as fitted narrower than it is would count as somebody's choice.
    return std::max({own, needed, header->minimumSectionSize()});
}

void TablePanel::fitColumns() {
    fitted_widths_.clear();
    for (int column = 0; column < proxy_->columnCount(); ++column) {
        fitted_widths_ << neededWidth(column);
        table_->setColumnWidth(column, fitted_widths_.back());
    }
}

void TablePanel::widenColumns() {
    for (int column = 0; column < fitted_widths_.size(); ++column) {
        if (table_->columnWidth(column) != fitted_widths_[column]) continue;
        const int needed = neededWidth(column);
        if (needed <= fitted_widths_[column]) continue;
        fitted_widths_[column] = needed;
        table_->setColumnWidth(column, needed);
    }
}

void TablePanel::widenColumnsSoon() {
    if (!widening_due_.pending()) widening_due_.start();
}

void TablePanel::keepSelection() {
    // Looking for the row after every step would take seconds in a list of thousands.
    selection_due_ = proxy_->filtering();
    if (selection_due_) return;
    if (!columns_fit_ && proxy_->rowCount() > 0) {
        fitColumns();
        columns_fit_ = true;
    }
    showTableOrEmptyState();
    if (kept_id_ != 0 && currentId() != kept_id_) selectId(kept_id_);
}

void TablePanel::showTableOrEmptyState() {
    if (model_->rowCount() == 0) {
        stack_->setCurrentWidget(empty_);
    } else if (proxy_->rowCount() == 0) {
        nothing_found_->setTexts(
            filter_->text().isEmpty() ? hiddenText() : tr("No entry contains “%1”.").arg(filter_->text()),
            filter_->text().isEmpty() && !canShowHidden() ? QString() : tr("Show all"));
        stack_->setCurrentWidget(nothing_found_);
    } else {
        stack_->setCurrentWidget(table_);
    }
}

void TablePanel::setFilterText(const QString& text) {
    if (filter_->text() != text) {
        filter_->setText(text);  // comes back here
        return;
    }
    proxy_->setFilterText(text);
    keepSelection();
    // While one writes the list was where the selected row was; without it there, one begins at the first.
    if (currentId() == 0) table_->scrollToTop();
}

void TablePanel::goToRows() {
    if (proxy_->rowCount() == 0) return;
    if (currentId() == 0) {
        const int first = idOf(proxy_->index(0, 0));
        selectId(first);
        rowSelected(first);
    }
    table_->setFocus();
}

QList<int> TablePanel::shownColumns() const {
    QList<int> columns;
    const QHeaderView* header = table_->horizontalHeader();
    for (int place = 0; place < header->count(); ++place) {
        const int column = header->logicalIndex(place);
        if (!header->isSectionHidden(column)) columns << column;
    }
    return columns;
}

QString TablePanel::selectedText() const {
    QList<int> rows;
    for (const QModelIndex& row : table_->selectionModel()->selectedRows()) rows << row.row();
    std::sort(rows.begin(), rows.end());
    if (rows.isEmpty()) {
        for (int row = 0; row < proxy_->rowCount(); ++row) rows << row;
    }
    return tableText(*proxy_, rows, shownColumns());
}

bool TablePanel::showToolTip(const QPoint& place, const QPoint& global_place) {
    const QModelIndex index = table_->indexAt(place);
    const QAbstractItemView* view = table_;
    if (!index.isValid() || view->sizeHintForIndex(index).width() <= view->visualRect(index).width()) return false;
    const QString text = index.data(Qt::DisplayRole).toString();
    const QString about = index.data(Qt::ToolTipRole).toString();
    if (text.isEmpty()) return false;
    const bool rich = Qt::mightBeRichText(about);
    const QString whole = about.isEmpty() ? text
                          : rich          ? text.toHtmlEscaped() + QStringLiteral("<br>") + about
                                          : text + QLatin1Char('\n') + about;
    QToolTip::showText(global_place, whole, table_->viewport(), view->visualRect(index));
    return true;
}

bool TablePanel::eventFilter(QObject* watched, QEvent* event) {
    if (watched == table_->viewport() && event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        return showToolTip(help->pos(), help->globalPos());
    }
    if ((watched != table_ && watched != filter_) || event->type() != QEvent::KeyPress)
        return QWidget::eventFilter(watched, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool enter = key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter;
    if (watched == filter_) {
        if (enter || key->key() == Qt::Key_Down) goToRows();
        return enter || key->key() == Qt::Key_Down;
    }
    if (key->matches(QKeySequence::Copy)) {
        QApplication::clipboard()->setText(selectedText());
        return true;
    }
    // One that ends the writing of a cell comes here as well.
    const QWidget* writing = window()->focusWidget();
    if (enter && currentId() != 0 && !table_->viewport()->isAncestorOf(writing)) {
        rowDoubleClicked(currentId());
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

void TablePanel::showRowMenu(const QPoint& place) {
    QMenu menu;
    menu.addAction(tr("Copy as text"), QKeySequence::Copy, this,
                   [this] { QApplication::clipboard()->setText(selectedText()); });
    fillColumns(*menu.addMenu(tr("Columns")));
    fillOrders(*menu.addMenu(tr("Order by")));
    menu.addSeparator();
    if (currentId() != 0) fillMenu(menu, currentId());
    menu.exec(table_->viewport()->mapToGlobal(place));
}

void TablePanel::showHeaderMenu(const QPoint& place) {
    QMenu menu;
    fillColumns(menu);
    menu.exec(table_->horizontalHeader()->mapToGlobal(place));
}

void TablePanel::fillColumns(QMenu& menu) {
    QHeaderView* header = table_->horizontalHeader();
    const bool only_one = shownColumns().size() == 1;
    for (int column = 0; column < header->count(); ++column) {
        QAction* action = menu.addAction(proxy_->headerData(column, Qt::Horizontal).toString());
        action->setCheckable(true);
        action->setChecked(!header->isSectionHidden(column));
        action->setEnabled(header->isSectionHidden(column) || !only_one);
        bindSwitches(this, {{action, [header, column](bool shown) { header->setSectionHidden(column, !shown); }}});
    }
}

void TablePanel::fillOrders(QMenu& menu) {
    const QHeaderView* header = table_->horizontalHeader();
    const int now = header->sortIndicatorSection();
    const bool falls = header->sortIndicatorOrder() == Qt::DescendingOrder;
    for (const int column : shownColumns()) {
        const QString title = proxy_->headerData(column, Qt::Horizontal).toString();
        const QString arrow = column != now ? QString() : falls ? QStringLiteral("  ↓") : QStringLiteral("  ↑");
        const Qt::SortOrder next = column == now && !falls ? Qt::DescendingOrder : Qt::AscendingOrder;
        menu.addAction(title + arrow, this, [this, column, next] { table_->sortByColumn(column, next); });
    }
    if (!header->isSortIndicatorClearable()) return;
    menu.addSeparator();
    menu.addAction(tr("No order"), this, [this] { table_->sortByColumn(-1, Qt::AscendingOrder); })
        ->setEnabled(now >= 0);
}

void TablePanel::restoreColumns() {
    const QByteArray state = QSettings().value(settings_key_).toByteArray();
    columns_fit_ = !state.isEmpty() && table_->horizontalHeader()->restoreState(state);
    if (columns_fit_) {
        for (const QVariant& width : QSettings().value(settings_key_ + kFittedKey).toList())
            fitted_widths_ << std::max(width.toInt(), table_->horizontalHeader()->minimumSectionSize());
        // Before it was kept, a memory told of as many columns as it has widths.
        known_columns_ = QSettings().value(settings_key_ + kKnownKey, static_cast<int>(fitted_widths_.size())).toInt();
        // A list that never had a row has widths that fit nothing.
        columns_fit_ = !fitted_widths_.isEmpty();
    } else {
        table_->resizeColumnsToContents();
    }
    // A memory of an older version may know fewer columns, or hide all.
    table_->horizontalHeader()->setStretchLastSection(true);
    if (shownColumns().isEmpty()) table_->showColumn(0);
}

void TablePanel::placeBeside(int column, int beside) {
    QHeaderView* header = table_->horizontalHeader();
    const int from = header->visualIndex(column);
    const int left = header->visualIndex(beside);
    header->moveSection(from, from > left ? left + 1 : left);
}

void TablePanel::placeAtFirst(const QList<int>& columns, int beside) {
    for (auto column = columns.rbegin(); column != columns.rend(); ++column)
        if (*column >= known_columns_) placeBeside(*column, beside);
}

void TablePanel::hideAtFirst(const QList<int>& columns, int beside) {
    for (const int column : columns)
        if (column >= known_columns_) table_->horizontalHeader()->setSectionHidden(column, true);
    placeAtFirst(columns, beside);
}

void TablePanel::saveColumns() const {
    QSettings().setValue(settings_key_, table_->horizontalHeader()->saveState());
    QVariantList widths;
    for (const int width : fitted_widths_) widths << width;
    QSettings().setValue(settings_key_ + kFittedKey, widths);
    // The model may be gone by now, and its columns with it.
    QSettings().setValue(settings_key_ + kKnownKey, all_columns_);
}

}  // namespace eyrie::ui

#include "moc_table_panel.cpp"
