#include "tune/inspect/stacks_panel.h"

#include <QCheckBox>
#include <QLabel>
#include <QStackedLayout>
#include <QVBoxLayout>
#include <algorithm>

#include "tune/inspect/stage_chips.h"
#include "widgets/empty_state.h"
#include "widgets/wiring.h"
#include "workspace/first_step.h"

namespace eyrie::ui {

StacksPanel::StacksPanel(ProjectSession& session, Inspection& inspection, QWidget* parent)
    : QWidget(parent), session_(session), inspection_(inspection) {
    summary_ = new QLabel(this);
    summary_->setForegroundRole(QPalette::PlaceholderText);
    summary_->setWordWrap(true);
    summary_->setContentsMargins(8, 4, 8, 2);
    whole_area_ = new QCheckBox(tr("Whole stack area"), this);
    whole_area_->setToolTip(tr("Show all that is stacked, not only the surroundings of the vehicle"));
    auto* options = new QVBoxLayout;
    options->setContentsMargins(8, 0, 8, 2);
    options->addWidget(whole_area_);
    empty_ = new EmptyState;
    grid_ = new ChipGrid;
    pages_ = new QStackedLayout;
    pages_->addWidget(empty_);
    pages_->addWidget(grid_);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(summary_);
    layout->addLayout(options);
    layout->addLayout(pages_, 1);

    whenChanged(inspection_, this,
                {{InspectionChange::choice, [this] { refresh(); }},
                 {InspectionChange::progress, [this] { showProgress(); }},
                 {InspectionChange::view, [this] { showView(inspection_.view()); }}});
    bindSwitches(this, {{whole_area_, [this] {
                             summary_->setText(tr("The stacks are being cut again…"));
                             want();
                         }}});
    bindCommands(this, {{empty_->button(), [this] { commands_.run_with_stacking(); }}});
    connect(grid_, &ChipGrid::cardClicked, this, [this](int id) {
        grid_->setMarkedCard(id);
        if (!view_) return;
        for (const StackView& stack : view_->stacks)
            if (stack.id == id) commands_.show_place({stack.pose.position.x, stack.pose.position.y});
    });
    refresh();
}

void StacksPanel::setLookedAt(bool looked_at) {
    looked_at_ = looked_at;
    want();
    refresh();
}

void StacksPanel::want() {
    if (!looked_at_) return inspection_.wantStacks(StackPictures::none);
    inspection_.wantStacks(whole_area_->isChecked() ? StackPictures::whole_area : StackPictures::surroundings);
}

QString StacksPanel::explanation() const {
    return pages_->currentWidget() == empty_ ? empty_->explanation() : QString();
}

bool StacksPanel::stackingOff() const {
    const auto& run = session_.runData();
    if (!run) return false;
    return !storedOptions(run->parameters).stacking.enabled;
}

void StacksPanel::refresh() {
    if (!looked_at_) return;
    QString why;
    QString action;
    if (!session_.currentRun()) {
        why =
            tr("An image stack lays one vehicle's pictures from many frames over each other: noise and background "
               "fade, the vehicle stays. Run the video first, or choose a run.");
    } else if (stackingOff()) {
        why =
            tr("This run used no image stacking. With it, a vehicle's pictures from up to 50 frames are laid over each "
               "other; noise and background fade, and the detector searches the stacked image.");
        action = tr("Run with stacking");
    } else if (session_.following()) {
        why = tr("To see stacks during the run, go to a frame that it has processed.");
    } else if (!inspection_.problem().isEmpty()) {
        why = inspection_.problem();
    } else if (!session_.viewFrame().result) {
        why = notProcessedText();
    }
    if (why.isEmpty()) {  // pictures that are shown stay until others come
        if (pages_->currentWidget() == empty_) empty_->setTexts(inspection_.waitingText());
        return;
    }
    empty_->setTexts(why, action);
    pages_->setCurrentWidget(empty_);
    summary_->clear();
    whole_area_->hide();
}

void StacksPanel::showProgress() {
    if (looked_at_) summary_->setText(inspection_.progressText());
}

void StacksPanel::showView(const std::shared_ptr<const ReplayView>& view) {
    if (!looked_at_ || view->wish.frame != session_.viewFrame().index || stackingOff()) return;
    if (view->wish.stacks == StackPictures::none) return;  // asked for by others
    view_ = view;
    const StackingOptions& options = view->options.stacking;
    const auto used =
        std::count_if(view->stacks.begin(), view->stacks.end(), [](const StackView& stack) { return stack.searched; });
    QString summary = tr("%1 stacks, %2 high enough to be searched (%3 of at most %4 layers)")
                          .arg(view->stacks.size())
                          .arg(used)
                          .arg(options.min_height)
                          .arg(options.capacity);
    if (!view->exact)
        summary += tr("\nThe replay began later than the run, so they may differ slightly from the run's.");
    summary_->setText(summary);
    if (view->stacks.empty()) {
        empty_->setTexts(tr("No stack in this frame: they begin with the detections of the frame before."));
        pages_->setCurrentWidget(empty_);
        return;
    }
    whole_area_->show();
    grid_->setCards(stackChips(*view));
    pages_->setCurrentWidget(grid_);
}

}  // namespace eyrie::ui

#include "moc_stacks_panel.cpp"
