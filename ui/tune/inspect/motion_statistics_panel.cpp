#include "tune/inspect/motion_statistics_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QStackedLayout>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "widgets/display_text.h"
#include "widgets/empty_state.h"
#include "widgets/wiring.h"
#include "workspace/first_step.h"

namespace eyrie::ui {

namespace {

// Darker than in the canvas, so that they read on light ground too.
const QColor kVectorColour(214, 178, 0);
const QColor kTrackColour(52, 168, 83);

/// The smallest of 1, 2, 5 × 10ⁿ that is at least this.
double roundWidth(double least) {
    const double power = std::pow(10.0, std::floor(std::log10(std::max(1e-6, least))));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= least * (1 - 1e-9)) return factor * power;
    return 10 * power;
}

QLabel* titleLabel(QWidget* parent) {
    auto* label = new QLabel(parent);
    label->setWordWrap(true);
    label->setContentsMargins(8, 4, 8, 0);
    return label;
}

}  // namespace

HistogramData speedHistogramOf(std::vector<double> speeds, const SceneScale& scale, int most_bins) {
    HistogramData data;
    data.value_label = QObject::tr("speed (%1)").arg(speedUnit(scale));
    data.count_label = QObject::tr("motion vectors");
    for (double& speed : speeds) speed = shownSpeed(speed, scale);
    HistogramData::Series series{data.count_label, kVectorColour, {}};
    if (!speeds.empty()) {
        // A single wild vector must not press all others into one bin.
        if (!std::is_sorted(speeds.begin(), speeds.end())) std::sort(speeds.begin(), speeds.end());
        const double usual = speeds[(speeds.size() - 1) * 98 / 100] * 1.2;
        data.bin_width = roundWidth(std::max(usual, 1e-3) / most_bins);
        const auto last = static_cast<std::size_t>(std::ceil(usual / data.bin_width));
        series.counts.assign(last + 1, 0);
        for (const double speed : speeds)
            ++series.counts[std::min(last, static_cast<std::size_t>(speed / data.bin_width))];
    }
    data.series.push_back(std::move(series));
    return data;
}

MotionStatisticsPanel::MotionStatisticsPanel(ProjectSession& session, QWidget* parent)
    : QWidget(parent), session_(session) {
    empty_ = new EmptyState;
    empty_->setTexts(
        tr("Shows how fast the independently moving corners are and how long they last. Run the video "
           "first, or choose a run."));
    auto* charts = new QWidget;
    scope_ = new QComboBox(charts);
    scope_->addItems({tr("Motion vectors of the frame shown"), tr("Motion vectors of the whole run")});
    scope_->setAccessibleName(tr("Motion vectors that are counted"));
    speed_title_ = titleLabel(charts);
    speeds_ = new HistogramChart(charts);
    life_title_ = titleLabel(charts);
    life_title_->setToolTip(tr("A motion vector belongs to a track while it lies in the track's box"));
    lives_ = new HistogramChart(charts);
    auto* rows = new QVBoxLayout(charts);
    rows->setContentsMargins(0, 0, 0, 0);
    auto* first = new QHBoxLayout;
    first->setContentsMargins(8, 6, 8, 0);
    first->addWidget(scope_);
    first->addStretch(1);
    rows->addLayout(first);
    rows->addWidget(speed_title_);
    rows->addWidget(speeds_, 1);
    rows->addWidget(life_title_);
    rows->addWidget(lives_, 1);
    rows->addStretch();  // where no chart is shown the texts stay at the top
    pages_ = new QStackedLayout(this);
    pages_->addWidget(empty_);
    pages_->addWidget(charts);

    onEdited(this, &MotionStatisticsPanel::showFrame, scope_);
    whenChanged(session_, this,
                {{SessionChange::picture, [this] { showFrame(); }},
                 {SessionChange::run_data, [this] { readLives(); }},
                 {SessionChange::current_run, [this] {
                      read_of_.reset();
                      counted_.reset();
                      showFrame();
                  }}});
    connect(&reader_, &VectorLifetimesReader::readDone, this,
            [this](int run_id, const std::shared_ptr<const VectorLifeCounter>& lives) {
                if (session_.currentRun() != run_id) return;
                counted_ = lives;
                showFrame();
            });
    connect(&reader_, &VectorLifetimesReader::failed, life_title_, &QLabel::setText);
}

QString MotionStatisticsPanel::speedTitle() const {
    return speed_title_->text();
}

QString MotionStatisticsPanel::lifeTitle() const {
    return life_title_->text();
}

void MotionStatisticsPanel::showWholeRun(bool whole) {
    scope_->setCurrentIndex(whole ? 1 : 0);
}

