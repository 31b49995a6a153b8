#include "tune/inspect/stages_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QStackedLayout>
#include <QToolButton>
#include <QVBoxLayout>

#include "tune/inspect/stage_chips.h"
#include "widgets/empty_state.h"
#include "widgets/wiring.h"
#include "workspace/first_step.h"

namespace eyrie::ui {

namespace {

QToolButton* button(const char* icon, const QString& tip, QWidget* parent) {
    auto* made = new QToolButton(parent);
    made->setIcon(QIcon::fromTheme(QString::fromLatin1(icon)));
    made->setToolTip(tip);
    made->setAccessibleName(tip);
    made->setAutoRaise(true);
    return made;
}

QString spelled(const char* word) {
    return QString::fromLatin1(word).replace(QLatin1Char('_'), QLatin1Char(' '));
}

}  // namespace

StagesPanel::StagesPanel(ProjectSession& session, Inspection& inspection, QWidget* parent)
    : QWidget(parent), session_(session), inspection_(inspection) {
    empty_ = new EmptyState;
    grid_ = new ChipGrid;
    pages_ = new QStackedLayout;
    pages_->addWidget(empty_);
    pages_->addWidget(grid_);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(buildHeader());
    layout->addLayout(pages_, 1);

    bindCommands(this, {{empty_->button(), [this] { inspection_.step(1); }}});
    whenChanged(inspection_, this,
                {{InspectionChange::choice, [this] { refresh(); }},
                 {InspectionChange::progress, [this] { showProgress(); }},
                 {InspectionChange::view, [this] { showView(inspection_.view()); }}});
    refresh();
}

QWidget* StagesPanel::buildHeader() {
    auto* header = new QWidget(this);
    title_ = new QLabel(header);
    QFont bold = title_->font();
    bold.setBold(true);
    title_->setFont(bold);
    back_ = button("go-previous", tr("Previous cluster of the frame"), header);
    on_ = button("go-next", tr("Next cluster of the frame"), header);
    auto* smaller = button("zoom-out", tr("Smaller pictures"), header);
    auto* fit = button("zoom-fit-best", tr("Fit the pictures"), header);
    auto* larger = button("zoom-in", tr("Larger pictures"), header);
    searches_ = new QComboBox(header);
    searches_->setToolTip(tr("Several stacks were searched for this cluster"));
    general_ = new QCheckBox(tr("General segmentation"), header);
    general_->setToolTip(
        tr("What superpixels, watershed, graph cut and gPb contours make of the search area (fig. 5.1)"));
    summary_ = new QLabel(header);
    summary_->setForegroundRole(QPalette::PlaceholderText);
    summary_->setWordWrap(true);

    auto* first = new QHBoxLayout;
    first->setSpacing(2);
    first->addWidget(back_);
    first->addWidget(title_);
    first->addWidget(on_);
    first->addStretch(1);
    first->addWidget(smaller);
    first->addWidget(fit);
    first->addWidget(larger);
    auto* second = new QHBoxLayout;
    second->addWidget(general_);
    second->addWidget(searches_, 1);
    second->addStretch(1);
    auto* rows = new QVBoxLayout(header);
    rows->setContentsMargins(6, 4, 6, 2);
    rows->setSpacing(3);
    rows->addLayout(first);
    rows->addWidget(summary_);
    rows->addLayout(second);

    bindCommands(this, {{back_, [this] { inspection_.step(-1); }},
                        {on_, [this] { inspection_.step(1); }},
                        {smaller, [this] { grid_->zoomBy(1 / 1.25); }},
                        {larger, [this] { grid_->zoomBy(1.25); }},
                        {fit, [this] { grid_->fit(); }}});
    onEdited(this, &StagesPanel::showSearch, searches_);
    bindSwitches(this, {{general_, [this](bool on) { inspection_.wantGeneralSegmentation(on); }}});
    return header;
}

void StagesPanel::setLookedAt(bool looked_at) {
    looked_at_ = looked_at;
    inspection_.wantStages(looked_at);
    refresh();
}

QString StagesPanel::explanation() const {
    return pages_->currentWidget() == empty_ ? empty_->explanation() : QString();
}

std::pair<QString, QString> StagesPanel::whyEmpty() const {
    const auto& result = session_.viewFrame().result;
    if (!session_.currentRun())
        return {tr("Shows each step of a detection, from the search area to the boxes. Run the video "
                   "first, or choose a run."),
                {}};
    if (session_.following()) return {tr("To see the steps during the run, go to a frame that it has processed."), {}};
    if (!inspection_.problem().isEmpty()) return {inspection_.problem(), {}};
    if (!result) return {notProcessedText(), {}};
    if (result->clusters.empty()) return {tr("Nothing moves in this frame: there are no motion clusters."), {}};
    if (!inspection_.hasChoice())
        return {tr("Click a cluster, a search area, a detection or a track in the picture to see each step that led to "
                   "its boxes."),
                tr("Show the first cluster")};
    if (!inspection_.cluster()) return {tr("The selection has no motion cluster in this frame."), {}};
    return {};
}

QString StagesPanel::summaryOf(const ReplayView& view) const {
    QStringList words;
    words << tr("Detection: %1").arg(spelled(nameOf(view.options.detection.method)));
    if (view.options.difference.method != MotionMethod::vectors)
        words << tr("motion: %1").arg(spelled(nameOf(view.options.difference.method)));
    words << (view.options.stacking.enabled ? tr("stacking on") : tr("stacking off"));
    QString text = words.join(QStringLiteral(" · "));
    if (!view.exact) text += tr("\nThe replay began later than the run, so stacks may differ slightly from the run's.");
    return text;
}

void StagesPanel::refresh() {
    const auto& result = session_.viewFrame().result;
    const auto cluster = inspection_.cluster();
    const bool any = result && !result->clusters.empty();
    back_->setEnabled(any);
    on_->setEnabled(any);
    if (any && cluster)
        title_->setText(tr("Cluster %1 of %2").arg(*cluster + 1).arg(result->clusters.size()));
    else
        title_->setText(any ? tr("%1 clusters").arg(result->clusters.size()) : tr("No cluster"));
    const auto [why, action] = whyEmpty();
    if (why.isEmpty() && pages_->currentWidget() == empty_)  // pictures that are shown stay until others come
        empty_->setTexts(inspection_.waitingText());
    const bool whole_frame = view_ && view_->differences && !cluster && view_->wish.frame == session_.viewFrame().index;
    general_->setVisible(result != nullptr);
    if (!why.isEmpty() && !whole_frame) {
        empty_->setTexts(why, action);
        pages_->setCurrentWidget(empty_);
        summary_->clear();
        searches_->hide();
    }
}

void StagesPanel::showProgress() {
    if (looked_at_) summary_->setText(inspection_.progressText());
}

void StagesPanel::showView(const std::shared_ptr<const ReplayView>& view) {
    if (!looked_at_ || view->wish.frame != session_.viewFrame().index) return;
    view_ = view;
    refresh();
    summary_->setText(summaryOf(*view));
    const QSignalBlocker blocker(searches_);
    const int before = searches_->currentIndex();
    searches_->clear();
    for (std::size_t i = 0; i < view->traces.size(); ++i)
        searches_->addItem(tr("Search %1 of %2").arg(i + 1).arg(view->traces.size()));
    searches_->setVisible(view->traces.size() > 1);
    searches_->setCurrentIndex(std::clamp(before, 0, std::max(0, searches_->count() - 1)));
    showSearch();
}

void StagesPanel::showSearch() {
    if (!view_) return;
    auto cards = view_->traces.empty()
                     ? differenceChips(*view_)
                     : stageChips(*view_, static_cast<std::size_t>(std::max(0, searches_->currentIndex())));
    if (cards.empty()) return;
    grid_->setCards(std::move(cards));
    pages_->setCurrentWidget(grid_);
}

}  // namespace eyrie::ui

#include "moc_stages_panel.cpp"
