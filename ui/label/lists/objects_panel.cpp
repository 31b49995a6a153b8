#include "label/lists/objects_panel.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QMenu>
#include <QProgressBar>
#include <QSignalBlocker>
#include <QTableView>
#include <QToolButton>

#include "widgets/display_text.h"
#include "widgets/empty_state.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {
enum StateFilter { any_state, new_state, checked_state, questionable_state };
}  // namespace

ObjectsPanel::ObjectsPanel(ObjectsModel* model, QWidget* parent)
    : TablePanel(model, QStringLiteral("objects"), parent),
      objects_(model),
      class_(new QComboBox(this)),
      state_(new QComboBox(this)),
      this_frame_(new QToolButton(this)),
      shortest_(new QDoubleSpinBox(this)),
      slowest_(new QDoubleSpinBox(this)),
      coverage_(new QProgressBar(this)) {
    table()->setAccessibleName(tr("Objects"));
    explainNothing(false);
    this_frame_->setText(tr("This frame"));
    this_frame_->setCheckable(true);
    this_frame_->setToolTip(tr("List only objects in the frame shown"));
    class_->addItem(tr("All classes"));
    state_->addItems({tr("Any state"), tr("Not checked"), tr("Checked"), tr("Questionable")});
    for (QDoubleSpinBox* box : {shortest_, slowest_}) {
        box->setRange(0, 1e6);
        box->setDecimals(1);
        box->setMinimumWidth(60);
        box->setKeyboardTracking(false);
    }
    shortest_->setPrefix(tr("life ≥ "));
    shortest_->setSuffix(tr(" s"));
    shortest_->setToolTip(tr("List only objects with at least this life, in seconds"));
    slowest_->setPrefix(tr("v ≥ "));
    coverage_->setRange(0, 1000);
    coverage_->setTextVisible(true);
    coverage_->setMaximumHeight(16);
    coverage_->setAccessibleName(tr("Checked share"));
    toolRow()->addWidget(this_frame_);
    auto* filters = new QGridLayout;
    filters->setContentsMargins(2, 0, 2, 2);
    filters->setSpacing(4);
    for (QComboBox* box : {class_, state_}) {
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(6);
    }
    for (const int column : {0, 1}) filters->setColumnStretch(column, 1);
    filters->addWidget(class_, 0, 0);
    filters->addWidget(state_, 0, 1);
    filters->addWidget(shortest_, 1, 0);
    filters->addWidget(slowest_, 1, 1);
    if (auto* rows = qobject_cast<QBoxLayout*>(layout())) {
        rows->insertLayout(1, filters);
        rows->addWidget(coverage_);
    }
    setCheckedShare(0, 0);
    showSpeedUnit();
    whenAny(model, this, &ObjectsPanel::showSpeedUnit, &QAbstractItemModel::headerDataChanged);
    onEdited(this, &ObjectsPanel::refilter, class_, state_, shortest_, slowest_, this_frame_);
}

void ObjectsPanel::explainNothing(bool with_video) {
    if (with_video)
        emptyState()->setTexts(
            tr("Nothing is labelled yet. Draw an object by clicking the rear and the front of a vehicle, take over the "
               "tracks of a run as proposals, or import labels from a file."),
            tr("Draw an object"));
    else
        emptyState()->setTexts(tr("Open a video first. The objects that are labelled in it are listed here."));
}

void ObjectsPanel::showSpeedUnit() {
    const QString unit = speedUnit(objects_->scale());
    slowest_->setSuffix(QLatin1Char(' ') + unit);
    slowest_->setToolTip(tr("List only objects at least this fast, in %1 over the ground").arg(unit));
}

void ObjectsPanel::setClasses(const QStringList& classes) {
    QStringList known;
    for (int i = 1; i < class_->count(); ++i) known << class_->itemText(i);
    if (known == classes) return;
    const QSignalBlocker blocker(class_);
    const QString chosen = class_->currentIndex() > 0 ? class_->currentText() : QString();
    while (class_->count() > 1) class_->removeItem(1);
    class_->addItems(classes);
    class_->setCurrentIndex(chosen.isEmpty() ? 0 : std::max(0, class_->findText(chosen)));
}

void ObjectsPanel::setFrame(FrameIndex frame) {
    frame_ = frame;
    if (this_frame_->isChecked()) refilter();
}

void ObjectsPanel::setThisFrameOnly(bool only) {
    this_frame_->setChecked(only);
}

void ObjectsPanel::setCheckedShare(double share, int objects) {
    coverage_->setValue(qRound(1000 * share));
    coverage_->setFormat(tr("%1 % checked").arg(100 * share, 0, 'f', 1));
    coverage_->setVisible(objects > 0);
}

bool ObjectsPanel::passes(const ObjectRow& row) const {
    if (class_->currentIndex() > 0 && row.object_class != class_->currentText()) return false;
    if (this_frame_->isChecked() && (frame_ < row.first_frame || frame_ > row.last_frame)) return false;
    if (objects_->secondsOf(row) < shortest_->value() || objects_->shownSpeedOf(row) < slowest_->value()) return false;
    switch (state_->currentIndex()) {
        case new_state:
            return row.state != ReviewState::checked;
        case checked_state:
            return row.state == ReviewState::checked;
        case questionable_state:
            return row.state == ReviewState::questionable;
        default:
            return true;
    }
}

void ObjectsPanel::refilter() {
    const bool filters = class_->currentIndex() > 0 || state_->currentIndex() > 0 || this_frame_->isChecked() ||
                         shortest_->value() > 0 || slowest_->value() > 0;
    if (!filters) {
        proxy().setRowFilter({});
        return;
    }
    proxy().setRowFilter([this](int row) {
        const ObjectRow* object = objects_->recordAt(row);
        return object != nullptr && passes(*object);
    });
}

void ObjectsPanel::activate(int object, int column) {
    const ObjectRow* row = objects_->recordAt(objects_->rowOf(object));
    if (row == nullptr) return;
    if (column == ObjectsModel::last_column)
        commands_.go_to(object, row->last_frame);
    else if (column == ObjectsModel::first_column || frame_ < row->first_frame || frame_ > row->last_frame)
        commands_.go_to(object, row->first_frame);
    else
        commands_.select(object);
}

void ObjectsPanel::fillMenu(QMenu& menu, int object) {
    menu.addAction(tr("Go to its first frame"), this, [this, object] { activate(object, ObjectsModel::first_column); });
    menu.addAction(tr("Go to its last frame"), this, [this, object] { activate(object, ObjectsModel::last_column); });
}

}  // namespace eyrie::ui

#include "moc_objects_panel.cpp"
