#include "tune/sweep/sweep_panel.h"

#include <QComboBox>
#include <QFileInfo>
#include <QLabel>
#include <QLocale>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <QStackedLayout>
#include <QToolButton>
#include <QVBoxLayout>

#include "core/error.h"
#include "io/tables/number_text.h"
#include "rerun/replay.h"
#include "tune/parameters/parameter_binding.h"
#include "tune/sweep/sweep_form.h"
#include "widgets/charts/sweep_chart.h"
#include "widgets/display_text.h"
#include "widgets/empty_state.h"
#include "widgets/layout/flow_layout.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

QString titleOf(const SweepRecord& record) {
    QString axes = QString::fromStdString(record.name);
    if (axes.isEmpty()) {
        try {
            for (const SweepAxis& axis : planFrom(record.plan, "").axes)
                axes += (axes.isEmpty() ? QString() : QStringLiteral(" × ")) + QString::fromStdString(axis.name);
        } catch (const Error&) {
            axes = QObject::tr("damaged");
        }
    }
    const QString state = record.points_done < record.point_count
                              ? QObject::tr("%1 of %2").arg(record.points_done).arg(record.point_count)
                              : QString::number(record.point_count);
    return QStringLiteral("%1  %2  (%3)").arg(record.id).arg(axes, state);
}

/// What the points of a sweep were measured against.
QString truthText(const SweepPlan& plan) {
    QStringList names;
    for (const SweepClip& clip : plan.clips) {
        const QString name = clip.ground_truth.empty()
                                 ? QObject::tr("the labels of the project")
                                 : QFileInfo(QString::fromStdString(clip.ground_truth)).fileName().toHtmlEscaped();
        if (!names.contains(name)) names << name;
    }
    return QObject::tr("Measured against %1.").arg(names.join(QStringLiteral(", ")));
}

}  // namespace

SweepPanel::SweepPanel(ProjectSession& session, EvaluationSession& evaluation, ParameterBinding& parameters,
                       MessageBar& messages, QWidget* parent)
    : QWidget(parent), session_(session), parameters_(parameters), messages_(messages), sweeps_(session) {
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(2);
    form_ = new SweepForm(evaluation, this);
    rows->addWidget(form_);
    progress_line_ = new QWidget(this);
    auto* line = new QHBoxLayout(progress_line_);
    line->setContentsMargins(8, 0, 8, 4);
    progress_ = new QProgressBar(progress_line_);
    progress_->setTextVisible(false);
    progress_text_ = new QLabel(progress_line_);
    cancel_ = new QPushButton(tr("Cancel"), progress_line_);
    cancel_->setToolTip(tr("Finished points are kept, and the sweep can be resumed"));
    line->addWidget(progress_, 1);
    line->addWidget(progress_text_);
    line->addWidget(cancel_);
    rows->addWidget(progress_line_);
    progress_line_->hide();
    auto* below = new QWidget(this);
    pages_ = new QStackedLayout(below);
    empty_ = new EmptyState;
    empty_->setTexts(
        tr("A sweep tries many values of one or two parameters on the run that is shown and measures each against "
           "ground truth. Choose a parameter above; the curve or heat map appears here as points are done."));
    pages_->addWidget(empty_);
    pages_->addWidget(buildResult());
    rows->addWidget(below, 1);
    connect(form_, &SweepForm::startRequested, &sweeps_, &SweepSession::start);
    whenChanged(session_, this,
                {{{SessionChange::current_run, SessionChange::run_data, SessionChange::runs}, [this] { showRun(); }}});
    wireSweeps();
    showRun();
    showList();
    showTable();
}

QWidget* SweepPanel::buildResult() {
    auto* result = new QWidget(this);
    auto* rows = new QVBoxLayout(result);
    rows->setContentsMargins(8, 0, 8, 6);
    rows->setSpacing(4);
    auto* first = new QHBoxLayout;
    list_ = new QComboBox(result);
    list_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    list_->setMinimumContentsLength(14);
    list_->setToolTip(tr("The sweeps of this project"));
    resume_ = new QPushButton(tr("Resume"), result);
    resume_->setToolTip(tr("Compute the missing points"));
    remove_ = new QToolButton(result);
    remove_->setText(tr("Remove"));
    first->addWidget(list_, 1);
    first->addWidget(resume_);
    first->addWidget(remove_);
    rows->addLayout(first);
    auto* choices = new QWidget(result);
    auto* second = new FlowLayout(choices);
    view_ = new QComboBox(result);
    view_->addItems(
        {tr("measure"), tr("precision, recall, f"), tr("precision against recall"), tr("recall against false alarms")});
    view_->setToolTip(tr(
        "What the chart shows. Recall against false alarms per frame stands in for the ROC, as detection has no true "
        "negatives."));
    measure_ = new QComboBox(result);
    fillMeasures();
    of_ = new QComboBox(result);
    of_->addItems({tr("detections"), tr("tracks")});
    overlap_ = new QComboBox(result);
    for (QComboBox* box : {view_, measure_, of_, overlap_}) {
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(6);
        second->addWidget(box);
        bindCommands(this, {{box, [this] { showTable(); }}});
    }
    rows->addWidget(choices);
    chart_ = new SweepChart(result);
    rows->addWidget(chart_, 1);
    best_ = new QLabel(result);
    best_->setWordWrap(true);
    best_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    rows->addWidget(best_);
    auto* commands = new QWidget(result);
    auto* last = new FlowLayout(commands);
    apply_ = new QPushButton(tr("Use for the next run"), result);
    save_ = new QPushButton(tr("Save as preset…"), result);
    last->addWidget(apply_);
    last->addWidget(save_);
    auto* copy = new QToolButton(result);
    copy->setText(tr("Copy table"));
    auto* picture = new QToolButton(result);
    picture->setText(tr("Copy picture"));
    last->addWidget(copy);
    last->addWidget(picture);
    rows->addWidget(commands);
    bindButtons(copy, picture);
    return result;
}

