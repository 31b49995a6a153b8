#include "review/runs/runs_panel.h"

#include <QKeyEvent>
#include <QMenu>
#include <QTableView>

#include "widgets/empty_state.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

RunsPanel::RunsPanel(RunsModel* model, QWidget* parent) : TablePanel(model, QStringLiteral("runs"), parent) {
    table()->setAccessibleName(tr("Runs"));
    emptyState()->setTexts(tr("No run yet. A run finds and follows the moving vehicles of the video; each is kept here "
                              "with its parameters and can be shown again."),
                           tr("Run with these defaults"));
    bindCommands(this, {{emptyState()->button(), [this] { commands_.run(); }}});
}

void RunsPanel::fillMenu(QMenu& menu, int run_id) {
    menu.addAction(tr("Show"), this, [this, run_id] { commands_.show(run_id); });
    menu.addAction(tr("Use its parameters"), this, [this, run_id] { commands_.use_parameters(run_id); });
    menu.addAction(tr("Rename"), QKeySequence(Qt::Key_F2), this, &RunsPanel::editName);
    if (commands_.can_go_on(run_id)) menu.addAction(tr("Continue"), this, [this, run_id] { commands_.go_on(run_id); });
    menu.addSeparator();
    menu.addAction(tr("Remove from the project"), QKeySequence(Qt::Key_Delete), this,
                   [this, run_id] { commands_.remove(run_id); });
}

void RunsPanel::editName() {
    table()->showColumn(RunsModel::name_column);
    table()->edit(proxy().index(table()->currentIndex().row(), RunsModel::name_column));
}

bool RunsPanel::eventFilter(QObject* watched, QEvent* event) {
    if (watched != table() || event->type() != QEvent::KeyPress || currentId() == 0) {
        return TablePanel::eventFilter(watched, event);
    }
    const auto* key = static_cast<QKeyEvent*>(event);
    if (key->matches(QKeySequence::Delete)) {
        commands_.remove(currentId());
        return true;
    }
    if (key->key() == Qt::Key_F2) {
        editName();
        return true;
    }
    return TablePanel::eventFilter(watched, event);
}

}  // namespace eyrie::ui

#include "moc_runs_panel.cpp"
