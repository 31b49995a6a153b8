#include "window/bars/overlay_button.h"

#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QSignalBlocker>
#include <QWidgetAction>

#include "canvas/layers/overlay_table.h"
#include "widgets/swatch.h"
#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

OverlayButton::OverlayButton(OverlaySettings& overlays, const WindowActions& actions, QWidget* parent)
    : QToolButton(parent), overlays_(overlays), actions_(actions) {
    setText(tr("Overlays"));
    setIcon(QIcon::fromTheme(QStringLiteral("layer-visible-on")));
    setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    setCheckable(true);
    setPopupMode(QToolButton::InstantPopup);
    setFocusPolicy(Qt::NoFocus);
    buildMenu();
    connect(&overlays_, &OverlaySettings::changed, this, &OverlayButton::refresh);
    refresh();
}

void OverlayButton::buildMenu() {
    auto* menu = new QMenu(this);
    for (const ActionSection& section : actions_.sections())
        if (section.actions.contains(actions_.labels)) actions_.fill(*menu, section);
    auto* row = new QWidget(menu);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(28, 2, 8, 2);
    length_ = new QDoubleSpinBox(row);
    length_->setRange(kShortestVectors, kLongestVectors);
    length_->setDecimals(1);
    length_->setSuffix(tr(" frames"));
    length_->setToolTip(tr("A motion vector is drawn as long as the corner moves in this many frames"));
    length_->setValue(overlays_.style().detail.vector_length_factor);
    layout->addWidget(new QLabel(tr("Vector length"), row));
    layout->addWidget(length_, 1);
    onEdited(
        this, [this] { overlays_.setVectorLengthFactor(length_->value()); }, length_);
    auto* action = new QWidgetAction(menu);
    action->setDefaultWidget(row);
    menu->addSeparator();
    menu->addAction(action);
    setMenu(menu);
}

void OverlayButton::refresh() {
    const QSignalBlocker blocker(length_);
    length_->setValue(overlays_.style().detail.vector_length_factor);
    // Whoever sees no tracks should know that they are hidden.
    setChecked(overlays_.hidden());
    for (const OverlayRow& row : overlayTable())
        actions_.overlay.at(row.kind)->setIcon(switchedSwatch(row.colour(overlays_.style()), 16));
}

}  // namespace eyrie::ui

#include "moc_overlay_button.cpp"
