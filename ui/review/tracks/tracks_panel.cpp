#include "review/tracks/tracks_panel.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QMenu>
#include <QScrollBar>
#include <QSlider>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

#include "review/tracks/filter_chips.h"
#include "widgets/empty_state.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

constexpr int kFollowNow_ms = 200;

}  // namespace

TracksPanel::TracksPanel(TracksModel* model, QWidget* parent)
    : TablePanel(model, QStringLiteral("tracks"), parent),
      tracks_(model),
      tentative_(new QToolButton(this)),
      sensitivity_(new QSlider(Qt::Horizontal, this)),
      count_(new QLabel(this)),
      chips_(new FilterChips(this)),
      now_due_(kFollowNow_ms, [this] { filterTracks(); }) {
    table()->setAccessibleName(tr("Tracks"));
    emptyState()->setTexts(aboutText());
    tentative_->setText(tr("Tentative"));
    tentative_->setCheckable(true);
    tentative_->setToolTip(tr("Also list tracks that were never confirmed and are not part of the result"));
    toolRow()->addWidget(tentative_);
    sensitivity_->setRange(0, 100);
    sensitivity_->setValue(100);
    sensitivity_->setPageStep(10);
    sensitivity_->setFixedWidth(90);
    sensitivity_->setAccessibleName(tr("Sensitivity"));
    sensitivity_->setToolTip(
        tr("Sensitivity: on the left, only tracks that are surely moving vehicles are listed and drawn; on the far "
           "right, all tracks, those that the run left out for their score, too. Exports and events keep to the score "
           "that the run asks for."));
    count_->setToolTip(tr("Tracks listed, of all tracks"));
    toolRow()->addWidget(sensitivity_);
    auto* narrowing = new QHBoxLayout;
    narrowing->setContentsMargins(2, 0, 4, 0);
    narrowing->addWidget(chips_, 1);
    count_->setFixedHeight(chips_->minimumSizeHint().height());  // beside the first row of chips
    narrowing->addWidget(count_, 0, Qt::AlignTop);
    static_cast<QVBoxLayout*>(layout())->insertLayout(1, narrowing);
    connect(chips_, &FilterChips::edited, this, &TracksPanel::useFilter);
    connect(chips_, &FilterChips::doingsWanted, this, [this] { commands_.want_doings(); });
    onEdited(this, &TracksPanel::useSensitivity, sensitivity_);
    whenAny(
        model, this,
        [this] {
            chips_->setScale(tracks_->scale());
            chips_->setClockKnown(tracks_->clock().known());
            if (chips_->filter().time.ofDay()) filterTracks();  // maybe by another clock
        },
        &QAbstractItemModel::modelReset, &QAbstractItemModel::rowsInserted, &QAbstractItemModel::headerDataChanged);
    whenAny(model, this, &TracksPanel::tellQuery, &QAbstractItemModel::modelReset, &QAbstractItemModel::rowsInserted,
            &QAbstractItemModel::rowsRemoved, &QAbstractItemModel::dataChanged);
    whenAny(model, this, &TracksPanel::showCount, &QAbstractItemModel::dataChanged, &QAbstractItemModel::rowsRemoved);
    whenAny(&proxy(), this, &TracksPanel::showCount, &QAbstractItemModel::modelReset, &QAbstractItemModel::rowsInserted,
            &QAbstractItemModel::rowsRemoved, &TableSortProxy::filtered);
    onEdited(this, &TracksPanel::filterTracks, tentative_);
    hideAtFirst({TracksModel::lowest_column, TracksModel::highest_column, TracksModel::stood_column},
                TracksModel::speed_column);
    hideAtFirst({TracksModel::picture_column}, TracksModel::id_column);
    // Left over from a day that ended with such a list.
    table()->setColumnHidden(TracksModel::like_column, true);
    if (table()->horizontalHeader()->sortIndicatorSection() == TracksModel::like_column)
        table()->sortByColumn(TracksModel::id_column, Qt::AscendingOrder);
    setTentativeShown(false);
}

QString TracksPanel::aboutText() {
    return tr("The tracks of a run are listed here: one row for each moving vehicle, with its life, speed and size.");
}

int TracksPanel::placeOf(double score) const {
    return sensitivity_->maximum() - static_cast<int>(std::lround(score * 100));
}

void TracksPanel::setThreshold(double score) {
    if (score == threshold_) return;
    const bool untouched = sensitivity_->value() == placeOf(threshold_);
    threshold_ = score;
    if (!untouched) return;
    if (sensitivity_->value() == placeOf(score))
        useSensitivity();  // the same place stands for another score
    else
        sensitivity_->setValue(placeOf(score));
}

double TracksPanel::minScore() const {
    // The run's own threshold need not be a whole percent.
    if (sensitivity_->value() == placeOf(threshold_)) return threshold_;
    return (sensitivity_->maximum() - sensitivity_->value()) / 100.0;
}

void TracksPanel::useSensitivity() {
    keepPlace([this] { tracks_->setLeastScore(minScore()); });
    filterTracks();
    commands_.use_min_score(minScore());
}

bool TracksPanel::isOfTheRun(const TrackSummary& track) const {
    // Nobody shall wonder where a track is that was rejected.
    if (isRejected(track)) return true;
    // What the run left out counts once it is asked for.
    if (track.doubtful) return track.score >= minScore();
    return tentative_->isChecked() || track.confirmed;
}

bool TracksPanel::isListed(const TrackSummary& track) const {
    return isOfTheRun(track) && track.score >= minScore() && chips_->filter().holds(track, tracks_->scale(), facts());
}

TrackFacts TracksPanel::facts() const {
    return {.doings = doings_.get(), .likeness = likeness_.get(), .frame_of_day = frame_of_day_, .now = shown_frame_};
}

