#include "label/lists/object_inspector.h"

#include <QColorDialog>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QSignalBlocker>
#include <QStackedLayout>
#include <QToolButton>
#include <QVBoxLayout>
#include <utility>

#include "label/label_actions.h"
#include "widgets/empty_state.h"
#include "widgets/layout/scrolled.h"
#include "widgets/swatch.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

QToolButton* button(const QString& text, bool checkable) {
    auto* made = new QToolButton;
    made->setText(text);
    made->setCheckable(checkable);
    made->setFocusPolicy(Qt::TabFocus);
    made->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    return made;
}

QHBoxLayout* row(std::initializer_list<QWidget*> widgets) {
    auto* layout = new QHBoxLayout;
    layout->setSpacing(4);
    for (QWidget* widget : widgets) layout->addWidget(widget, 1);
    return layout;
}

}  // namespace

void ObjectInspector::nameKeys(const LabelActions& actions) {
    occluded_->setToolTip(withKey(tr("Not, partly or fully hidden from here"), *actions.occluded));
    outside_->setToolTip(withKey(tr("Outside the image from here until the next keyframe"), *actions.outside));
    ignore_->setToolTip(withKey(tr("Ignored by the evaluation from here until the next keyframe"), *actions.ignore));
    checked_->setToolTip(withKey(tr("Reviewed in full and found right"), *actions.checked));
    questionable_->setToolTip(withKey(tr("To be looked at again"), *actions.questionable));
}

ObjectInspector::ObjectInspector(QWidget* parent) : QWidget(parent) {
    pages_ = new QStackedLayout(this);
    empty_ = new EmptyState;
    empty_->setTexts(
        tr("Nothing is selected. Click a box in the video or a row in the list, or go to the next object from the menu "
           "Label."));
    auto* page = new QWidget;
    auto* layout = new QVBoxLayout(page);
    title_ = new QLabel;
    QFont font = title_->font();
    font.setPointSizeF(font.pointSizeF() * 1.25);
    font.setBold(true);
    title_->setFont(font);
    life_ = new QLabel;
    box_ = new QLabel;
    review_ = new QLabel;
    for (QLabel* label : {life_, box_, review_}) {
        label->setWordWrap(true);
        label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    }
    class_ = new QComboBox;
    class_->setToolTip(tr("Class; type a name and press Return for one of your own"));
    class_->setEditable(true);
    class_->setInsertPolicy(QComboBox::NoInsert);
    colour_ = new QToolButton;
    colour_->setPopupMode(QToolButton::InstantPopup);
    colour_->setFocusPolicy(Qt::TabFocus);
    colour_->setAccessibleName(tr("Colour"));
    auto* colours = new QMenu(colour_);
    colours->addAction(tr("A colour of its own…"), this, &ObjectInspector::chooseColour);
    class_colour_ = colours->addAction(tr("Colour of its class"), this, [this] { edits_.set_colour({}); });
    colour_->setMenu(colours);
    occluded_ = button(tr("Occluded"), true);
    outside_ = button(tr("Outside"), true);
    ignore_ = button(tr("Ignore"), true);
    checked_ = button(tr("Checked"), false);
    questionable_ = button(tr("Questionable"), false);
    notes_ = new QLineEdit;
    notes_->setPlaceholderText(tr("Notes"));
    joins_heading_ = new QLabel(tr("May be the same vehicle (double-click to join):"));
    joins_heading_->setWordWrap(true);
    joins_ = new QListWidget;
    joins_->setAlternatingRowColors(true);
    joins_->setWordWrap(true);
    joins_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    layout->addWidget(title_);
    layout->addWidget(life_);
    layout->addWidget(box_);
    auto* kind = new QHBoxLayout;
    kind->setSpacing(4);
    kind->addWidget(class_, 1);
    kind->addWidget(colour_);
    layout->addLayout(kind);
    layout->addLayout(row({occluded_, outside_, ignore_}));
    layout->addWidget(review_);
    layout->addLayout(row({checked_, questionable_}));
    layout->addWidget(notes_);
    layout->addWidget(joins_heading_);
    layout->addWidget(joins_, 1);
    layout->addStretch(0);
    pages_->addWidget(empty_);
    pages_->addWidget(scrolled(page));
    connect(class_, &QComboBox::textActivated, this, [this](const QString& name) { edits_.set_class(name); });
    connect(class_->lineEdit(), &QLineEdit::returnPressed, this, [this] {
        const QString name = class_->currentText().simplified().toLower();
        if (!name.isEmpty() && class_->findText(name) < 0) edits_.set_class(name);
    });
    bindCommands(this, {{occluded_, [this] { edits_.toggle_occluded(); }},
                        {outside_, [this] { edits_.toggle_outside(); }},
                        {ignore_, [this] { edits_.toggle_ignore(); }},
                        {checked_, [this] { edits_.check(); }},
                        {questionable_, [this] { edits_.question(); }}});
    onFinished(
        this, [this] { keepNotes(shown_); }, notes_);
    connect(joins_, &QListWidget::itemDoubleClicked, this,
            [this](QListWidgetItem* item) { edits_.join(item->data(Qt::UserRole).toInt()); });
    connect(joins_, &QListWidget::itemClicked, this,
            [this](QListWidgetItem* item) { edits_.show_candidate(item->data(Qt::UserRole).toInt()); });
}