bool MotionStatisticsPanel::wholeRun() const {
    return scope_->currentIndex() == 1;
}

void MotionStatisticsPanel::setLookedAt(bool looked_at) {
    looked_at_ = looked_at;
    showFrame();
    readLives();
}

void MotionStatisticsPanel::readLives() {
    // While a run works its lists are read every other second; its lives are read once it has ended.
    if (!looked_at_ || !session_.runData() || session_.running() || read_of_ == session_.runData()) return;
    read_of_ = session_.runData();
    life_title_->setText(tr("<b>Life</b>: reading the motion vectors of the run…"));
    reader_.read({session_.project(), read_of_->record.id});
}

void MotionStatisticsPanel::showFrame() {
    if (!looked_at_) return;
    pages_->setCurrentIndex(session_.currentRun() ? 1 : 0);
    if (wholeRun() && counted_ && shown_run_ == counted_) return;  // another frame changes nothing
    shown_run_ = wholeRun() ? counted_ : nullptr;
    showSpeeds();
    showLives();
    // Axes without anything between them say nothing.
    for (HistogramChart* chart : {speeds_, lives_}) chart->setVisible(!chart->data().series.empty());
}

void MotionStatisticsPanel::showSpeeds() {
    const ViewFrame& frame = session_.viewFrame();
    if (wholeRun() ? !counted_ : !frame.result) {
        speed_title_->setText(wholeRun() ? tr("<b>Speed</b>: reading the motion vectors of the run…")
                                         : notProcessedText());
        speeds_->setData({});
        return;
    }
    std::vector<double> speeds;
    if (wholeRun()) {
        speeds.assign(counted_->speeds().begin(), counted_->speeds().end());
    } else {
        for (const MotionVector& vector : frame.result->motion.motion_vectors) {
            if (vector.isInferred()) continue;
            speeds.push_back(
                std::hypot(static_cast<double>(vector.velocity.x), static_cast<double>(vector.velocity.y)));
        }
    }
    if (speeds.empty()) {
        speed_title_->setText(wholeRun() ? tr("The run has no motion vectors: nothing moved.")
                                         : tr("Frame %1 has no motion vectors: nothing moves.").arg(frame.index));
        speeds_->setData({});
        return;
    }
    const auto count = static_cast<double>(speeds.size());
    const SceneScale scale = wholeRun() ? session_.scale() : frame.scale;
    const QString mean = speedText(std::accumulate(speeds.begin(), speeds.end(), 0.0) / count, scale);
    const QString number = QLocale().toString(count, 'f', 0);
    speed_title_->setText(
        wholeRun()
            ? tr("<b>Speed</b> of the %1 motion vectors of all frames, mean %2").arg(number, mean)
            : tr("<b>Speed</b> of the %1 motion vectors of frame %2, mean %3").arg(number).arg(frame.index).arg(mean));
    speeds_->setData(speedHistogramOf(std::move(speeds), scale));
}

void MotionStatisticsPanel::showLives() {
    const auto& result = session_.viewFrame().result;
    if (!counted_ || (!wholeRun() && !result)) {
        lives_->setData({});
        if (!read_of_) life_title_->clear();
        return;
    }
    const VectorLifetimes lives = wholeRun() ? counted_->lives() : counted_->livesOf(result->motion.motion_vectors);
    if (lives.vectors == 0) {
        lives_->setData({});
        life_title_->clear();
        return;
    }
    life_title_->setText((wholeRun() ? tr("<b>Life</b> of the %1 motion vectors of the run, mean %2 frames; those in a "
                                          "track stay in it for %3 frames")
                                     : tr("<b>Life</b> in the run of the %1 motion vectors of this frame, mean %2 "
                                          "frames; those in a track stay in it for %3 frames"))
                             .arg(QLocale().toString(lives.vectors))
                             .arg(numberText(lives.mean_life, 1))
                             .arg(numberText(lives.mean_association, 1)));
    HistogramData histogram;
    histogram.value_label = tr("frames");
    histogram.count_label = tr("motion vectors");
    histogram.logarithmic = true;
    const auto bins = static_cast<int>(std::max(lives.life.size(), lives.association.size()));
    for (int bin = 0; bin < bins; ++bin) histogram.bins << lifeBinText(bin);
    histogram.series.push_back({tr("life"), kVectorColour, {lives.life.begin(), lives.life.end()}});
    histogram.series.push_back({tr("in a track"), kTrackColour, {lives.association.begin(), lives.association.end()}});
    lives_->setData(std::move(histogram));
}

}  // namespace eyrie::ui

#include "moc_motion_statistics_panel.cpp"
