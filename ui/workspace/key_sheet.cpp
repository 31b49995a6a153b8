#include "workspace/key_sheet.h"

#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

enum Column { kCommand, kKeys };
constexpr int kAction = Qt::UserRole;  ///< data of an item: its command

QString plain(QString text) {
    return text.remove(QLatin1Char('&')).remove(QStringLiteral("…"));
}

QAction* actionOf(const QTreeWidgetItem* item) {
    return item == nullptr ? nullptr : item->data(kCommand, kAction).value<QAction*>();
}

QTreeWidgetItem* heading(QTreeWidget* list, const QString& title) {
    auto* item = new QTreeWidgetItem(list, {title});
    QFont font = item->font(kCommand);
    font.setBold(true);
    item->setFont(kCommand, font);
    item->setFlags(Qt::ItemIsEnabled);
    item->setFirstColumnSpanned(true);
    item->setExpanded(true);
    return item;
}

}  // namespace

KeySheet::KeySheet(KeyBindings& keys, const QString& first, QWidget* parent) : QDialog(parent), keys_(keys) {
    setWindowTitle(tr("Keys"));
    search_ = new QLineEdit;
    search_->setPlaceholderText(tr("Search commands and keys"));
    search_->setClearButtonEnabled(true);
    list_ = new QTreeWidget;
    list_->setColumnCount(2);
    list_->setHeaderLabels({tr("Command"), tr("Keys")});
    list_->setRootIsDecorated(false);
    list_->setIndentation(14);
    list_->setAlternatingRowColors(true);
    list_->header()->setStretchLastSection(false);
    list_->header()->setSectionResizeMode(kCommand, QHeaderView::Stretch);
    list_->header()->setSectionResizeMode(kKeys, QHeaderView::ResizeToContents);
    key_ = new QKeySequenceEdit;
    set_ = new QPushButton(tr("Use this key"));
    none_ = new QPushButton(tr("No key"));
    default_ = new QPushButton(tr("Default"));
    default_->setToolTip(tr("Restore the default keys of this command"));
    auto* all = new QPushButton(tr("Restore all defaults"));
    answer_ = new QLabel;
    answer_->setWordWrap(true);
    for (QPushButton* button : {set_, none_, default_, all}) button->setAutoDefault(false);

    auto* row = new QHBoxLayout;
    row->addWidget(new QLabel(tr("New key:")));
    row->addWidget(key_, 1);
    row->addWidget(set_);
    row->addWidget(none_);
    row->addWidget(default_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    buttons->addButton(all, QDialogButtonBox::ResetRole);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(search_);
    layout->addWidget(list_, 1);
    layout->addLayout(row);
    layout->addWidget(answer_);
    layout->addWidget(buttons);
    resize(760, 620);  // the longest commands are read whole

    fill(first);
    onEdited(this, &KeySheet::filter, search_);
    connect(list_, &QTreeWidget::currentItemChanged, this, &KeySheet::showChosen);
    connect(list_, &QTreeWidget::itemActivated, key_, qOverload<>(&QWidget::setFocus));
    bindCommands(this, {{set_, [this] { setKey(key_->keySequence()); }},
                        {none_,
                         [this] {
                             if (chosen() != nullptr) keys_.setKeysOf(chosen(), {});
                         }},
                        {default_,
                         [this] {
                             if (chosen() != nullptr) keys_.reset(chosen());
                         }},
                        {all, [this] { keys_.resetAll(); }}});
    connect(&keys_, &KeyBindings::keysChanged, this, &KeySheet::showAllKeys);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    showChosen();
    search_->setFocus();
}

void KeySheet::fill(const QString& first) {
    QList<KeyBindings::Group> groups = keys_.groups();
    std::stable_partition(groups.begin(), groups.end(),
                          [&](const KeyBindings::Group& group) { return group.title == first; });
    for (const KeyBindings::Group& group : groups)
        for (const ActionSection& section : group.sections) {
            auto* title = heading(list_, group.title.isEmpty() ? plain(section.title)
                                                               : tr("%1: %2").arg(group.title, plain(section.title)));
            for (QAction* action : section.actions) {
                auto* item = new QTreeWidgetItem(title, {plain(action->text())});
                item->setData(kCommand, kAction, QVariant::fromValue(action));
                item->setToolTip(kCommand, action->whatsThis());
                showKeys(item);
            }
        }
    const auto told = [this](const QString& heading_text, std::initializer_list<std::pair<QString, QString>> rows) {
        auto* title = heading(list_, heading_text);
        for (const auto& [what, how] : rows) new QTreeWidgetItem(title, {what, how});
    };
    told(tr("While something is drawn or measured"),
         {{tr("Move a cross over the picture by 1 px"), tr("Arrow keys")},
          {tr("Move the cross by 10 px"), tr("Shift and an arrow key")},
          {tr("Click at the cross; begin and end a box"), tr("Enter or Space")},
          {tr("Double-click at the cross"), tr("Enter or Space again without moving")},
          {tr("End a zone, a line or control points"), tr("Enter, while no cross is shown")},
          {tr("Take the last point back"), tr("Backspace")},
          {tr("Go to the next point of a zone, while its points are moved"), tr("Tab")},
          {tr("Cancel"), tr("Esc")}});
    told(tr("Mouse"), {{tr("Zoom to the cursor"), tr("Wheel")},
                       {tr("Move the picture"), tr("Drag, also with Space held")},
                       {tr("Select a track"), tr("Click")},
                       {tr("Zoom in, again: fit"), tr("Double-click")},
                       {tr("Go through the video"), tr("Drag the timeline")},
                       {tr("Zoom the timeline; Shift scrolls it"), tr("Wheel on it")}});
}

void KeySheet::showKeys(QTreeWidgetItem* item) {
    const QAction* action = actionOf(item);
    if (action == nullptr) return;
    QStringList texts;
    for (const QKeySequence& key : keys_.keysOf(action)) texts << key.toString(QKeySequence::NativeText);
    item->setText(kKeys, texts.join(tr(" or ")));
    QFont font = item->font(kKeys);
    font.setBold(keys_.changed(action));
    item->setFont(kKeys, font);
}

void KeySheet::showAllKeys() {
    for (QTreeWidgetItemIterator item(list_); *item != nullptr; ++item) showKeys(*item);
    showChosen();
}

void KeySheet::filter() {
    const QString wanted = search_->text();
    for (int i = 0; i < list_->topLevelItemCount(); ++i) {
        QTreeWidgetItem* title = list_->topLevelItem(i);
        bool any = false;
        for (int k = 0; k < title->childCount(); ++k) {
            QTreeWidgetItem* item = title->child(k);
            const bool fits = item->text(kCommand).contains(wanted, Qt::CaseInsensitive) ||
                              item->text(kKeys).contains(wanted, Qt::CaseInsensitive);
            item->setHidden(!fits);
            any = any || fits;
        }
        title->setHidden(!any);
    }
}

QAction* KeySheet::chosen() const {
    return actionOf(list_->currentItem());
}

void KeySheet::choose(const QAction* action) {
    for (QTreeWidgetItemIterator item(list_); *item != nullptr; ++item)
        if (actionOf(*item) == action) list_->setCurrentItem(*item);
}

void KeySheet::showChosen() {
    const QAction* action = chosen();
    key_->setEnabled(action != nullptr);
    set_->setEnabled(action != nullptr);
    none_->setEnabled(action != nullptr && !keys_.keysOf(action).isEmpty());
    default_->setEnabled(action != nullptr && keys_.changed(action));
    key_->clear();
    answer_->setText(action == nullptr ? tr("Choose a command to change its key.") : QString());
}

void KeySheet::setKey(const QKeySequence& key) {
    QAction* action = chosen();
    if (action == nullptr || key.isEmpty()) return;
    const QString name = key.toString(QKeySequence::NativeText);
    if (const QAction* other = keys_.owner(key, action)) {
        answer_->setText(tr("%1 belongs to “%2”. Give that another key first.").arg(name, plain(other->text())));
        return;
    }
    keys_.setKeysOf(action, {key});
    answer_->setText(tr("“%1” is now on %2.").arg(plain(action->text()), name));
}

QString KeySheet::answer() const {
    return answer_->text();
}

}  // namespace eyrie::ui

#include "moc_key_sheet.cpp"
