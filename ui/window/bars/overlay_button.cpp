#include "window/bars/overlay_button.h"

#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPainter>
#include <QSignalBlocker>
#include <QWidgetAction>

#include "canvas/layers/overlay_table.h"
#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

/// A square in the colour of an overlay.
QIcon swatch(const QColor& colour) {
    QPixmap pixmap(16, 16);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QColor(0, 0, 0, 150));
    painter.setBrush(colour);
    painter.drawRoundedRect(QRectF(2.5, 2.5, 11, 11), 2, 2);
    return {pixmap};
}

}  // namespace

OverlayButton::OverlayButton(OverlaySettings& overlays, const WindowActions& actions, QWidget* parent)
    : QToolButton(parent), overlays_(overlays), actions_(actions) {
    setText(tr("Overlays"));
    setIcon(QIcon::fromTheme(QStringLiteral("layer-visible-on")));
    setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    setPopupMode(QToolButton::InstantPopup);
    setFocusPolicy(Qt::NoFocus);
    buildMenu();
    connect(&overlays_, &OverlaySettings::changed, this, &OverlayButton::refresh);
    refresh();
}

void OverlayButton::buildMenu() {
    auto* menu = new QMenu(this);
    for (const ActionSection& section : actions_.sections())
        if (section.actions.contains(actions_.labels)) menu->addActions(section.actions);
    auto* row = new QWidget(menu);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(28, 2, 8, 2);
    length_ = new QDoubleSpinBox(row);
    length_->setRange(1, 100);
    length_->setDecimals(1);
    length_->setSuffix(tr(" frames"));
    length_->setToolTip(tr("A motion vector is drawn as long as the corner moves in this many frames"));
    length_->setValue(overlays_.style().vector_length_factor);
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
    length_->setValue(overlays_.style().vector_length_factor);
    for (const OverlayRow& row : overlayTable())
        actions_.overlay[static_cast<size_t>(row.kind)]->setIcon(swatch(row.colour(overlays_.style())));
}

}  // namespace eyrie::ui
