#include "label/object_pictures.h"

#include <QStackedWidget>

#include "canvas/drawing/image_convert.h"
#include "label/canvas/label_tool.h"
#include "label/computing/label_chips.h"
#include "label/computing/label_stacks.h"
#include "label/label_actions.h"
#include "label/object_colours.h"
#include "widgets/chip_grid.h"
#include "widgets/empty_state.h"
#include "widgets/wiring.h"
#include "workspace/dock_registry.h"

namespace eyrie::ui {

namespace {
constexpr int kChipsDelay_ms = 250;  ///< not while keys are held
}

ObjectPictures::ObjectPictures(const LabelParts& parts, QObject* parent)
    : QObject(parent), parts_(parts), chips_due_(kChipsDelay_ms, [this] { showChips(); }) {
    chips_ = new LabelChips(parts_.around.session, parts_.labels, this);
    stacks_ = new LabelStacks(parts_.around.session, parts_.labels, this);
    grid_ = new ChipGrid;
    auto* nothing = new EmptyState;
    nothing->setTexts(
        tr("Nothing is selected. The selected object is shown here in frame after frame, so that a box "
           "that slips off it is noticed."));
    pages_ = new QStackedWidget;
    pages_->addWidget(nothing);
    pages_->addWidget(grid_);
    parts_.around.docks.add(DockId::object_chips, tr("Over time"), pages_);
    wireChips();
    wireStacks();
    whenChanged(parts_.around.session, this,
                {{SessionChange::frame, [this] { grid_->setMarkedCard(parts_.around.session.currentFrame()); }},
                 {SessionChange::picture, [this] { showStack(); }}});
}

// ---- chips ----------------------------------------------------------------------------------------------------------

void ObjectPictures::wireChips() {
    parts_.around.docks.watch(DockId::object_chips, this, [this](bool visible) {
        chips_looked_at_ = visible;
        if (visible) chips_due_.start();
    });
    connect(chips_, &LabelChips::ready, this, &ObjectPictures::takeChips);
    connect(grid_, &ChipGrid::cardClicked, &parts_.around.session, &ProjectSession::goToFrame);
}

void ObjectPictures::showChips() {
    if (!parts_.actions.active() || !chips_looked_at_) return;
    if (parts_.labels.selected()) {
        chips_->request(*parts_.labels.selected());
    } else {
        chips_->cancel();
        grid_->setCards({});
        pages_->setCurrentIndex(0);
    }
}

void ObjectPictures::takeChips(ObjectId id, const std::vector<LabelChip>& chips) {
    if (parts_.labels.selected() != id) return;
    std::vector<ChipCard> cards;
    const LabelledObject* object = parts_.labels.object(id);
    const QColor colour = object != nullptr ? ObjectColours(parts_.labels.annotations()).of(*object) : QColor();
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
    pages_->setCurrentWidget(grid_);
    grid_->setMarkedCard(parts_.around.session.currentFrame());
}

// ---- image stacks ---------------------------------------------------------------------------------------------------

void ObjectPictures::wireStacks() {
    whenAny(&parts_.labels, this, &ObjectPictures::showStack, &LabelSession::changed, &LabelSession::selectionChanged);
    const LabelActions& actions = parts_.actions;
    bindSwitches(this, {{actions.loupe,
                         [this](bool shown) {
                             parts_.tool.setLoupeShown(shown);
                             showStack();
                         }},
                        {actions.stack_loupe, [this](bool shown) {
                             parts_.tool.setStackShown(shown);
                             showStack();
                         }}});
    connect(stacks_, &LabelStacks::ready, this, &ObjectPictures::takeStack);
}

void ObjectPictures::showStack() {
    const LabelActions& actions = parts_.actions;
    const bool wanted = actions.active() && actions.loupe->isChecked() && actions.stack_loupe->isChecked();
    if (wanted && parts_.labels.selected())
        stacks_->request(*parts_.labels.selected(), parts_.around.session.viewFrame().index);
    else
        stacks_->cancel();
}

void ObjectPictures::takeStack(ObjectId id, const ObjectStack& stack) {
    LoupeStack shown;
    shown.object = id;
    shown.frame = stack.frame;
    shown.area = stack.area;
    if (!stack.stacked.empty()) shown.image = wrapImage(stack.stacked);
    shown.layers = stack.layers;
    if (stack.stacked.empty())
        shown.missing = stack.layers < 2
                            ? tr("No stack yet: it needs three frames that show the object")
                            : tr("No stack yet: it needs three frames that look alike, there are %1").arg(stack.layers);
    parts_.tool.setStack(std::move(shown));
}

}  // namespace eyrie::ui

#include "moc_object_pictures.cpp"
