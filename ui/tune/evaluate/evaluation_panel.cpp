#include "tune/evaluate/evaluation_panel.h"

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/label_formats.h"
#include "widgets/charts/line_chart.h"
#include "widgets/charts/tracked_bar.h"
#include "widgets/display_text.h"
#include "widgets/empty_state.h"
#include "widgets/theme_colours.h"

namespace eyrie::ui {

namespace {

const QColor kFoundColour(46, 150, 80);
const QColor kMissedColour(222, 160, 20);
const QColor kFalseColour(214, 66, 54);
const QColor kRecallColour(45, 120, 200);

enum TruthEntry { labels_entry, file_entry, choose_entry };

QString spanText(const BootstrapInterval& interval) {
    return QStringLiteral("%1 (%2 – %3)")
        .arg(numberText(interval.value, 3), numberText(interval.low, 3), numberText(interval.high, 3));
}

QString runName(const RunRecord& run) {
    return run.name.empty() ? QObject::tr("run %1").arg(run.id)
                            : QObject::tr("run %1, %2").arg(run.id).arg(QString::fromStdString(run.name));
}

QString differenceLine(const QString& measure, const BootstrapInterval& difference, const RunRecord& other) {
    const QString sign = difference.value >= 0 ? QStringLiteral("+") : QString();
    const QString numbers =
        QStringLiteral("%1%2 (%3 – %4)")
            .arg(sign, numberText(difference.value, 3), numberText(difference.low, 3), numberText(difference.high, 3));
    const bool real = difference.low > 0 || difference.high < 0;
    if (!real)
        return QObject::tr("%1 against %2: %3, <b>no significant difference</b>").arg(measure, runName(other), numbers);
    return difference.value > 0
               ? QObject::tr("%1 against %2: %3, <b>significantly better</b>").arg(measure, runName(other), numbers)
               : QObject::tr("%1 against %2: %3, <b>significantly worse</b>").arg(measure, runName(other), numbers);
}

}  // namespace

WindowedRatios windowedRatios(const std::vector<FrameCounts>& frames, int window) {
    WindowedRatios ratios;
    const int count = static_cast<int>(frames.size());
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < count; ++i) {
        double found = 0;
        double missed = 0;
        double alarms = 0;
        for (int k = std::max(0, i - window / 2); k <= std::min(count - 1, i + window / 2); ++k) {
            found += frames[static_cast<std::size_t>(k)].found;
            missed += frames[static_cast<std::size_t>(k)].missed;
            alarms += frames[static_cast<std::size_t>(k)].false_alarms;
        }
        ratios.precision.push_back(found + alarms > 0 ? found / (found + alarms) : nothing);
        ratios.recall.push_back(found + missed > 0 ? found / (found + missed) : nothing);
    }
    return ratios;
}

QString certaintyText(const RunEvaluation& evaluation) {
    QStringList lines;
    lines << QObject::tr("f-score <b>%1</b>, 95 % interval %2 – %3")
                 .arg(numberText(evaluation.f_score.value, 3), numberText(evaluation.f_score.low, 3),
                      numberText(evaluation.f_score.high, 3));
    if (evaluation.mota) lines.back() += QObject::tr(" · MOTA %1").arg(spanText(*evaluation.mota));
    if (evaluation.difference) {
        const RunDifference& difference = *evaluation.difference;
        lines << differenceLine(QObject::tr("f-score"), difference.difference.f_score, difference.other);
        if (difference.difference.mota)
            lines << differenceLine(QObject::tr("MOTA"), *difference.difference.mota, difference.other);
    }
    return lines.join(QStringLiteral("<br>"));
}

EvaluationPanel::EvaluationPanel(ProjectSession& session, EvaluationSession& evaluation, QWidget* parent)
    : QWidget(parent), session_(session), evaluation_(evaluation) {
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(2);
    rows->addWidget(buildChoices());
    pages_ = new QStackedWidget;
    empty_ = new EmptyState;
    pages_->addWidget(empty_);
    pages_->addWidget(buildResult());
    rows->addWidget(pages_, 1);

    connect(empty_, &EmptyState::actionTriggered, this, &EvaluationPanel::labellingRequested);
    connect(&evaluation_, &EvaluationSession::changed, this, &EvaluationPanel::refresh);
    connect(&evaluation_, &EvaluationSession::workingChanged, this, &EvaluationPanel::refresh);
    connect(&evaluation_, &EvaluationSession::settingsChanged, this, &EvaluationPanel::showSettings);
    connect(&session_, &ProjectSession::runsChanged, this, &EvaluationPanel::showRuns);
    connect(&session_, &ProjectSession::currentRunChanged, this, &EvaluationPanel::showRuns);
    connect(&session_, &ProjectSession::frameChanged, this, [this](FrameIndex frame) {
        counts_->setMarker(frame);
        ratios_->setMarker(frame);
    });
    for (LineChart* chart : {counts_, ratios_})
        connect(chart, &LineChart::placeActivated, &session_,
                [this](double place) { session_.goToFrame(static_cast<FrameIndex>(std::lround(place))); });
    connect(tracked_, &TrackedBar::objectActivated, this, &EvaluationPanel::objectActivated);
    showSettings();
    refresh();
}

