#include "review/zones/zones_panel.h"

#include <QColorDialog>
#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "review/zones/zone_colours.h"
#include "review/zones/zones_model.h"
#include "widgets/display_text.h"
#include "widgets/swatch.h"
#include "widgets/tables/table_look.h"
#include "widgets/tables/table_roles.h"
#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

// The events above are what one looks at.
constexpr int kLeastRows = 2;
constexpr int kMostRows = 5;
constexpr int kSwatchIcon = 14;

}  // namespace

ZonesPanel::ZonesPanel(ZonesModel* model, const WindowActions& actions, QWidget* parent)
    : QWidget(parent),
      model_(model),
      table_(new QTableView(this)),
      hint_(new QLabel(this)),
      anchor_(new QComboBox(this)) {
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(2);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
    hint_->setWordWrap(true);
    hint_->setContentsMargins(6, 2, 6, 2);
    hint_->setTextFormat(Qt::PlainText);
    table_->setModel(model_);
    table_->setAccessibleName(tr("Zones, lines and arrows"));
    lookAsList(*table_);
    table_->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
    table_->horizontalHeader()->setSectionResizeMode(ZonesModel::name_column, QHeaderView::Stretch);
    table_->horizontalHeader()->setSectionResizeMode(ZonesModel::events_column, QHeaderView::ResizeToContents);
    table_->horizontalHeader()->setSectionResizeMode(ZonesModel::anchor_column, QHeaderView::ResizeToContents);
    table_->setContextMenuPolicy(Qt::CustomContextMenu);
    table_->installEventFilter(this);
    buildButtons(actions);
    rows->addWidget(table_, 1);
    rows->addWidget(hint_);
    connect(table_, &QWidget::customContextMenuRequested, this, [this](const QPoint& place) {
        if (currentId() == 0) return;
        QMenu menu;
        fillMenu(menu);
        menu.exec(table_->viewport()->mapToGlobal(place));
    });
    connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
        enableButtons();
        commands_.select(currentId());
    });
    whenAny(model_, this, &ZonesPanel::enableButtons, &QAbstractItemModel::rowsInserted,
            &QAbstractItemModel::rowsRemoved, &QAbstractItemModel::modelReset);
    enableButtons();
}

void ZonesPanel::buildButtons(const WindowActions& actions) {
    auto* line = new QHBoxLayout;
    line->setContentsMargins(2, 0, 2, 0);
    line->setSpacing(2);
    const auto add = [&](QAction* action, const QString& text) {
        auto* button = new QToolButton(this);
        button->setDefaultAction(action);
        button->setToolButtonStyle(Qt::ToolButtonTextOnly);
        button->setText(text);
        connect(action, &QAction::changed, button, [button, text] { button->setText(text); });
        line->addWidget(button);
    };
    line->addWidget(new QLabel(tr("Draw"), this));
    add(actions.draw_zone, tr("area"));
    add(actions.draw_line, tr("line"));
    add(actions.draw_arrow, tr("arrow"));
    anchor_->addItems({tr("on the ground"), tr("in the image")});
    anchor_->setAccessibleName(tr("What new zones are fixed to"));
    anchor_->setToolTip(tr("New zones stay where they are on the ground, or in the image, when the camera moves"));
    line->addWidget(anchor_);
    line->addStretch(1);
    remove_ = new QToolButton(this);
    remove_->setText(tr("Delete"));
    remove_->setToolTip(tr("Delete the selected zones; can be undone"));
    bindCommands(this, {{remove_, [this] { commands_.remove(selectedIds()); }}});
    line->addWidget(remove_);
    more_ = new QToolButton(this);
    more_->setText(QStringLiteral("⋯"));
    more_->setAccessibleName(tr("More about zones"));
    more_->setToolTip(tr("Points, colour, import and export"));
    more_->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(more_);
    connect(menu, &QMenu::aboutToShow, this, [this, menu] {
        menu->clear();
        fillMenu(*menu);
    });
    more_->setMenu(menu);
    line->addWidget(more_);
    static_cast<QVBoxLayout*>(layout())->addLayout(line);
}

