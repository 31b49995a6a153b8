#include "tune/train/training_dialog.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "widgets/charts/sweep_chart.h"
#include "widgets/display_text.h"
#include "widgets/empty_state.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

constexpr std::size_t kMostPoints = 1000;  ///< of a curve on screen

template <class Kind>
QComboBox* comboOf(const std::vector<Kind>& kinds) {
    auto* combo = new QComboBox;
    for (const Kind kind : kinds) combo->addItem(QString::fromUtf8(titleOf(kind)), static_cast<int>(kind));
    return combo;
}

SweepChartData::Series seriesOf(const RocCurve& curve, const QString& name, int colour, bool bold) {
    SweepChartData::Series series;
    series.name = QStringLiteral("%1 (AUC %2)").arg(name).arg(curve.area, 0, 'f', 4);
    series.colour = colour;
    series.bold = bold;
    const std::size_t step = std::max<std::size_t>(1, curve.points.size() / kMostPoints);
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
        if (i % step != 0 && i + 1 != curve.points.size()) continue;
        series.x.push_back(curve.points[i].false_positive_rate);
        series.y.push_back(curve.points[i].true_positive_rate);
        series.positions.push_back(static_cast<int>(i));
    }
    return series;
}

}  // namespace

TrainingDialog::TrainingDialog(const std::filesystem::path& project, QWidget* parent) : QDialog(parent) {
    setWindowTitle(tr("Train a classifier from labels"));
    resize(940, 560);
    chart_ = new SweepChart;
    message_ =
        new QLabel(tr("The labelled vehicles of the projects are cut out and trained on; whole sequences are held "
                      "out, and the classifier is tested on them next to the one that comes with the program."));
    message_->setWordWrap(true);
    progress_ = new QProgressBar;
    progress_->setRange(0, 1000);
    progress_->hide();
    start_ = new QPushButton(tr("Train"));
    cancel_ = new QPushButton(tr("Cancel"));
    use_ = new QPushButton(tr("Use it"));
    use_->setToolTip(tr("Sets sliding_window.model of the next run to this file"));
    auto* close = new QPushButton(tr("Close"));
    auto* buttons = new QHBoxLayout;
    buttons->addWidget(start_);
    buttons->addWidget(cancel_);
    buttons->addStretch(1);
    buttons->addWidget(use_);
    buttons->addWidget(close);
    auto* empty = new EmptyState;
    empty->setTexts(
        tr("How well the new classifier tells vehicles from everything else is drawn here, beside the one "
           "that comes with the program."));
    pages_ = new QStackedWidget;
    pages_->addWidget(empty);
    pages_->addWidget(chart_);
    auto* columns = new QHBoxLayout;
    columns->addWidget(buildSettings(), 2);
    columns->addWidget(pages_, 3);
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(columns, 1);
    layout->addWidget(message_);
    layout->addWidget(progress_);
    layout->addLayout(buttons);
    bindCommands(this, {{start_, [this] { start(); }},
                        {cancel_, [this] { training_.cancel(); }},
                        {close, [this] { reject(); }},
                        {use_, [this] {
                             emit useRequested(QString::fromStdString(report_->file.string()));
                             accept();
                         }}});
    connect(&training_, &LabelTraining::progress, this, [this](const QString& phase, double share) {
        progress_->setValue(static_cast<int>(1000 * share));
        message_->setText(phase);
    });
    connect(&training_, &LabelTraining::finished, this, &TrainingDialog::showReport);
    connect(&training_, &LabelTraining::failed, this, [this](const QString& text) {
        message_->setText(text);
        enable();
    });
    connect(&training_, &LabelTraining::replacementNeeded, this, [this](const QString& text) {
        replaced_ = file_->text().toStdString();
        message_->setText(text);
        enable();
    });
    connect(&training_, &LabelTraining::stopped, this, [this] {
        message_->setText(tr("Cancelled; no model was written."));
        enable();
    });
    if (!project.empty()) {
        addProject(QString::fromStdString(project.string()));
        std::filesystem::path model = project;
        file_->setText(QString::fromStdString(model.replace_extension(".eyriemodel").string()));
    }
    enable();
}

TrainingDialog::~TrainingDialog() {
    training_.cancel();
}