// ---- choices --------------------------------------------------------------------------------------------------------

QWidget* EvaluationPanel::buildChoices() {
    auto* choices = new QWidget;
    truth_ = new QComboBox;
    truth_->addItem(tr("Labels of the project"));
    truth_->addItem(QString());
    truth_->addItem(tr("Choose a file…"));
    truth_->setToolTip(tr("What the run is compared with"));
    truth_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    measured_ = new QComboBox;
    measured_->addItems({tr("Tracks"), tr("Detections")});
    overlap_ = new QDoubleSpinBox;
    overlap_->setRange(0.01, 1);
    overlap_->setSingleStep(0.05);
    overlap_->setDecimals(2);
    overlap_->setPrefix(tr("T_ov "));
    overlap_->setKeyboardTracking(false);
    overlap_->setToolTip(tr("Smallest overlap at which an object counts as found, for errors, objects and curves"));
    other_ = new QComboBox;
    other_->setToolTip(tr("Another run over the same video; tells whether the difference is more than chance"));
    other_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    more_ = new QToolButton;
    more_->setText(tr("Options"));
    more_->setCheckable(true);
    vehicles_ = new QCheckBox(tr("Vehicles only: other objects are ignored"));
    upright_ = new QCheckBox(tr("Compare upright boxes (truth without headings)"));
    border_ = new QDoubleSpinBox;
    border_->setRange(0, 200);
    border_->setDecimals(1);
    border_->setSuffix(tr(" px"));
    border_->setSpecialValueText(tr("none"));
    border_->setKeyboardTracking(false);
    border_->setToolTip(
        tr("Results that come this close to the image's edge are left out, for ground truth that leaves "
           "cut objects out"));
    for (QWidget* field : std::initializer_list<QWidget*>{truth_, measured_, other_, overlap_, border_}) {
        field->installEventFilter(this);
        field->setFocusPolicy(Qt::StrongFocus);
    }
    details_ = new QWidget;
    auto* form = new QFormLayout(details_);
    form->setContentsMargins(0, 0, 0, 0);
    form->addRow(vehicles_);
    form->addRow(upright_);
    form->addRow(tr("Border left out"), border_);
    details_->hide();

    auto* first = new QHBoxLayout;
    first->addWidget(truth_, 3);
    first->addWidget(measured_, 1);
    auto* second = new QHBoxLayout;
    second->addWidget(overlap_);
    second->addWidget(other_, 1);
    second->addWidget(more_);
    auto* rows = new QVBoxLayout(choices);
    rows->setContentsMargins(6, 4, 6, 2);
    rows->setSpacing(4);
    rows->addLayout(first);
    rows->addLayout(second);
    rows->addWidget(details_);

    connect(more_, &QToolButton::toggled, details_, &QWidget::setVisible);
    connect(truth_, &QComboBox::activated, this, [this](int entry) {
        if (entry == choose_entry)
            chooseTruthFile();
        else
            applySettings();
    });
    connect(measured_, &QComboBox::activated, this, &EvaluationPanel::applySettings);
    connect(other_, &QComboBox::activated, this, &EvaluationPanel::applySettings);
    connect(overlap_, &QDoubleSpinBox::valueChanged, this, &EvaluationPanel::applySettings);
    connect(border_, &QDoubleSpinBox::valueChanged, this, &EvaluationPanel::applySettings);
    connect(vehicles_, &QCheckBox::toggled, this, &EvaluationPanel::applySettings);
    connect(upright_, &QCheckBox::toggled, this, &EvaluationPanel::applySettings);
    return choices;
}