void SweepPanel::wireSweeps() {
    whenChanged(sweeps_, this,
                {{SweepChange::sweeps, [this] { showList(); }},
                 {SweepChange::table, [this] { showTable(); }},
                 {SweepChange::running, [this] { showRunning(); }}});
    connect(&sweeps_, &SweepSession::progressed, this, &SweepPanel::showProgress);
    connect(&sweeps_, &SweepSession::failed, this, &SweepPanel::tellProblem);
    connect(&sweeps_, &SweepSession::consentNeeded, this, &SweepPanel::ask);
    connect(&sweeps_, &SweepSession::finished, this, [this](bool whole) {
        tell(whole ? tr("The sweep is done.") : tr("The sweep was cancelled; Resume computes the rest."));
    });
    connect(chart_, &SweepChart::pointClicked, this, [this](int position) {
        clicked_ = position;
        showTable();
    });
}

void SweepPanel::bindButtons(QToolButton* copy, QToolButton* copy_picture) {
    bindCommands(this, {
                           {list_, [this](int index) { sweeps_.select(list_->itemData(index).toInt()); }},
                           {cancel_, [this] { sweeps_.cancel(); }},
                           {resume_, [this] { sweeps_.resume(list_->currentData().toInt()); }},
                           {remove_, [this] { removeSweep(); }},
                           {apply_, [this] { applyPoint(); }},
                           {save_, [this] { savePoint(); }},
                           {copy,
                            [this] {
                                chart_->copyText();
                                tell(tr("The values of the chart were copied."));
                            }},
                           {copy_picture,
                            [this] {
                                chart_->copyPicture();
                                tell(tr("The picture of the chart was copied."));
                            }},
                       });
}

void SweepPanel::showRunning() {
    progress_line_->setVisible(sweeps_.running());
    form_->setRunning(sweeps_.running());
    showList();
}

void SweepPanel::removeSweep() {
    const auto answer = QMessageBox::question(this, tr("Remove sweep"), tr("Remove this sweep from the project?"));
    if (answer == QMessageBox::Yes) sweeps_.remove(list_->currentData().toInt());
}

void SweepPanel::applyPoint() {
    if (!sweeps_.table() || !chosenPoint()) return;
    const SweepPlan& plan = sweeps_.table()->plan;
    auto values = plan.base;
    const std::vector<std::string> changed = plan.valuesOf(*chosenPoint());
    for (std::size_t a = 0; a < plan.axes.size(); ++a)
        for (auto& [name, value] : values)
            if (name == plan.axes[a].name) value = changed[a];
    parameters_.setValues(values);
}

void SweepPanel::savePoint() {
    try {
        if (sweeps_.table() && chosenPoint()) parameters_.saveAsPreset(sweeps_.table()->plan.optionsOf(*chosenPoint()));
    } catch (const Error& error) {
        tellProblem(QString::fromUtf8(error.what()));
    }
}

void SweepPanel::tell(const QString& text) {
    messages_.showMessage(MessageKind::info, text);
}

void SweepPanel::tellProblem(const QString& text) {
    messages_.showMessage(MessageKind::error, text);
}

void SweepPanel::fillMeasures() {
    for (const MeasureText& measure : sweepMeasures()) {
        measure_->addItem(QString::fromStdString(measure.label), QString::fromStdString(measure.key));
        measure_->setItemData(measure_->count() - 1, QString::fromStdString(measure.help), Qt::ToolTipRole);
    }
    measure_->setCurrentIndex(measure_->findData(QStringLiteral("f_score")));
}

void SweepPanel::fillOverlaps() {
    const SweepPlan& plan = sweeps_.table()->plan;
    overlap_->clear();
    if (plan.overlaps.size() > 1) overlap_->addItem(tr("mean"));
    overlap_->setToolTip(tr("The overlap T_ov of the measure that is judged, or the mean over all"));
    for (const double overlap : plan.overlaps)
        overlap_->addItem(tr("T_ov %1").arg(QString::fromStdString(shortestText(overlap))), overlap);
}

void SweepPanel::setView(SweepView view) {
    view_->setCurrentIndex(static_cast<int>(view));
    showTable();
}

