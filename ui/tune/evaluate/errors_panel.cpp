#include "tune/evaluate/errors_panel.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QScrollBar>
#include <QTableView>
#include <QToolButton>

#include "widgets/empty_state.h"
#include "widgets/tables/table_roles.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {
constexpr int kChipsSettle_ms = 80;
}

ErrorsPanel::ErrorsPanel(ErrorsModel* model, QWidget* parent)
    : TablePanel(model, QStringLiteral("errors"), parent),
      errors_(model),
      chips_due_(kChipsSettle_ms, [this] { commands_.want_chips(); }) {
    table()->setAccessibleName(tr("Errors"));
    table()->setIconSize(QSize(kChipHeight * 3 / 2, kChipHeight));
    table()->verticalHeader()->setDefaultSectionSize(kChipHeight + 4);
    table()->setColumnWidth(ErrorsModel::chip_column, kChipHeight * 3 / 2 + 10);
    status_ = new QLabel(this);
    status_->setWordWrap(true);
    status_->setContentsMargins(6, 0, 6, 4);
    status_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    status_->hide();
    layout()->addWidget(status_);
    kinds_ = filterButton(tr("All kinds"));
    causes_ = filterButton(tr("All causes"));
    connect(table()->verticalScrollBar(), &QScrollBar::valueChanged, this, &ErrorsPanel::wantChips);
    connect(table()->model(), &QAbstractItemModel::layoutChanged, this, &ErrorsPanel::wantChips);
    whenAny(model, this, &ErrorsPanel::rebuildMenus, &QAbstractItemModel::modelReset, &QAbstractItemModel::rowsInserted,
            &QAbstractItemModel::rowsRemoved);
    rebuildMenus();
}

QToolButton* ErrorsPanel::filterButton(const QString& title) {
    auto* button = new QToolButton(this);
    button->setText(title);
    button->setPopupMode(QToolButton::InstantPopup);
    button->setMenu(new QMenu(button));
    toolRow()->addWidget(button);
    return button;
}

void ErrorsPanel::rebuildMenus() {
    const auto build = [this](QToolButton* button, const QString& all, const QString& chosen, auto field,
                              void (ErrorsPanel::*choose)(const QString&)) {
        QMap<QString, int> counts;
        for (int row = 0; row < errors_->rowCount(); ++row) ++counts[field(*errors_->recordAt(row))];
        QMenu* menu = button->menu();
        menu->clear();
        menu->addAction(all, this, [this, choose] { (this->*choose)({}); });
        menu->addSeparator();
        for (auto it = counts.cbegin(); it != counts.cend(); ++it)
            menu->addAction(QStringLiteral("%1 (%2)").arg(it.key()).arg(it.value()), this,
                            [this, choose, name = it.key()] { (this->*choose)(name); });
        button->setText(chosen.isEmpty() ? all : chosen);
    };
    build(
        kinds_, tr("All kinds"), kind_, [](const ErrorRow& row) { return row.kind; }, &ErrorsPanel::setShownKind);
    build(
        causes_, tr("All causes"), cause_, [](const ErrorRow& row) { return row.cause; }, &ErrorsPanel::setShownCause);
    wantChips();
}

void ErrorsPanel::setStatus(const QString& text) {
    status_->setText(text);
    status_->setVisible(!text.isEmpty());
}

QString ErrorsPanel::status() const {
    return status_->text();
}

void ErrorsPanel::setShownKind(const QString& kind) {
    kind_ = kind;
    applyFilter();
}

void ErrorsPanel::setShownCause(const QString& cause) {
    cause_ = cause;
    applyFilter();
}

void ErrorsPanel::applyFilter() {
    kinds_->setText(kind_.isEmpty() ? tr("All kinds") : kind_);
    causes_->setText(cause_.isEmpty() ? tr("All causes") : cause_);
    proxy().setRowFilter([this](int row) {
        const ErrorRow* error = errors_->recordAt(row);
        return error != nullptr && (kind_.isEmpty() || error->kind == kind_) &&
               (cause_.isEmpty() || error->cause == cause_);
    });
    wantChips();
}

int ErrorsPanel::neighbour(int step) const {
    const QAbstractItemModel* shown = table()->model();
    const int rows = shown->rowCount();
    if (rows == 0) return 0;
    const int id = currentId();
    int row = step > 0 ? -1 : rows;
    for (int i = 0; id != 0 && i < rows; ++i)
        if (shown->index(i, 0).data(id_role).toInt() == id) row = i;
    const int next = ((row + step) % rows + rows) % rows;  // from the last to the first
    return shown->index(next, 0).data(id_role).toInt();
}

QList<int> ErrorsPanel::rowsWithoutChip() const {
    QList<int> ids;
    const QAbstractItemModel* shown = table()->model();
    const int first = std::max(0, table()->rowAt(0));
    int last = table()->rowAt(table()->viewport()->height() - 1);
    if (last < 0) last = shown->rowCount() - 1;
    for (int row = first; row <= last && row < shown->rowCount(); ++row) {
        const int id = shown->index(row, 0).data(id_role).toInt();
        if (!errors_->hasChip(id)) ids << id;
    }
    return ids;
}

void ErrorsPanel::wantChips() {
    chips_due_.start();
}

void ErrorsPanel::resizeEvent(QResizeEvent* event) {
    TablePanel::resizeEvent(event);
    wantChips();
}

void ErrorsPanel::fillMenu(QMenu& menu, int id) {
    menu.addAction(tr("Go there"), this, [this, id] { commands_.go_to(id); });
    menu.addAction(tr("Why?"), this, [this, id] { commands_.ask_why(id); });
    menu.addAction(tr("The ground truth is wrong here…"), this, [this, id] { commands_.correct_truth(id); });
    const ErrorRow* row = errors_->recordAt(errors_->rowOf(id));
    if (row == nullptr) return;
    menu.addAction(tr("Only “%1”").arg(row->kind), this, [this, kind = row->kind] { setShownKind(kind); });
    menu.addAction(tr("Only “%1”").arg(row->cause), this, [this, cause = row->cause] { setShownCause(cause); });
}

}  // namespace eyrie::ui

#include "moc_errors_panel.cpp"
