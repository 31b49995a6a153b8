#include "review/mosaic/mosaic_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QSplitter>
#include <QStackedLayout>
#include <QVBoxLayout>
#include <algorithm>
#include <limits>
#include <utility>

#include "canvas/overlay_settings.h"
#include "core/time/time_text.h"
#include "review/mosaic/coverage_legend.h"
#include "review/mosaic/mosaic_view.h"
#include "review/watch/watched_ground.h"
#include "widgets/display_text.h"
#include "widgets/empty_state.h"
#include "widgets/wiring.h"
#include "workspace/first_step.h"
#include "workspace/session_reactions.h"

namespace eyrie::ui {

namespace {

constexpr int kFrameRole = Qt::UserRole;
constexpr int kTrackRole = Qt::UserRole + 1;
constexpr double kMarginInView = 3;  ///< px around a click that are meant

QLabel* quietLine(QWidget* parent) {
    auto* label = new QLabel(parent);
    label->setWordWrap(true);
    label->setContentsMargins(6, 2, 6, 2);
    return label;
}

}  // namespace

MosaicPanel::MosaicPanel(const MosaicParts& parts, QWidget* parent)
    : QWidget(parent), parts_(parts), maker_([this](const QString& message) { fail(message); }) {
    empty_ = new EmptyState;
    buildBar();
    place_ = quietLine(this);
    view_ = new MosaicView([this](QPointF place) { askAbout(place); });
    list_ = new QListWidget;
    list_->setAccessibleName(tr("What happened at the place"));
    list_->setUniformItemSizes(true);
    auto* below = new QWidget;
    auto* below_rows = new QVBoxLayout(below);
    below_rows->setContentsMargins(0, 0, 0, 0);
    below_rows->setSpacing(0);
    below_rows->addWidget(place_);
    below_rows->addWidget(list_, 1);
    auto* split = new QSplitter(Qt::Vertical);
    split->addWidget(view_);
    split->addWidget(below);
    split->setStretchFactor(0, 3);
    split->setStretchFactor(1, 2);
    split->setChildrenCollapsible(false);
    auto* shown = new QWidget;
    auto* rows = new QVBoxLayout(shown);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    rows->addWidget(bar_);
    rows->addWidget(legend_);
    rows->addWidget(split, 1);
    stack_ = new QStackedLayout(this);
    stack_->addWidget(empty_);
    stack_->addWidget(shown);

    whenAny(&parts_.ground, this, &MosaicPanel::makeIfWanted, &WatchedGround::changed);
    whenAny(&maker_, this, &MosaicPanel::showMosaic, &MosaicMaker::changed);
    whenAny(
        list_, this, [this] { activate(list_->currentRow()); }, &QListWidget::itemActivated, &QListWidget::itemClicked);
    whenAny(
        &parts_.overlays, this, [this] { view_->setColours(parts_.overlays.style().colours); },
        &OverlaySettings::changed);
    followSession(parts_.session, this,
                  {{SessionChange::picture, [this] { showFrame(); }},
                   {SessionChange::selection, [this] { view_->setSelectedTrack(parts_.session.selectedTrack()); }},
                   {{SessionChange::video, SessionChange::current_run, SessionChange::run_data,
                     SessionChange::run_preparing, SessionChange::run_started, SessionChange::run_ended},
                    [this] { explainNothing(); }}});
    view_->setColours(parts_.overlays.style().colours);
    explainNothing();
    showMosaic();
}

MosaicPanel::~MosaicPanel() = default;

void MosaicPanel::buildBar() {
    bar_ = new QWidget(this);
    header_ = quietLine(bar_);
    coverage_ = new QComboBox(bar_);
    coverage_->addItems({tr("No coverage"), tr("How long seen"), tr("When last seen")});
    coverage_->setAccessibleName(tr("Coverage in time"));
    coverage_->setToolTip(
        tr("Tints the ground by how long, or when last, each place was in the picture. Frames that could not be "
           "searched do not count: ground seen in those alone is not tinted."));
    legend_ = new CoverageLegend(this);
    legend_->hide();
    auto* row = new QHBoxLayout(bar_);
    row->setContentsMargins(2, 2, 2, 2);
    row->addWidget(coverage_);
    row->addWidget(header_, 1);
    onEdited(this, &MosaicPanel::showCoverage, coverage_);
}

void MosaicPanel::setLookedAt(bool looked_at) {
    looked_at_ = looked_at;
    if (looked_at) makeIfWanted();
}

void MosaicPanel::makeIfWanted() {
    const auto& ground = parts_.ground.ground();
    const bool something = made_of_ || maker_.mosaic() || !failure_.isEmpty();
    if (something && made_of_ != ground) {
        made_of_.reset();
        failure_.clear();
        place_query_.cancel();
        maker_.clear();
    }
    if (!looked_at_ || !ground || made_of_ == ground || !parts_.session.media()) return;
    made_of_ = ground;
    empty_->setTexts(tr("The ground is being laid out…"));
    maker_.make(ground, *parts_.session.media());
}

void MosaicPanel::fail(const QString& message) {
    // Tried again once somebody looks again.
    made_of_.reset();
    failure_ = tr("The ground could not be laid out: %1").arg(message);
    showMosaic();
}

void MosaicPanel::explainNothing() {
    if (maker_.mosaic() || made_of_) return;
    if (!failure_.isEmpty()) {
        empty_->setTexts(failure_);
        return;
    }
    empty_->setTexts(afterFirstStep(
        parts_.session,
        tr("The ground that a run saw is laid out here once it has finished, with the paths of all tracks. Click a "
           "place to see when it was in the picture and which tracks crossed it.")));
}

QString MosaicPanel::headerText() const {
    return header_->text();
}

void MosaicPanel::showMosaic() {
    const auto& mosaic = maker_.mosaic();
    stack_->setCurrentIndex(mosaic && !mosaic->pictures.empty() ? 1 : 0);
    if (!mosaic) {
        view_->show(nullptr, -1);
        list_->clear();
        place_->clear();
        explainNothing();
        return;
    }
    showFrame();
}

void MosaicPanel::showFrame() {
    const auto& mosaic = maker_.mosaic();
    if (!mosaic) return;
    const FrameIndex frame = parts_.session.shownFrame();
    const int here = mosaic->sheets->sheetOf(frame);
    const int sheet = here >= 0 ? here : std::max(0, view_->sheet());
    if (sheet != view_->sheet()) {
        list_->clear();
        place_->setText(tr("Click a place to see when it was in the picture and which tracks crossed it."));
    }
    view_->show(mosaic, sheet);
    view_->setFrame(frame);
    QStringList texts;
    const int count = mosaic->sheets->count();
    if (count > 1) texts << tr("Ground %1 of %2").arg(sheet + 1).arg(count);
    if (!failure_.isEmpty())
        texts << failure_;
    else if (mosaic->share < 1)
        texts << tr("%1 % laid out").arg(static_cast<int>(100 * mosaic->share));
    header_->setText(texts.join(QStringLiteral(" · ")));
    showCoverage();
    header_->setToolTip(count > 1
                            ? tr("A new ground begins where frames could not be registered; the one shown is that "
                                 "of the frame.")
                            : QString());
}

// ---- coverage in time -----------------------------------------------------------------------------------------------

void MosaicPanel::showCoverage() {
    view_->setCoverage(static_cast<CoverageLook>(coverage_->currentIndex()));
    const QStringList times = coverageTimes();
    legend_->setTimes(times);
    legend_->setVisible(!times.isEmpty());
}

QStringList MosaicPanel::coverageTimes() const {
    const SheetCoverage* covered = view_->coverage();
    const auto look = static_cast<CoverageLook>(coverage_->currentIndex());
    if (covered == nullptr || look == CoverageLook::none) return {};
    if (covered->frames.last < covered->frames.first) return {tr("Nothing here was searched")};
    QStringList times;
    for (const double share : {0.0, 0.5, 1.0})
        times << (look == CoverageLook::seen_for ? durationText(secondsAtShare(*covered, share))
                                                 : timeOf(frameAtShare(*covered, share)));
    times.removeDuplicates();
    return times;
}

// ---- a place --------------------------------------------------------------------------------------------------------

void MosaicPanel::setClock(ClockOfFrames clock) {
    clock_ = std::move(clock);
    showCoverage();
    if (asked_ && list_->count() > 0) askAbout(*asked_);
}

QString MosaicPanel::timeOf(FrameIndex frame) const {
    const double seconds = maker_.mosaic()->ground->run->secondsOf(frame);
    return clock_.timeOr(frame, QString::fromStdString(videoClockText(seconds)));
}

void MosaicPanel::askAbout(QPointF on_sheet) {
    const auto mosaic = maker_.mosaic();
    if (!mosaic) return;
    const int sheet = view_->sheet();
    asked_ = on_sheet;
    view_->setPlace(on_sheet);
    const double margin = kMarginInView * view_->unitsPerPx();
    place_query_.ask([this, mosaic, sheet, on_sheet, margin](const BackgroundTask& task) {
        const PlaceHistory history =
            placeHistory(*mosaic->sheets, mosaic->ground->run->tracks, sheet, {on_sheet.x(), on_sheet.y()}, margin);
        task.tell([this, sheet, history] { showHistory(sheet, history); });
    });
}

void MosaicPanel::showHistory(int sheet, const PlaceHistory& history) {
    if (sheet != view_->sheet() || !maker_.mosaic()) return;
    list_->clear();
    const StoredTracks& run = *maker_.mosaic()->ground->run;
    double seconds = 0;
    const auto add = [&](const QString& text, FrameIndex frame, TrackId track) {
        auto* item = new QListWidgetItem(text, list_);
        item->setData(kFrameRole, frame);
        item->setData(kTrackRole, track);
        item->setToolTip(clock_.text(frame));
    };
    // In time: when it came into sight, and who came meanwhile.
    auto passage = history.passed.begin();
    const auto add_passages = [&](FrameIndex until) {
        for (; passage != history.passed.end() && passage->frames.first <= until; ++passage)
            add(tr("    %1   track %2").arg(timeOf(passage->frames.first)).arg(passage->track), passage->frames.first,
                passage->track);
    };
    for (const FrameSpan& span : history.seen) {
        seconds += run.secondsOf(span.last) - run.secondsOf(span.first) + 1 / run.footage.scale.frame_rate_hz;
        add(tr("seen %1 – %2").arg(timeOf(span.first), timeOf(span.last)), span.first, 0);
        add_passages(span.last);
    }
    add_passages(std::numeric_limits<FrameIndex>::max());
    const QString seen = history.seen.size() == 1
                             ? tr("Seen once, for %1").arg(durationText(seconds))
                             : tr("Seen %1 times, %2 in all").arg(history.seen.size()).arg(durationText(seconds));
    const QString crossed = history.passed.empty()       ? tr("no track crossed it")
                            : history.passed.size() == 1 ? tr("crossed once")
                                                         : tr("crossed %1 times").arg(history.passed.size());
    place_->setText(history.seen.empty() ? tr("This place was never in the picture.")
                                         : QStringLiteral("%1; %2.").arg(seen, crossed));
}

void MosaicPanel::activate(int row) {
    const QListWidgetItem* item = list_->item(row);
    if (item == nullptr) return;
    const int track = item->data(kTrackRole).toInt();
    parts_.session.playback().pause();
    if (track != 0) parts_.session.selectTrack(track);
    parts_.session.goToFrame(item->data(kFrameRole).toInt());
}

}  // namespace eyrie::ui

#include "moc_mosaic_panel.cpp"
