#include "review/earth/control_points_panel.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "review/earth/control_points_model.h"
#include "widgets/tables/table_look.h"
#include "widgets/tables/table_roles.h"
#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

constexpr int kMostRows = 8;

}  // namespace

ControlPointsPanel::ControlPointsPanel(ControlPointsModel* model, const WindowActions& actions, QWidget* parent)
    : QWidget(parent), model_(model), table_(new QTableView(this)), state_(new QLabel(this)) {
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(0, 0, 0, 4);
    rows->setSpacing(2);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
    state_->setWordWrap(true);
    state_->setContentsMargins(6, 2, 6, 2);
    state_->setTextFormat(Qt::PlainText);
    state_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    table_->setModel(model_);
    table_->setAccessibleName(tr("Ground control points"));
    lookAsList(*table_);
    table_->setEditTriggers(QAbstractItemView::EditKeyPressed);
    table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    table_->horizontalHeader()->setSectionResizeMode(ControlPointsModel::place_column, QHeaderView::Stretch);
    table_->installEventFilter(this);
    buildButtons(actions);
    rows->addWidget(state_);
    rows->addWidget(table_);
    connect(table_, &QTableView::doubleClicked, this,
            [this](const QModelIndex& at) { commands_.go_to(at.data(id_role).toInt()); });
    whenAny(table_->selectionModel(), this, &ControlPointsPanel::showRows, &QItemSelectionModel::selectionChanged);
    whenAny(model_, this, &ControlPointsPanel::showRows, &QAbstractItemModel::rowsInserted,
            &QAbstractItemModel::rowsRemoved, &QAbstractItemModel::modelReset);
    enableUndo(false, false);
    showRows();
}

void ControlPointsPanel::buildButtons(const WindowActions& actions) {
    auto* line = new QHBoxLayout;
    line->setContentsMargins(2, 2, 2, 0);
    line->setSpacing(2);
    auto* set = new QToolButton(this);
    set->setDefaultAction(actions.control_points);
    set->setToolButtonStyle(Qt::ToolButtonTextOnly);
    const QString text = tr("Set control points");
    set->setText(text);
    connect(actions.control_points, &QAction::changed, set, [set, text] { set->setText(text); });
    line->addWidget(set);
    line->addStretch(1);
    const auto button = [&](const char* icon, const QString& name, const QString& tip) {
        auto* made = new QToolButton(this);
        made->setIcon(QIcon::fromTheme(QString::fromLatin1(icon)));
        if (made->icon().isNull()) made->setText(name);
        made->setAccessibleName(name);
        made->setToolTip(tip);
        line->addWidget(made);
        return made;
    };
    undo_ = button("edit-undo", tr("Undo"), tr("Undo the last change of a control point"));
    redo_ = button("edit-redo", tr("Redo"), tr("Redo the change of a control point"));
    remove_ = new QToolButton(this);
    remove_->setText(tr("Delete"));
    remove_->setToolTip(tr("Delete the selected control points; can be undone"));
    line->addWidget(remove_);
    bindCommands(this, {{undo_, [this] { commands_.undo(); }},
                        {redo_, [this] { commands_.redo(); }},
                        {remove_, [this] { commands_.remove(selectedNumbers()); }}});
    static_cast<QVBoxLayout*>(layout())->addLayout(line);
}

void ControlPointsPanel::setState(const QString& text, bool doubtful) {
    QFont font = this->font();
    font.setBold(doubtful);
    state_->setFont(font);
    state_->setText(text);
}

QString ControlPointsPanel::state() const {
    return state_->text();
}

void ControlPointsPanel::enableUndo(bool undo, bool redo) {
    undo_->setEnabled(undo);
    redo_->setEnabled(redo);
}

std::vector<int> ControlPointsPanel::selectedNumbers() const {
    std::vector<int> numbers;
    for (const QModelIndex& row : table_->selectionModel()->selectedRows())
        numbers.push_back(row.data(id_role).toInt());
    return numbers;
}

void ControlPointsPanel::showRows() {
    remove_->setEnabled(!selectedNumbers().empty());
    table_->setVisible(model_->rowCount() > 0);
    const int rows = std::clamp(model_->rowCount(), 1, kMostRows);
    const int height = table_->horizontalHeader()->sizeHint().height() +
                       rows * table_->verticalHeader()->defaultSectionSize() + 2 * table_->frameWidth();
    table_->setFixedHeight(height);
}

bool ControlPointsPanel::eventFilter(QObject* watched, QEvent* event) {
    const bool asks = event->type() == QEvent::ShortcutOverride;
    if (watched != table_ || (!asks && event->type() != QEvent::KeyPress)) return QWidget::eventFilter(watched, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    const std::vector<int> numbers = selectedNumbers();
    std::function<void()> work;
    if (key->matches(QKeySequence::Undo)) work = commands_.undo;
    if (key->matches(QKeySequence::Redo)) work = commands_.redo;
    if (!numbers.empty() && key->matches(QKeySequence::Delete)) work = [&] { commands_.remove(numbers); };
    if (!numbers.empty() && (key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter))
        work = [&] { commands_.go_to(numbers.front()); };
    if (!numbers.empty() && key->key() == Qt::Key_F2)
        work = [&] { table_->edit(model_->index(model_->rowOf(numbers.front()), ControlPointsModel::place_column)); };
    if (!work) return QWidget::eventFilter(watched, event);
    event->accept();
    if (!asks) work();
    return true;
}

}  // namespace eyrie::ui

#include "moc_control_points_panel.cpp"