QWidget* TrainingDialog::buildSettings() {
    auto* settings = new QWidget;
    projects_ = new QListWidget;
    projects_->setTextElideMode(Qt::ElideMiddle);
    projects_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* add = new QPushButton(tr("Add…"));
    auto* remove = new QPushButton(tr("Remove"));
    descriptor_ = comboOf(allDescriptors());
    classifier_ = comboOf(allClassifiers());
    const TrainingOptions defaults;
    setKinds(defaults.descriptor, defaults.classifier);
    every_ = new QSpinBox;
    every_->setRange(1, 1000);
    every_->setValue(TrainingWish().every);
    every_->setSpecialValueText(tr("all labelled frames"));
    every_->setToolTip(tr("Labelled frames that lie at least this far apart; neighbours look alike"));
    every_->setPrefix(tr("every "));
    every_->setSuffix(tr(" frames"));
    file_ = new QLineEdit;
    auto* browse = new QPushButton(tr("…"));
    browse->setMaximumWidth(36);
    auto* project_buttons = new QHBoxLayout;
    project_buttons->addWidget(add);
    project_buttons->addWidget(remove);
    project_buttons->addStretch(1);
    auto* file_line = new QHBoxLayout;
    file_line->addWidget(file_, 1);
    file_line->addWidget(browse);
    auto* form = new QFormLayout;
    form->addRow(tr("Descriptor"), descriptor_);
    form->addRow(tr("Classifier"), classifier_);
    form->addRow(tr("Use"), every_);
    form->addRow(tr("Model file"), file_line);
    auto* layout = new QVBoxLayout(settings);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(new QLabel(tr("Projects with labels")));
    layout->addWidget(projects_, 1);
    layout->addLayout(project_buttons);
    layout->addLayout(form);
    bindCommands(this, {{add,
                         [this] {
                             for (const QString& file :
                                  QFileDialog::getOpenFileNames(this, tr("Add projects"), {}, projectOrAnyFilter()))
                                 addProject(file);
                         }},
                        {remove,
                         [this] {
                             delete projects_->takeItem(projects_->currentRow());
                             enable();
                         }},
                        {browse, [this] {
                             const QString file = QFileDialog::getSaveFileName(this, tr("Model file"), file_->text(),
                                                                               tr("Models (*.eyriemodel)"));
                             if (!file.isEmpty()) file_->setText(file);
                         }}});
    onEdited(this, &TrainingDialog::enable, file_);
    return settings;
}

void TrainingDialog::addProject(const QString& file) {
    if (projects_->findItems(file, Qt::MatchExactly).isEmpty()) {
        projects_->addItem(file);
        projects_->item(projects_->count() - 1)->setToolTip(file);
    }
    enable();
}

void TrainingDialog::setFile(const QString& file) {
    file_->setText(file);
}

void TrainingDialog::setKinds(DescriptorKind descriptor, ClassifierKind classifier) {
    descriptor_->setCurrentIndex(descriptor_->findData(static_cast<int>(descriptor)));
    classifier_->setCurrentIndex(classifier_->findData(static_cast<int>(classifier)));
}

void TrainingDialog::setEvery(int frames) {
    every_->setValue(frames);
}

void TrainingDialog::start() {
    TrainingWish wish;
    for (int i = 0; i < projects_->count(); ++i) wish.projects.emplace_back(projects_->item(i)->text().toStdString());
    wish.options = options_;
    wish.options.descriptor = static_cast<DescriptorKind>(descriptor_->currentData().toInt());
    wish.options.classifier = static_cast<ClassifierKind>(classifier_->currentData().toInt());
    wish.every = every_->value();
    wish.file = file_->text().toStdString();
    wish.replace = wish.file == replaced_;
    report_.reset();
    progress_->setValue(0);
    training_.start(wish);
    enable();
}

void TrainingDialog::showReport(const std::shared_ptr<const TrainingReport>& report) {
    report_ = report;
    SweepChartData curves;
    curves.x_label = tr("false positive rate");
    curves.y_label = tr("true positive rate");
    curves.share = true;
    curves.series = {seriesOf(report->own, tr("this one"), 0, true),
                     seriesOf(report->shipped, tr("shipped with the program"), 1, false)};
    chart_->setData(std::move(curves));
    pages_->setCurrentWidget(chart_);
    message_->setText(
        tr("Trained on %1; tested on %2. Area under the curve: %3, of the shipped model: %4. Written to %5.")
            .arg(report->samples, report->held_out)
            .arg(report->own.area, 0, 'f', 4)
            .arg(report->shipped.area, 0, 'f', 4)
            .arg(QString::fromStdString(report->file.string())));
    enable();
}

void TrainingDialog::enable() {
    const bool running = training_.running();
    start_->setEnabled(!running && projects_->count() > 0 && !file_->text().isEmpty());
    cancel_->setEnabled(running);
    use_->setEnabled(!running && report_ != nullptr);
    progress_->setVisible(running);
}

QString TrainingDialog::message() const {
    return message_->text();
}

}  // namespace eyrie::ui

#include "moc_training_dialog.cpp"
