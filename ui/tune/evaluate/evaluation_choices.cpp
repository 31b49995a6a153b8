#include "tune/evaluate/evaluation_choices.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>

#include "tune/evaluate/evaluation_wording.h"
#include "tune/evaluate/truth_choice.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {
QString shownClasses(const std::optional<TrackClass>& one_class) {
    switch (one_class.value_or(TrackClass::unknown)) {
        case TrackClass::unknown:
            break;
        case TrackClass::vehicle:
            return EvaluationChoices::tr("vehicles only");
        case TrackClass::two_wheeler:
            return EvaluationChoices::tr("two-wheelers only");
        case TrackClass::person:
            return EvaluationChoices::tr("persons only");
    }
    return EvaluationChoices::tr("all classes");
}
}  // namespace

EvaluationChoices::EvaluationChoices(ProjectSession& session, EvaluationSession& evaluation, QWidget* parent)
    : QWidget(parent), session_(session), evaluation_(evaluation) {
    buildFields();
    bindSwitches(this, {{more_, [this](bool on) { details_->setVisible(on); }}});
    bindCommands(this, {{measured_, [this] { applySettings(); }},
                        {other_, [this] { applySettings(); }},
                        {class_, [this] { applySettings(); }}});
    onEdited(this, &EvaluationChoices::applySettings, overlap_, border_, vehicles_, upright_);
    connect(&evaluation_, &EvaluationSession::settingsChanged, this, &EvaluationChoices::showSettings);
    whenChanged(session_, this, {{{SessionChange::runs, SessionChange::current_run}, [this] { showRuns(); }}});
    showSettings();
}

void EvaluationChoices::buildFields() {
    truth_ = new TruthChoice(evaluation_);
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
    class_ = new QComboBox;
    class_->setAccessibleName(tr("Class"));
    for (const std::string& word : scoredClassWords()) class_->addItem(shownClasses(scoredClass(word)));
    class_->setToolTip(tr(
        "Only objects of this class count; the others are ignored, and results that name another class are left out"));
    vehicles_ = new QCheckBox(tr("Vehicles only: other objects are ignored"));
    upright_ = new QCheckBox(tr("Compare upright boxes (ground truth without headings)"));
    border_ = new QDoubleSpinBox;
    border_->setRange(0, 200);
    border_->setDecimals(1);
    border_->setSuffix(tr(" px"));
    border_->setSpecialValueText(tr("none"));
    border_->setKeyboardTracking(false);
    border_->setToolTip(
        tr("Results that come this close to the image's edge are left out, for ground truth that leaves "
           "cut objects out"));
    for (QWidget* field : std::initializer_list<QWidget*>{measured_, other_, overlap_, border_, class_}) {
        field->installEventFilter(this);
        field->setFocusPolicy(Qt::StrongFocus);
    }
    details_ = new QWidget;
    auto* form = new QFormLayout(details_);
    form->setContentsMargins(0, 0, 0, 0);
    form->addRow(tr("Class"), class_);
    form->addRow(vehicles_);
    form->addRow(upright_);
    form->addRow(tr("Ignored border"), border_);
    details_->hide();

    auto* first = new QHBoxLayout;
    first->addWidget(truth_, 3);
    first->addWidget(measured_, 1);
    auto* second = new QHBoxLayout;
    second->addWidget(overlap_);
    second->addWidget(other_, 1);
    second->addWidget(more_);
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(6, 4, 6, 2);
    rows->setSpacing(4);
    rows->addLayout(first);
    rows->addLayout(second);
    rows->addWidget(details_);
}

bool EvaluationChoices::eventFilter(QObject* watched, QEvent* event) {
    // Scrolling over a field must not change what is measured.
    auto* field = qobject_cast<QWidget*>(watched);
    if (event->type() == QEvent::Wheel && field != nullptr && !field->hasFocus()) {
        event->ignore();
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

void EvaluationChoices::showSettings() {
    const EvaluationSettings& settings = evaluation_.settings();
    const QSignalBlocker blockers[] = {QSignalBlocker(measured_), QSignalBlocker(overlap_), QSignalBlocker(vehicles_),
                                       QSignalBlocker(upright_),  QSignalBlocker(border_),  QSignalBlocker(class_)};
    measured_->setCurrentIndex(settings.detections ? 1 : 0);
    overlap_->setValue(settings.wishes.overlap);
    border_->setValue(settings.wishes.border.value_or(0));
    const std::optional<TrackClass>& one_class = settings.wishes.one_class;
    class_->setCurrentIndex(static_cast<int>(one_class.value_or(TrackClass::unknown)));
    vehicles_->setChecked(settings.wishes.vehicles_only);
    vehicles_->setEnabled(!one_class);
    upright_->setChecked(settings.wishes.upright);
    showRuns();
}

void EvaluationChoices::showRuns() {
    const QSignalBlocker blocker(other_);
    other_->clear();
    other_->addItem(tr("Compare with…"), 0);
    const auto current = session_.currentRun();
    std::string video;
    for (const RunRecord& run : session_.runs())
        if (run.id == current) video = run.sequence.path;
    for (const RunRecord& run : session_.runs()) {
        if (run.id == current || run.sequence.path != video || run.frames_done == 0) continue;
        other_->addItem(tr("against %1").arg(evaluatedRunName(run)), run.id);
        if (evaluation_.settings().other_run == run.id) other_->setCurrentIndex(other_->count() - 1);
    }
    other_->setEnabled(other_->count() > 1);
}

void EvaluationChoices::applySettings() {
    EvaluationSettings settings = evaluation_.settings();
    settings.detections = measured_->currentIndex() == 1;
    settings.wishes.overlap = overlap_->value();
    settings.wishes.border = border_->value() > 0 ? std::optional(border_->value()) : std::nullopt;
    settings.wishes.one_class = scoredClass(scoredClassWords()[static_cast<std::size_t>(class_->currentIndex())]);
    settings.wishes.vehicles_only = vehicles_->isChecked() && !settings.wishes.one_class;
    settings.wishes.upright = upright_->isChecked();
    const int other = other_->currentData().toInt();
    settings.other_run = other > 0 ? std::optional(other) : std::nullopt;
    evaluation_.setSettings(settings);
    showSettings();
}

void EvaluationChoices::useTruthFile(const QString& path) {
    truth_->useFile(path);
}

}  // namespace eyrie::ui

#include "moc_evaluation_choices.cpp"
