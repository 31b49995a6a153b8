// The part of LabelWorkspace that shows what objects look like: cut out over time, and stacked in the loupe.
#include <QDockWidget>

#include "canvas/image_convert.h"
#include "label/canvas/label_tool.h"
#include "label/computing/label_chips.h"
#include "label/computing/label_stacks.h"
#include "label/label_actions.h"
#include "label/label_workspace.h"
#include "label/object_colours.h"
#include "widgets/chip_grid.h"
#include "workspace/dock_registry.h"

namespace eyrie::ui {

// ---- chips ----------------------------------------------------------------------------------------------------------

void LabelWorkspace::wireChips() {
    chips_due_.setSingleShot(true);
    chips_due_.setInterval(250);  // not while keys are held
    connect(&chips_due_, &QTimer::timeout, this, &LabelWorkspace::showChips);
    connect(around_.docks.dock(DockId::object_chips), &QDockWidget::visibilityChanged, this, [this](bool visible) {
        chips_looked_at_ = visible;
        if (visible) chips_due_.start();
    });
    connect(chips_, &LabelChips::ready, this, [this](ObjectId id, const std::vector<LabelChip>& chips) {
        if (labels_->selected() != id) return;
        std::vector<ChipCard> cards;
        const LabelledObject* object = labels_->object(id);
        const QColor colour = object != nullptr ? ObjectColours(labels_->annotations()).of(*object) : QColor();
        for (const LabelChip& cut : chips) {
            Chip chip;
            chip.title = cut.keyframe ? tr("%1 ◆").arg(cut.frame) : QString::number(cut.frame);
            chip.values = cut.gray;
            chip.image = wrapImage(cut.gray);
            chip.box_colour = colour;
            const QPointF middle((cut.gray.cols - 1) / 2.0, (cut.gray.rows - 1) / 2.0);
            const QPointF half(cut.box.width / 2, cut.box.height / 2);
            chip.boxes.push_back(QRectF(middle - half, middle + half));
            ChipCard card;
            card.id = cut.frame;
            card.chips.push_back(std::move(chip));
            cards.push_back(std::move(card));
        }
        grid_->setCards(std::move(cards));
        grid_->setMarkedCard(around_.session.currentFrame());
    });
    connect(grid_, &ChipGrid::cardClicked, &around_.session, &ProjectSession::goToFrame);
    connect(&around_.session, &ProjectSession::frameChanged, grid_, &ChipGrid::setMarkedCard);
}

void LabelWorkspace::showChips() {
    if (!active_ || !chips_looked_at_) return;
    if (labels_->selected()) {
        chips_->request(*labels_->selected());
    } else {
        chips_->cancel();
        grid_->setCards({});
    }
}

// ---- image stacks ---------------------------------------------------------------------------------------------------

void LabelWorkspace::wireStacks() {
    const auto follow = [this] { showStack(); };
    connect(labels_, &LabelSession::changed, this, follow);
    connect(labels_, &LabelSession::selectionChanged, this, follow);
    connect(&around_.session, &ProjectSession::viewFrameChanged, this, follow);
    connect(actions_->stack_loupe, &QAction::toggled, this, [this](bool shown) {
        tool_->setStackShown(shown);
        showStack();
    });
    connect(actions_->loupe, &QAction::toggled, this, follow);
    connect(stacks_, &LabelStacks::ready, this, [this](ObjectId id, const ObjectStack& stack) {
        LoupeStack shown;
        shown.object = id;
        shown.frame = stack.frame;
        shown.area = stack.area;
        if (!stack.stacked.empty()) shown.image = wrapImage(stack.stacked);
        shown.layers = stack.layers;
        if (stack.stacked.empty())
            shown.missing =
                stack.layers < 2
                    ? tr("No stack yet: it needs three frames that show the object")
                    : tr("No stack yet: it needs three frames that look alike, there are %1").arg(stack.layers);
        tool_->setStack(std::move(shown));
    });
}

void LabelWorkspace::showStack() {
    const bool wanted = active_ && actions_->loupe->isChecked() && actions_->stack_loupe->isChecked();
    if (wanted && labels_->selected())
        stacks_->request(*labels_->selected(), around_.session.viewFrame().index);
    else
        stacks_->cancel();
}

}  // namespace eyrie::ui
