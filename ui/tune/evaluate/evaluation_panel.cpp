#include "tune/evaluate/evaluation_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QScrollArea>
#include <QStackedWidget>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "store/runs/doubtful_tracks.h"
#include "tune/evaluate/evaluation_choices.h"
#include "tune/evaluate/evaluation_wording.h"
#include "widgets/charts/line_chart.h"
#include "widgets/charts/tracked_bar.h"
#include "widgets/display_text.h"
#include "widgets/empty_state.h"
#include "widgets/theme_colours.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

const QColor kFoundColour(46, 150, 80);
const QColor kMissedColour(222, 160, 20);
const QColor kFalseColour(214, 66, 54);
const QColor kRecallColour(45, 120, 200);

TrackedShare shareOf(const TruthTrackTally& object, Convention convention) {
    const auto rank = [&] {
        switch (trackedLife(object, convention)) {
            case TrackedLife::mostly:
                return TrackedShare::Rank::mostly;
            case TrackedLife::mostly_lost:
                return TrackedShare::Rank::mostly_lost;
            case TrackedLife::partially:
                break;
        }
        return TrackedShare::Rank::partially;
    };
    return {object.id, object.frames, object.matched, object.switches, fragmentsOf(object, convention), rank()};
}

}  // namespace

EvaluationPanel::EvaluationPanel(ProjectSession& session, EvaluationSession& evaluation, QWidget* parent)
    : QWidget(parent), session_(session), evaluation_(evaluation) {
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(2);
    choices_ = new EvaluationChoices(session_, evaluation_);
    rows->addWidget(choices_);
    pages_ = new QStackedWidget;
    empty_ = new EmptyState;
    pages_->addWidget(empty_);
    pages_->addWidget(buildResult());
    rows->addWidget(pages_, 1);

    bindCommands(this,
                 {{empty_->button(), [this] { commands_.label(); }}, {report_, [this] { commands_.write_report(); }}});
    whenAny(&evaluation_, this, &EvaluationPanel::refresh, &EvaluationSession::changed,
            &EvaluationSession::workingChanged);
    whenChanged(session_, this, {{SessionChange::frame, [this] {
                                      counts_->setMarker(session_.currentFrame());
                                      ratios_->setMarker(session_.currentFrame());
                                  }}});
    for (LineChart* chart : {counts_, ratios_})
        connect(chart, &LineChart::placeActivated, &session_,
                [this](double place) { session_.goToFrame(static_cast<FrameIndex>(std::lround(place))); });
    connect(tracked_, &TrackedBar::objectActivated, this, [this](int object) { commands_.go_to_object(object); });
    refresh();
}

void EvaluationPanel::useTruthFile(const QString& path) {
    choices_->useTruthFile(path);
}

// ---- result ---------------------------------------------------------------------------------------------------------

QWidget* EvaluationPanel::buildResult() {
    auto* content = new QWidget;
    headline_ = new QLabel;
    headline_->setWordWrap(true);
    headline_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    headline_->setToolTip(tr("Intervals: whole tracks resampled 2,000 times (bootstrap)"));
    remarks_ = new QLabel;
    remarks_->setWordWrap(true);
    table_ = new QTableWidget;
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setSelectionMode(QAbstractItemView::ContiguousSelection);
    table_->setAlternatingRowColors(true);
    table_->setShowGrid(false);
    table_->verticalHeader()->setDefaultSectionSize(table_->fontMetrics().height() + 5);
    table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
    table_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    table_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    table_->setFocusPolicy(Qt::ClickFocus);
    table_->setContextMenuPolicy(Qt::ActionsContextMenu);
    auto* copy = new QAction(tr("Copy the table as text"), table_);
    table_->addAction(copy);
    bindCommands(this, {{copy, [this] { copyTable(); }}});
    tracked_ = new TrackedBar;
    tracked_->setFixedHeight(110);
    counts_ = new LineChart;
    ratios_ = new LineChart;
    score_curve_ = new LineChart;
    score_curve_->setToolTip(tr(
        "Precision against recall as the score that a track must have grows, from right to left. Tracks that the run "
        "left out for their score are counted; the line is where its own threshold lies (finishing.min_score)."));
    curve_failure_ = new QLabel;
    curve_failure_->setWordWrap(true);
    curve_failure_->hide();
    for (LineChart* chart : {counts_, ratios_, score_curve_}) chart->setFixedHeight(190);
    report_ = new QToolButton;
    report_->setText(tr("Report…"));
    report_->setToolTip(tr("Write everything as one HTML or PDF file"));
    report_progress_ = new QProgressBar;
    report_progress_->hide();
    auto* report = new QHBoxLayout;
    report->addWidget(report_);
    report->addWidget(report_progress_, 1);
    report->addStretch(1);

    auto* rows = new QVBoxLayout(content);
    rows->setContentsMargins(6, 2, 6, 6);
    rows->addWidget(headline_);
    rows->addWidget(remarks_);
    rows->addWidget(tracked_);
    rows->addWidget(table_);
    rows->addWidget(counts_);
    rows->addWidget(ratios_);
    rows->addWidget(score_curve_);
    rows->addWidget(curve_failure_);
    rows->addLayout(report);
    rows->addStretch(1);
    auto* scroll = new QScrollArea;
    scroll->setWidget(content);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    return scroll;
}

