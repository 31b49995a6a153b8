#include "review/events/event_kinds_button.h"

#include <QCheckBox>
#include <QEvent>
#include <QMenu>
#include <QWidgetAction>

#include "review/events/event_kind_marks.h"
#include "review/events/event_text.h"
#include "widgets/theme_colours.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

EventKindsButton::EventKindsButton(QWidget* parent) : QToolButton(parent), list_(new QMenu(this)) {
    shown_.fill(true);
    setPopupMode(QToolButton::InstantPopup);
    setToolButtonStyle(Qt::ToolButtonTextOnly);
    setMenu(list_);
    setToolTip(tr("Kinds of events that are listed"));
    makeMenu();
    refresh();
}

void EventKindsButton::makeMenu() {
    // Check boxes rather than actions: the list stays open while several are ticked.
    for (int kind = 0; kind < kListedKinds; ++kind) {
        auto* box = new QCheckBox(list_);
        box->setContentsMargins(6, 0, 6, 0);
        box->setIconSize(kindPlate(kind, false).deviceIndependentSize().toSize());
        boxes_.at(static_cast<std::size_t>(kind)) = box;
        auto* entry = new QWidgetAction(list_);
        entry->setDefaultWidget(box);
        list_->addAction(entry);
        bindCommands(this, {{box, [this, kind](bool on) { setShown(kind, on); }}});
    }
    list_->addSeparator();
    list_->addAction(tr("All kinds"), this, [this] { showAll(); });
    list_->addAction(tr("No kind"), this, [this] { showAll(false); });
}

void EventKindsButton::setCounts(const Counts& counts) {
    counts_ = counts;
    refresh();
}

void EventKindsButton::setShown(int listed_kind, bool shown) {
    bool& is_shown = shown_.at(static_cast<std::size_t>(listed_kind));
    if (is_shown == shown) return;
    is_shown = shown;
    refresh();
    emit edited();
}

void EventKindsButton::showAll(bool shown) {
    shown_.fill(shown);
    refresh();
    emit edited();
}

void EventKindsButton::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange) refresh();
    QToolButton::changeEvent(event);
}

void EventKindsButton::refresh() {
    int hidden = 0;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
        boxes_[i]->setText(QStringLiteral("%1   %2").arg(listedKindText(static_cast<int>(i))).arg(counts_[i]));
        boxes_[i]->setIcon(kindPlate(static_cast<int>(i), isDark(palette())));
        boxes_[i]->setChecked(shown_[i]);
        hidden += shown_[i] ? 0 : 1;
    }
    setText(hidden == 0              ? tr("All kinds")
            : hidden == kListedKinds ? tr("No kind")
                                     : tr("%1 of %2 kinds").arg(kListedKinds - hidden).arg(kListedKinds));
}

}  // namespace eyrie::ui

#include "moc_event_kinds_button.cpp"