bool EvaluationPanel::eventFilter(QObject* watched, QEvent* event) {
    // Scrolling over a field must not change what is measured.
    auto* field = qobject_cast<QWidget*>(watched);
    if (event->type() == QEvent::Wheel && field != nullptr && !field->hasFocus()) {
        event->ignore();
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

void EvaluationPanel::showSettings() {
    const EvaluationSettings& settings = evaluation_.settings();
    const QSignalBlocker blockers[] = {QSignalBlocker(truth_),    QSignalBlocker(measured_), QSignalBlocker(overlap_),
                                       QSignalBlocker(vehicles_), QSignalBlocker(upright_),  QSignalBlocker(border_)};
    const QString path = QString::fromStdString(settings.truth_file.string());
    truth_->setItemText(file_entry, path.isEmpty() ? tr("No file chosen") : QFileInfo(path).fileName());
    truth_->setItemData(file_entry, path, Qt::UserRole);
    truth_->setItemData(file_entry, path, Qt::ToolTipRole);
    truth_->setCurrentIndex(path.isEmpty() ? labels_entry : file_entry);
    measured_->setCurrentIndex(settings.detections ? 1 : 0);
    overlap_->setValue(settings.wishes.overlap);
    border_->setValue(settings.wishes.border.value_or(0));
    vehicles_->setChecked(settings.wishes.vehicles_only);
    upright_->setChecked(settings.wishes.upright);
    showRuns();
}

void EvaluationPanel::showRuns() {
    const QSignalBlocker blocker(other_);
    other_->clear();
    other_->addItem(tr("Compare with …"), 0);
    const auto current = session_.currentRun();
    std::string video;
    for (const RunRecord& run : session_.runs())
        if (run.id == current) video = run.sequence.path;
    for (const RunRecord& run : session_.runs()) {
        if (run.id == current || run.sequence.path != video || run.frames_done == 0) continue;
        other_->addItem(tr("against %1").arg(runName(run)), run.id);
        if (evaluation_.settings().other_run == run.id) other_->setCurrentIndex(other_->count() - 1);
    }
    other_->setEnabled(other_->count() > 1);
}

void EvaluationPanel::applySettings() {
    EvaluationSettings settings = evaluation_.settings();
    settings.truth_file = truth_->currentIndex() == file_entry
                              ? truth_->itemData(file_entry, Qt::UserRole).toString().toStdString()
                              : std::string();
    settings.detections = measured_->currentIndex() == 1;
    settings.wishes.overlap = overlap_->value();
    settings.wishes.border = border_->value() > 0 ? std::optional(border_->value()) : std::nullopt;
    settings.wishes.vehicles_only = vehicles_->isChecked();
    settings.wishes.upright = upright_->isChecked();
    const int other = other_->currentData().toInt();
    settings.other_run = other > 0 ? std::optional(other) : std::nullopt;
    evaluation_.setSettings(settings);
    showSettings();
}

void EvaluationPanel::useTruthFile(const QString& path) {
    truth_->setItemData(file_entry, path, Qt::UserRole);
    const QSignalBlocker blocker(truth_);
    truth_->setCurrentIndex(file_entry);
    applySettings();
}

void EvaluationPanel::chooseTruthFile() {
    const QString patterns = QString::fromStdString(labelFilePatterns());
    const QString path = QFileDialog::getOpenFileName(this, tr("Ground truth"), QString(),
                                                      tr("Labels (%1);;All files (*)").arg(patterns));
    if (path.isEmpty())
        showSettings();
    else
        useTruthFile(path);
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
    connect(copy, &QAction::triggered, this, &EvaluationPanel::copyTable);
    tracked_ = new TrackedBar;
    tracked_->setFixedHeight(110);
    counts_ = new LineChart;
    ratios_ = new LineChart;
    for (LineChart* chart : {counts_, ratios_}) chart->setFixedHeight(190);
    report_ = new QToolButton;
    report_->setText(tr("Report…"));
    report_->setToolTip(tr("Write everything as one HTML or PDF file (Ctrl+Shift+R)"));
    connect(report_, &QToolButton::clicked, this, &EvaluationPanel::reportRequested);
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
        }
        pages_->setCurrentIndex(1);
        return;
    }
    pages_->setCurrentIndex(0);
    if (evaluation_.working()) {
        empty_->setTexts(tr("The run is being compared with the ground truth …"));
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
        shares.push_back({tally.id, tally.frames, tally.matched, tally.switches, tally.fragments});
    tracked_->setVisible(!shares.empty());
    tracked_->setShares(std::move(shares));

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