void TracksPanel::setShownFrame(FrameIndex frame) {
    if (shown_frame_ == frame) return;
    shown_frame_ = frame;
    if (chips_->filter().asksNow() && !now_due_.pending()) now_due_.start();
}

void TracksPanel::filterTracks() {
    frame_of_day_ = remembering(tracks_->clock().frame_of_day);
    proxy().setRowFilter([this](int row) {
        const TrackSummary* track = tracks_->recordAt(row);
        return track != nullptr && isListed(*track);
    });
}

QString TracksPanel::countText() const {
    int all = 0, rejected = 0;
    for (int row = 0; row < tracks_->rowCount(); ++row) {
        const TrackSummary& track = *tracks_->recordAt(row);
        rejected += isRejected(track) ? 1 : 0;
        all += isOfTheRun(track) && !isRejected(track) ? 1 : 0;
    }
    const auto& shown = static_cast<const TableSortProxy&>(*table()->model());
    int listed = shown.rowCount();
    for (int row = 0; rejected > 0 && row < shown.rowCount(); ++row) {
        const TrackSummary* track = tracks_->recordAt(shown.mapToSource(shown.index(row, 0)).row());
        listed -= track != nullptr && isRejected(*track) ? 1 : 0;
    }
    const QString counted = all == 1 ? tr("%1 of 1 track").arg(listed)
                                     : tr("%1 of %2 tracks").arg(QLocale().toString(listed), QLocale().toString(all));
    return rejected == 0 ? counted : tr("%1, %2 rejected").arg(counted).arg(rejected);
}

void TracksPanel::showCount() {
    if (proxy().filtering()) return;  // it is counted at the end
    count_->setText(countText());
}

void TracksPanel::setDoings(const std::shared_ptr<const DoingsByTrack>& doings) {
    if (doings_ == doings) return;
    doings_ = doings;
    chips_->setDoings(doings);
    if (chips_->filter().any()) filterTracks();
    tracks_->setDoings(doings);  // tells that the query is another, too
}

std::shared_ptr<const TrackQuery> TracksPanel::query() const {
    if (!chips_->filter().any()) return nullptr;
    return std::make_shared<const TrackQuery>(chips_->filter(), tracks_->tracks(), tracks_->scale(),
                                              TrackQuery::Known{doings_, likeness_}, tracks_->clock().frame_of_day);
}

void TracksPanel::tellQuery() {
    const bool any = chips_->filter().any();
    if (!std::exchange(told_query_, any) && !any) return;
    commands_.query_changed();
}

// ---- tracks like one ------------------------------------------------------------------------------------------------

void TracksPanel::listLike(std::optional<TrackId> track) {
    chips_->setLike(track);
}

void TracksPanel::useFilter() {
    const auto& limit = chips_->filter().like;
    const std::optional<TrackId> like = limit ? std::optional(limit->track) : std::nullopt;
    const LikenessChoice counts = limit ? limit->counts : LikenessChoice();
    const bool counts_differ = std::exchange(like_counts_, counts) != counts;
    if (like != like_) {
        const bool ordered = like_.has_value();
        like_ = like;
        from_the_top_ = like.has_value();
        setLikeness(nullptr);
        if (ordered != like.has_value()) orderByLikeness(like.has_value());
        commands_.want_likeness(like);
    } else if (like && counts_differ) {
        commands_.want_likeness(like);  // what is listed stays until it is known
    }
    filterTracks();
    tellQuery();
}

void TracksPanel::setLikeness(const std::shared_ptr<const LikenessByTrack>& likeness) {
    if (likeness_ == likeness || (likeness && likeness->chosen != like_)) return;
    likeness_ = likeness;
    filterTracks();
    tracks_->setLikeness(likeness);  // tells that the query is another, too
    if (!likeness || !std::exchange(from_the_top_, false)) return;
    table()->scrollToTop();
    table()->horizontalScrollBar()->setValue(0);
}

void TracksPanel::orderByLikeness(bool wanted) {
    const QHeaderView* header = table()->horizontalHeader();
    table()->setColumnHidden(TracksModel::like_column, !wanted);
    if (wanted) {
        placeBeside(TracksModel::like_column, TracksModel::id_column);  // the others may not all be in view
        order_before_like_ = {header->sortIndicatorSection(), header->sortIndicatorOrder()};
        table()->sortByColumn(TracksModel::like_column, Qt::DescendingOrder);
    } else if (header->sortIndicatorSection() == TracksModel::like_column) {
        table()->sortByColumn(order_before_like_.first, order_before_like_.second);
    }
}

// ---- what is hidden -------------------------------------------------------------------------------------------------

QString TracksPanel::hiddenText() const {
    return tr("None of the %1 tracks passes these filters.").arg(tracks_->rowCount());
}

void TracksPanel::showHidden() {
    chips_->clear();
    sensitivity_->setValue(placeOf(threshold_));
}

void TracksPanel::setTentativeShown(bool shown) {
    tentative_->setChecked(shown);
    filterTracks();
}

void TracksPanel::activate(int track, int column) {
    const TrackSummary* summary = tracks_->recordAt(tracks_->rowOf(track));
    if (summary == nullptr) return;
    commands_.go_to(track, column == TracksModel::last_column ? summary->last_frame : summary->first_frame);
}

void TracksPanel::fillMenu(QMenu& menu, int track) {
    menu.addAction(tr("Go to its first frame"), this, [this, track] { activate(track, TracksModel::first_column); });
    menu.addAction(tr("Go to its last frame"), this, [this, track] { activate(track, TracksModel::last_column); });
    menu.addSeparator();
    menu.addActions(menu_actions_);
}

}  // namespace eyrie::ui

#include "moc_tracks_panel.cpp"