void ZonesPanel::fillMenu(QMenu& menu) {
    const int id = currentId();
    const ZoneEntry* entry = model_->recordAt(model_->rowOf(id));
    if (entry != nullptr) {
        menu.addAction(tr("Rename"), QKeySequence(Qt::Key_F2), this, [this, id] { editName(id); });
        menu.addAction(tr("Move its points"), this, [this, id] { commands_.move_points(id); });
        QMenu* colours = menu.addMenu(tr("Colour"));
        const QString names[] = {tr("Blue"), tr("Orange"), tr("Pink"),   tr("Yellow"),
                                 tr("Cyan"), tr("Red"),    tr("Violet"), tr("White")};
        for (std::size_t i = 0; i < zoneColours().size(); ++i) {
            const QColor colour = zoneColours().at(i);
            colours->addAction(QIcon(swatch(colour, kSwatchIcon)), names[i], this,
                               [this, id, colour] { commands_.set_colour(id, colour); });
        }
        colours->addSeparator();
        colours->addAction(tr("Another…"), this, [this, id, now = colourOf(entry->stored)] {
            const QColor chosen = QColorDialog::getColor(now, this, tr("Colour of the zone"));
            if (chosen.isValid()) commands_.set_colour(id, chosen);
        });
        const bool in_image = entry->stored.zone.anchor == ZoneAnchor::image;
        menu.addAction(
            in_image ? tr("Fix to the ground as this frame shows it") : tr("Fix to the image as it lies here"), this,
            [this, id, in_image] { commands_.set_anchor(id, in_image ? ZoneAnchor::ground : ZoneAnchor::image); });
        menu.addAction(tr("Delete"), QKeySequence(Qt::Key_Delete), this, [this] { commands_.remove(selectedIds()); });
        menu.addSeparator();
    }
    menu.addAction(tr("Import zones…"), this, [this] { askForFile(true); });
    menu.addAction(tr("Export zones…"), this, [this] { askForFile(false); })->setEnabled(model_->rowCount() > 0);
}

void ZonesPanel::askForFile(bool reading) {
    const QString kinds = tr("Zones (*.json)");
    if (reading) {
        const QString path = QFileDialog::getOpenFileName(this, tr("Import zones"), {}, kinds);
        if (!path.isEmpty()) commands_.read_file(path);
        return;
    }
    const QString path = QFileDialog::getSaveFileName(this, tr("Export zones"), QStringLiteral("zones.json"), kinds);
    if (!path.isEmpty()) commands_.write_file(withEnding(path, ".json"));
}

void ZonesPanel::enableButtons() {
    remove_->setEnabled(currentId() != 0);
    table_->setVisible(model_->rowCount() > 0);
    const auto height = [this](int rows) {
        return table_->horizontalHeader()->sizeHint().height() + rows * table_->verticalHeader()->defaultSectionSize() +
               2 * table_->frameWidth();
    };
    table_->setMinimumHeight(height(std::clamp(model_->rowCount(), 1, kLeastRows)));
    hint_->setVisible(model_->rowCount() == 0);
    table_->setMaximumHeight(height(std::clamp(model_->rowCount(), 1, kMostRows)));
}

void ZonesPanel::setHint(const QString& text) {
    hint_->setText(text);
}

ZoneAnchor ZonesPanel::anchor() const {
    return anchor_->currentIndex() == 0 ? ZoneAnchor::ground : ZoneAnchor::image;
}

void ZonesPanel::setAnchor(ZoneAnchor anchor) {
    anchor_->setCurrentIndex(anchor == ZoneAnchor::ground ? 0 : 1);
}

int ZonesPanel::currentId() const {
    const std::vector<int> ids = selectedIds();
    return ids.empty() ? 0 : ids.front();
}

std::vector<int> ZonesPanel::selectedIds() const {
    std::vector<int> ids;
    for (const QModelIndex& row : table_->selectionModel()->selectedRows()) ids.push_back(row.data(id_role).toInt());
    return ids;
}

void ZonesPanel::selectId(int id) {
    const int row = model_->rowOf(id);
    if (row < 0) {
        table_->clearSelection();
        return;
    }
    table_->setCurrentIndex(model_->index(row, ZonesModel::name_column));
    table_->scrollTo(model_->index(row, ZonesModel::name_column));
}

void ZonesPanel::editName(int id) {
    selectId(id);
    const int row = model_->rowOf(id);
    if (row < 0) return;
    table_->setFocus();
    table_->edit(model_->index(row, ZonesModel::name_column));
}

bool ZonesPanel::eventFilter(QObject* watched, QEvent* event) {
    const bool override = event->type() == QEvent::ShortcutOverride;
    if (watched == table_ && (override || event->type() == QEvent::KeyPress) && currentId() != 0) {
        const auto* key = static_cast<QKeyEvent*>(event);
        if (key->key() == Qt::Key_Delete && key->modifiers() == Qt::NoModifier) {
            event->accept();
            if (!override) commands_.remove(selectedIds());
            return true;
        }
        if (key->key() == Qt::Key_F2 && !override) {
            editName(currentId());
            return true;
        }
    }
    return QWidget::eventFilter(watched, event);
}

}  // namespace eyrie::ui

#include "moc_zones_panel.cpp"