void ObjectInspector::chooseColour() {
    const QColor chosen = QColorDialog::getColor(shown_colour_, this, tr("Colour of %1").arg(title_->text()));
    if (chosen.isValid()) edits_.set_colour(chosen);
}

void ObjectInspector::showColour(const ObjectDetails& details) {
    shown_colour_ = details.colour;
    class_colour_->setEnabled(details.own_colour);
    colour_->setEnabled(details.editable);
    colour_->setToolTip(details.own_colour ? tr("Shown in a colour of its own")
                                           : tr("Shown in the colour of its class"));
    colour_->setIcon(swatch(details.colour, 16));
}

void ObjectInspector::setClasses(const QStringList& classes) {
    QStringList known;
    for (int i = 0; i < class_->count(); ++i) known << class_->itemText(i);
    if (known == classes) return;
    const QSignalBlocker blocker(class_);
    const QString chosen = class_->currentText();
    class_->clear();
    class_->addItems(classes);
    class_->setCurrentText(chosen);
}

/// Only once: what was written may be taken back, and other labels have objects of the same numbers.
void ObjectInspector::keepNotes(int object) {
    if (object == 0 || !notes_->isModified()) return;
    notes_->setModified(false);
    edits_.set_notes(object, notes_->text());
}

void ObjectInspector::showObject(const std::optional<ObjectDetails>& details) {
    const int object = details ? details->id : 0;
    const int former = std::exchange(shown_, object);
    const bool other = object != former;
    // Keys, and clicks that leave the focus where it is, choose another object while notes are being written.
    if (other) keepNotes(former);
    pages_->setCurrentIndex(details ? 1 : 0);
    if (!details) return;
    title_->setText(details->title);
    life_->setText(details->life);
    box_->setText(details->box);
    review_->setText(details->review);
    showColour(*details);
    const QSignalBlocker class_blocker(class_);
    class_->setCurrentText(details->object_class);
    occluded_->setChecked(details->occlusion != Occlusion::none);
    occluded_->setText(details->occlusion == Occlusion::fully    ? tr("Fully occluded")
                       : details->occlusion == Occlusion::partly ? tr("Partly occluded")
                                                                 : tr("Occluded"));
    outside_->setChecked(details->outside);
    ignore_->setChecked(details->ignore);
    for (QWidget* widget :
         {static_cast<QWidget*>(occluded_), static_cast<QWidget*>(outside_), static_cast<QWidget*>(ignore_)})
        widget->setEnabled(details->editable && details->lives_here);
    for (QWidget* widget : {static_cast<QWidget*>(class_), static_cast<QWidget*>(checked_),
                            static_cast<QWidget*>(questionable_), static_cast<QWidget*>(notes_)})
        widget->setEnabled(details->editable);
    const bool being_written = notes_->hasFocus() && notes_->isModified();
    if ((other || !being_written) && notes_->text() != details->notes) notes_->setText(details->notes);
    joins_->clear();
    for (const JoinOffer& offer : details->joins) {
        auto* item = new QListWidgetItem(offer.text, joins_);
        item->setToolTip(offer.text);
        item->setData(Qt::UserRole, offer.object);
    }
    joins_heading_->setVisible(!details->joins.empty());
    joins_->setVisible(!details->joins.empty());
}

QString ObjectInspector::title() const {
    return pages_->currentIndex() == 1 ? title_->text() : QString();
}

QString ObjectInspector::boxText() const {
    return pages_->currentIndex() == 1 ? box_->text() : QString();
}

}  // namespace eyrie::ui

#include "moc_object_inspector.cpp"
