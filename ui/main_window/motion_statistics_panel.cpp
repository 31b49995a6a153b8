#include "main_window/motion_statistics_panel.h"

#include <QLabel>
#include <QLocale>
#include <QStackedLayout>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "models/display_text.h"
#include "panels/empty_state.h"

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

HistogramData speedHistogram(const std::vector<MotionVector>& vectors, const SceneScale& scale, int most_bins) {
    HistogramData data;
    data.value_label = QObject::tr("speed (%1)").arg(speedUnit(scale));
    data.count_label = QObject::tr("motion vectors");
    std::vector<double> speeds;
    for (const MotionVector& vector : vectors)
        speeds.push_back(shownSpeed(
            std::hypot(static_cast<double>(vector.velocity.x), static_cast<double>(vector.velocity.y)), scale));
    HistogramData::Series series{data.count_label, kVectorColour, {}};
    if (!speeds.empty()) {
        // A single wild vector must not press all others into one bin.
        std::sort(speeds.begin(), speeds.end());
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
        tr("Here you see how fast the corners move that move by themselves, and how long they last. Run the video "
           "first, or choose a run."));
    auto* charts = new QWidget;
    speed_title_ = titleLabel(charts);
    speeds_ = new HistogramChart(charts);
    life_title_ = titleLabel(charts);
    life_title_->setToolTip(tr("A motion vector belongs to a track while it lies in the track's box"));
    lives_ = new HistogramChart(charts);
    auto* rows = new QVBoxLayout(charts);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->addWidget(speed_title_);
    rows->addWidget(speeds_, 1);
    rows->addWidget(life_title_);
    rows->addWidget(lives_, 1);
    pages_ = new QStackedLayout(this);
    pages_->addWidget(empty_);
    pages_->addWidget(charts);

    connect(&session_, &ProjectSession::viewFrameChanged, this, &MotionStatisticsPanel::showFrame);
    connect(&session_, &ProjectSession::runDataChanged, this, &MotionStatisticsPanel::readLives);
    connect(&session_, &ProjectSession::currentRunChanged, this, [this] {
        read_of_.reset();
        lives_->setData({});
        life_title_->clear();
        showFrame();
    });
    connect(&reader_, &VectorLivesReader::readDone, this,
            [this](int run_id, const std::shared_ptr<const VectorLives>& lives) {
                if (session_.currentRun() == run_id) showLives(*lives);
            });
    connect(&reader_, &VectorLivesReader::failed, life_title_, &QLabel::setText);
}

void MotionStatisticsPanel::setLookedAt(bool looked_at) {
    looked_at_ = looked_at;
    showFrame();
    readLives();
}

void MotionStatisticsPanel::showFrame() {
    if (!looked_at_) return;
    pages_->setCurrentIndex(session_.currentRun() ? 1 : 0);
    const ViewFrame& frame = session_.viewFrame();
    if (!frame.result) {
        speed_title_->setText(tr("The run has not done this frame."));
        speeds_->setData({});
        return;
    }
    const auto& vectors = frame.result->motion.motion_vectors;
    double sum = 0;
    for (const MotionVector& vector : vectors)
        sum += std::hypot(static_cast<double>(vector.velocity.x), static_cast<double>(vector.velocity.y));
    const QString mean =
        vectors.empty() ? QStringLiteral("–") : speedText(sum / static_cast<double>(vectors.size()), session_.scale());
    speed_title_->setText(tr("<b>Speed</b> of the %1 motion vectors of frame %2, mean %3")
                              .arg(QLocale().toString(static_cast<int>(vectors.size())))
                              .arg(frame.index)
                              .arg(mean));
    speeds_->setData(speedHistogram(vectors, session_.scale()));
}

void MotionStatisticsPanel::readLives() {
    // While a run works its lists are read every other second; its lives are read once it has ended.
    if (!looked_at_ || !session_.runData() || session_.running() || read_of_ == session_.runData()) return;
    read_of_ = session_.runData();
    life_title_->setText(tr("<b>Life</b>: reading the motion vectors of the run …"));
    reader_.read({session_.project(), read_of_->record.id});
}

void MotionStatisticsPanel::showLives(const VectorLives& lives) {
    life_title_->setText(tr("<b>Life</b> of the %1 motion vectors of the run, mean %2 frames; those of tracks belong "
                            "to one for %3 frames")
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