void EvaluationPanel::showReportProgress(double share) {
    report_progress_->setVisible(share < 1);
    report_->setEnabled(share >= 1);
    report_progress_->setValue(static_cast<int>(share * 100));
}

QString EvaluationPanel::explanation() const {
    return pages_->currentIndex() == 0 ? empty_->explanation() : QString();
}

QString EvaluationPanel::headline() const {
    return headline_->text();
}

void EvaluationPanel::refresh() {
    if (const auto& evaluation = evaluation_.evaluation()) {
        headline_->setText(certaintyText(*evaluation));
        QStringList remarks;
        for (const std::string& remark : evaluation->remarks) remarks << QString::fromStdString(remark);
        remarks_->setText(remarks.join(QLatin1Char('\n')));
        remarks_->setVisible(!remarks.isEmpty());
        if (!evaluation_.working()) {
            showTable();
            showCurves();
            askForScoreCurve();
        }
        pages_->setCurrentIndex(1);
        return;
    }
    forgetScoreCurve();
    pages_->setCurrentIndex(0);
    if (evaluation_.working()) {
        empty_->setTexts(EvaluationSession::workingText());
        return;
    }
    const bool has_run = session_.currentRun().has_value() && !session_.running();
    const QString obstacle = evaluation_.obstacle();
    empty_->setTexts(obstacle.isEmpty()
                         ? tr("Here a run is measured: how many objects it found and how well it followed them. Choose "
                              "a run and what to compare it with.")
                         : obstacle,
                     has_run && evaluation_.settings().truth_file.empty() ? tr("Go to the labels") : QString());
}

void EvaluationPanel::showTable() {
    const RunEvaluation& evaluation = *evaluation_.evaluation();
    QStringList columns;
    std::vector<std::vector<NamedMeasure>> lists;
    for (const Measures& measures : evaluation.table) {
        columns << tr("T_ov %1").arg(measures.overlap, 0, 'g', 3);
        lists.push_back(listMeasures(measures));
    }
    const bool other_overlap = std::none_of(evaluation.table.begin(), evaluation.table.end(), [&](const Measures& m) {
        return std::abs(m.overlap - evaluation.shown.overlap) < 1e-9;
    });
    if (other_overlap) {
        columns << tr("T_ov %1").arg(evaluation.shown.overlap, 0, 'g', 3);
        lists.push_back(listMeasures(evaluation.shown));
    }
    const auto rows = static_cast<int>(lists.front().size());
    table_->setColumnCount(static_cast<int>(lists.size()));
    table_->setRowCount(rows);
    table_->setHorizontalHeaderLabels(columns);
    std::string group;
    for (int row = 0; row < rows; ++row) {
        const NamedMeasure& named = lists.front()[static_cast<std::size_t>(row)];
        auto* label = new QTableWidgetItem(QString::fromStdString(named.label));
        label->setToolTip(QString::fromStdString(named.help));
        table_->setVerticalHeaderItem(row, label);
        for (std::size_t column = 0; column < lists.size(); ++column) {
            const NamedMeasure& measure = lists[column][static_cast<std::size_t>(row)];
            auto* item = new QTableWidgetItem(measure.value ? numberText(*measure.value, measure.decimals)
                                                            : QStringLiteral("–"));
            item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
            item->setToolTip(QString::fromStdString(measure.help));
            table_->setItem(row, static_cast<int>(column), item);
        }
    }
    table_->setFixedHeight(table_->horizontalHeader()->sizeHint().height() +
                           rows * table_->verticalHeader()->defaultSectionSize() + 2 * table_->frameWidth());
}