SweepCriterion SweepPanel::criterion() const {
    SweepCriterion criterion;
    criterion.key = measure_->currentData().toString().toStdString();
    criterion.tracks = of_->currentIndex() == 1 || isOfTracks(measureText(criterion.key).group);
    if (overlap_->currentData().isValid()) criterion.overlap = overlap_->currentData().toDouble();
    return criterion;
}

std::optional<int> SweepPanel::chosenPoint() const {
    if (clicked_) return clicked_;
    if (!sweeps_.table()) return std::nullopt;
    const auto best = bestPoint(*sweeps_.table(), criterion());
    return best ? std::optional<int>(best->position) : std::nullopt;
}

void SweepPanel::showRun() {
    ChainOptions options = session_.settings().options;
    const bool known = session_.currentRun() && session_.runData();
    if (known) options = storedOptions(session_.runData()->parameters);
    form_->setParameters(listParameters(describeOf(options)));
    form_->setRun(known ? tr("run %1").arg(*session_.currentRun()) : QString());
    std::vector<std::pair<int, QString>> runs;
    for (const RunRecord& run : session_.runs()) {
        if (run.frames_done == 0) continue;
        const QString name = QString::fromStdString(run.name.empty() ? run.preset : run.name);
        const QString video = QFileInfo(QString::fromStdString(run.sequence.path)).fileName();
        runs.emplace_back(run.id, tr("Run %1 · %2 · %3").arg(run.id).arg(name, video));
    }
    form_->setRuns(runs, session_.currentRun());
}

void SweepPanel::showList() {
    const QVariant before = sweeps_.table() ? QVariant(sweeps_.table()->id) : list_->currentData();
    list_->clear();
    for (const SweepRecord& record : sweeps_.sweeps()) list_->addItem(titleOf(record), record.id);
    const int index = list_->findData(before);
    list_->setCurrentIndex(index < 0 ? list_->count() - 1 : index);
    const auto& table = sweeps_.table();
    const bool missing = table && static_cast<int>(table->points.size()) < table->plan.pointCount();
    resume_->setVisible(missing && !sweeps_.running());
    remove_->setEnabled(!sweeps_.running() && list_->count() > 0);
    pages_->setCurrentIndex(table || list_->count() > 0 ? 1 : 0);
}

void SweepPanel::showTable() {
    const auto& table = sweeps_.table();
    if (!table) {
        chart_->setData({});
        best_->clear();
        showList();
        return;
    }
    if (table->id != shown_sweep_) {
        shown_sweep_ = table->id;
        clicked_.reset();
        fillOverlaps();
        of_->setCurrentIndex(usualCriterion(table->plan).tracks ? 1 : 0);
        showList();
    }
    const SweepCriterion judged = criterion();
    chart_->setData(chartOf(*table, static_cast<SweepView>(view_->currentIndex()), judged,
                            [this](const std::string& name) { return form_->unitOf(name); }));
    QString text = bestPointText(*table, judged) + QStringLiteral("<br>") + truthText(table->plan);
    if (clicked_ && *clicked_ < table->plan.pointCount())
        text += QStringLiteral("<br>") + tr("Chosen: %1").arg(pointText(*table, *clicked_, judged));
    else
        text += QStringLiteral("<br>") + tr("Click a point of the chart to choose it, or use the arrow keys there.");
    chart_->setChosen(chosenPoint().value_or(-1));
    best_->setText(text);
    if (sweeps_.running() && list_->currentData().toInt() == table->id) {
        for (SweepRecord record : sweeps_.sweeps()) {
            if (record.id != table->id) continue;
            record.points_done = static_cast<int>(table->points.size());
            list_->setItemText(list_->currentIndex(), titleOf(record));
        }
    }
    const bool any = chosenPoint().has_value();
    apply_->setEnabled(any);
    save_->setEnabled(any);
    resume_->setVisible(!sweeps_.running() && static_cast<int>(table->points.size()) < table->plan.pointCount());
}

void SweepPanel::showProgress(const SweepProgress& progress) {
    progress_->setMaximum(progress.points_total);
    progress_->setValue(progress.points_done);
    QString text = progress.points_total > 0 ? tr("%1 of %2").arg(progress.points_done).arg(progress.points_total)
                                             : QString::fromStdString(progress.doing);
    if (progress.points_total > 0 && progress.points_done == 0 && !progress.doing.empty())
        text = QString::fromStdString(progress.doing);
    if (progress.seconds_left > 0) text += QStringLiteral(", ") + leftText(progress.seconds_left);
    progress_text_->setText(text);
}

void SweepPanel::ask(const SweepRequest& request, double points) {
    const auto answer = QMessageBox::question(this, tr("A large sweep"),
                                              tr("This sweep has %1 points. It may take very long. Start it anyway?")
                                                  .arg(QLocale().toString(points, 'f', 0)));
    if (answer != QMessageBox::Yes) return;
    SweepRequest meant = request;
    meant.many_points_meant = true;
    sweeps_.start(meant);
}

}  // namespace eyrie::ui

#include "moc_sweep_panel.cpp"