void EvaluationPanel::showCurves() {
    const RunEvaluation& evaluation = *evaluation_.evaluation();
    std::vector<TrackedShare> shares;
    for (const TruthTrackTally& tally : evaluation.shown.tracks.truth)
        shares.push_back(shareOf(tally, evaluation.shown.convention));
    tracked_->setVisible(!shares.empty());
    tracked_->setShares(std::move(shares), {kMostlyTracked, kMostlyLost});

    LineData counts;
    counts.place_label = tr("frame");
    counts.value_label = tr("objects");
    counts.filled = true;
    counts.decimals = 0;
    counts.series = {
        {tr("found"), kFoundColour, {}}, {tr("missed"), kMissedColour, {}}, {tr("false"), kFalseColour, {}}};
    for (const FrameCounts& frame : evaluation.frames) {
        counts.places.push_back(frame.frame);
        counts.series[0].values.push_back(frame.found);
        counts.series[1].values.push_back(frame.missed);
        counts.series[2].values.push_back(frame.false_alarms);
    }
    LineData ratios;
    ratios.place_label = tr("frame");
    const int window = std::max(1, static_cast<int>(std::lround(evaluation.run.sequence.frame_rate_hz)));
    ratios.value_label = tr("share over %1 frames").arg(window);
    ratios.places = counts.places;
    ratios.top = 1.02;
    const WindowedRatios windowed = windowedRatios(evaluation.frames, window);
    ratios.series = {{tr("precision"), kFalseColour, windowed.precision},
                     {tr("recall"), kRecallColour, windowed.recall}};
    counts_->setData(std::move(counts));
    ratios_->setData(std::move(ratios));
    counts_->setMarker(session_.currentFrame());
    ratios_->setMarker(session_.currentFrame());
}

void EvaluationPanel::forgetScoreCurve() {
    query_.cancel();
    curve_of_.reset();
    score_curve_->hide();
    curve_failure_->hide();
}

void EvaluationPanel::askForScoreCurve() {
    const auto& evaluation = evaluation_.evaluation();
    if (curve_of_ == evaluation) return;
    forgetScoreCurve();
    curve_of_ = evaluation;
    const auto work = [this, evaluation, project = session_.project()](const BackgroundTask& task) {
        ProjectFile opened = ProjectFile::open(project, ProjectFile::Mode::read_only);
        const RunStore store(opened);
        // Detections have a score of their own, which nothing asks for.
        std::optional<double> threshold;
        if (!evaluation->detections) threshold = store.doubtful().scoreThreshold(evaluation->run.id);
        auto curve = scoreCurveOf(*evaluation, store, task.stop());
        task.tell([this, curve = std::move(curve), threshold] { showScoreCurve(curve, threshold); });
    };
    query_.ask(work, [this](const QString& message) {
        curve_of_.reset();  // so that it is tried again
        curve_failure_->setText(tr("No curve by score: %1").arg(message));
        curve_failure_->show();
    });
}

void EvaluationPanel::showScoreCurve(const std::vector<ScorePoint>& curve, std::optional<double> threshold) {
    score_curve_->setVisible(curve.size() > 1);
    if (curve.size() < 2) return;
    LineData chart;
    chart.place_label = tr("recall");
    chart.value_label = tr("share, score");
    chart.top = 1.02;
    chart.series = {
        {tr("precision"), kFalseColour, {}}, {tr("f-score"), kFoundColour, {}}, {tr("score"), kMissedColour, {}}};
    std::optional<double> there;
    // Thresholds ascend, so recall falls: the axis wants it the other way round.
    for (auto point = curve.rbegin(); point != curve.rend(); ++point) {
        const double recall = std::max(point->detection.recall, chart.places.empty() ? 0 : chart.places.back());
        chart.places.push_back(recall);
        chart.series[0].values.push_back(point->detection.precision);
        chart.series[1].values.push_back(point->detection.f_score);
        chart.series[2].values.push_back(point->threshold);
        if (threshold && point->threshold >= *threshold) there = recall;
    }
    score_curve_->setData(std::move(chart));
    score_curve_->setMarker(there);
}

void EvaluationPanel::copyTable() const {
    QStringList heading{QString()};
    for (int column = 0; column < table_->columnCount(); ++column)
        heading << table_->horizontalHeaderItem(column)->text();
    QStringList lines{heading.join(QLatin1Char('\t'))};
    for (int row = 0; row < table_->rowCount(); ++row) {
        QStringList fields{table_->verticalHeaderItem(row)->text()};
        for (int column = 0; column < table_->columnCount(); ++column) fields << table_->item(row, column)->text();
        lines << fields.join(QLatin1Char('\t'));
    }
    QApplication::clipboard()->setText(lines.join(QLatin1Char('\n')));
}

}  // namespace eyrie::ui

#include "moc_evaluation_panel.cpp"
