#include "tune/compare/comparison_header.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

constexpr int kMostComputed = 1000;  ///< frames, all of which are kept in memory
constexpr int kFramesAtFirst = 200;  ///< computed unless others are chosen
constexpr int kFramesBefore = 50;    ///< … of which before the frame shown
constexpr int kProgressWidth = 160;  ///< logical px
const QString kRun = QStringLiteral("run:");
const QString kPreset = QStringLiteral("preset:");

}  // namespace

ComparisonHeader::ComparisonHeader(ProjectSession& session, PresetLibrary& presets, QWidget* parent)
    : QWidget(parent), session_(session), presets_(presets) {
    first_ = new QComboBox;
    second_ = new QComboBox;
    first_->setAccessibleName(tr("A"));
    second_->setAccessibleName(tr("B"));
    for (QComboBox* box : {first_, second_}) {
        box->setToolTip(
            tr("A run of the project, a preset, or the parameters in the form. Presets and the form are computed from "
               "the motion vectors of a run."));
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(20);
    }
    auto* swap = new QToolButton;
    swap->setText(tr("⇄"));
    swap->setToolTip(tr("Swap A and B"));
    wipe_ = new QToolButton;
    wipe_->setText(tr("Wipe"));
    wipe_->setCheckable(true);
    wipe_->setToolTip(tr("B over A with a divider to drag, instead of side by side (X)"));
    summary_ = new QLabel;
    summary_->setForegroundRole(QPalette::PlaceholderText);
    summary_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    auto* sides = new QHBoxLayout;
    sides->addWidget(new QLabel(tr("A")));
    sides->addWidget(first_, 2);
    sides->addWidget(swap);
    sides->addWidget(new QLabel(tr("B")));
    sides->addWidget(second_, 2);
    sides->addWidget(wipe_);
    sides->addSpacing(12);
    sides->addWidget(summary_, 3);

    range_line_ = new QWidget;
    from_ = new QSpinBox;
    to_ = new QSpinBox;
    from_->setAccessibleName(tr("First frame computed"));
    to_->setAccessibleName(tr("Last frame computed"));
    base_ = new QLabel;
    base_->setForegroundRole(QPalette::PlaceholderText);
    progress_ = new QProgressBar;
    progress_->setFixedWidth(kProgressWidth);
    progress_->hide();
    auto* range = new QHBoxLayout(range_line_);
    range->setContentsMargins(0, 0, 0, 0);
    range->addWidget(new QLabel(tr("Frames")));
    range->addWidget(from_);
    range->addWidget(new QLabel(tr("to")));
    range->addWidget(to_);
    range->addWidget(base_, 1);
    range->addWidget(progress_);
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(4);
    rows->addLayout(sides);
    rows->addWidget(range_line_);

    const auto chosen = [this] {
        adjustRange();
        emit pairChosen();
    };
    bindCommands(this, {{first_, chosen}, {second_, chosen}, {swap, [this] {
                                                                  choose(second_->currentData().toString(),
                                                                         first_->currentData().toString());
                                                              }}});
    for (QSpinBox* box : {from_, to_}) {
        box->setKeyboardTracking(false);
        const auto follow = [this, box] {
            const QSignalBlocker quiet(box == from_ ? to_ : from_);
            if (box == from_)
                to_->setValue(std::clamp(to_->value(), from_->value(), from_->value() + kMostComputed - 1));
            else
                from_->setValue(std::clamp(from_->value(), to_->value() - kMostComputed + 1, to_->value()));
            emit pairChosen();
        };
        onEdited(this, follow, box);
    }
    whenChanged(session_, this, {{SessionChange::runs, [this] { fill(); }}});
    connect(&presets_, &PresetLibrary::changed, this, &ComparisonHeader::fill);
    fill();
}

QString ComparisonHeader::runName(const RunRecord& run) const {
    const std::string& name = run.name.empty() ? run.preset : run.name;
    return tr("Run %1 · %2").arg(run.id).arg(QString::fromStdString(name));
}

void ComparisonHeader::fill() {
    if (!session_.media()) return;
    const QString old_first = first_->currentData().toString();
    const QString old_second = second_->currentData().toString();
    run_count_ = 0;
    for (QComboBox* box : {first_, second_}) {
        const QSignalBlocker quiet(box);
        box->clear();
        for (const RunRecord& run : session_.runs()) {
            if (run.sequence.path != session_.media()->identity || run.frames_done == 0) continue;
            box->addItem(runName(run), runSide(run.id));
        }
        run_count_ = box->count();
        if (run_count_ == 0) continue;
        box->insertSeparator(box->count());
        box->addItem(tr("Parameters of the form"), formSide());
        for (const auto& preset : presets_.presets()) {
            if (!preset.options) continue;
            const QString name = QString::fromStdString(preset.name);
            box->addItem(tr("Preset “%1”").arg(name), presetSide(name));
        }
    }
    const int first = first_->findData(old_first);
    const int second = second_->findData(old_second);
    if (first >= 0 && second >= 0) {
        first_->setCurrentIndex(first);
        second_->setCurrentIndex(second);
        return;
    }
    chooseDefault();
}

void ComparisonHeader::chooseDefault() {
    if (run_count_ == 0) return;
    // The current run beside the newest other one; where there is none, beside what the form would make of it.
    const QString newest = first_->itemData(run_count_ - 1).toString();
    const auto shown = session_.currentRun();
    const QString current = shown && first_->findData(runSide(*shown)) >= 0 ? runSide(*shown) : newest;
    QString other = newest;
    if (current == newest) other = run_count_ > 1 ? first_->itemData(run_count_ - 2).toString() : formSide();
    choose(current, other);
}

bool ComparisonHeader::choose(const QString& first, const QString& second) {
    const int a = first_->findData(first);
    const int b = second_->findData(second);
    if (a < 0 || b < 0) return false;
    first_->setCurrentIndex(a);
    second_->setCurrentIndex(b);
    adjustRange();
    emit pairChosen();
    return true;
}

bool ComparisonHeader::computes() const {
    return !first_->currentData().toString().startsWith(kRun) || !second_->currentData().toString().startsWith(kRun);
}

bool ComparisonHeader::comparesForm() const {
    return first_->currentData().toString() == formSide() || second_->currentData().toString() == formSide();
}

const RunRecord* ComparisonHeader::baseRun() const {
    QString wanted = session_.currentRun() ? runSide(*session_.currentRun()) : QString();
    for (const QComboBox* box : {second_, first_})
        if (box->currentData().toString().startsWith(kRun)) wanted = box->currentData().toString();
    const RunRecord* base = nullptr;
    for (const RunRecord& run : session_.runs()) {
        if (first_->findData(runSide(run.id)) < 0) continue;
        base = &run;
        if (runSide(run.id) == wanted) break;
    }
    return base;
}

void ComparisonHeader::adjustRange() {
    range_line_->setVisible(computes());
    const RunRecord* base = baseRun();
    if (base == nullptr) return;
    const FrameIndex last = base->first_frame + base->frames_done - 1;
    base_->setText(tr("computed on the motion vectors of %1").arg(runName(*base)));
    if (from_->minimum() == base->first_frame && from_->maximum() == last && to_->value() > from_->value()) return;
    const QSignalBlocker quiet_from(from_);
    const QSignalBlocker quiet_to(to_);
    for (QSpinBox* box : {from_, to_}) box->setRange(base->first_frame, last);
    const FrameIndex from =
        std::max(base->first_frame, std::min(session_.currentFrame() - kFramesBefore, last - kFramesAtFirst + 1));
    from_->setValue(from);
    to_->setValue(from + kFramesAtFirst - 1);
}

void ComparisonHeader::setRange(FrameIndex first, FrameIndex last) {
    {
        const QSignalBlocker quiet(from_);
        from_->setValue(first);
    }
    const QSignalBlocker quiet(to_);
    to_->setValue(std::clamp(last, from_->value(), from_->value() + kMostComputed - 1));
    emit pairChosen();
}

ComparisonSide ComparisonHeader::sideOf(const QComboBox& box, int base_run) const {
    const QString chosen = box.currentData().toString();
    if (chosen.startsWith(kRun)) return {chosen.mid(kRun.size()).toInt(), nullptr};
    if (chosen == formSide()) return {base_run, std::make_shared<const ChainOptions>(session_.settings().options)};
    const PresetLibrary::Preset* preset = presets_.find(chosen.mid(kPreset.size()).toStdString());
    return {base_run, preset != nullptr ? preset->options : nullptr};
}

std::optional<ComparisonPair> ComparisonHeader::pair() const {
    const RunRecord* base = baseRun();
    if (!session_.media() || base == nullptr || first_->currentIndex() < 0 || second_->currentIndex() < 0)
        return std::nullopt;
    ComparisonPair pair;
    pair.media = *session_.media();
    pair.project = session_.project();
    pair.first = sideOf(*first_, base->id);
    pair.second = sideOf(*second_, base->id);
    pair.range = {from_->value(), to_->value()};
    return pair;
}

QString ComparisonHeader::firstName() const {
    return first_->currentText();
}

QString ComparisonHeader::secondName() const {
    return second_->currentText();
}

void ComparisonHeader::setSummary(const QString& text) {
    summary_->setText(text);
    summary_->setToolTip(text);
}

QString ComparisonHeader::summary() const {
    return summary_->text();
}

void ComparisonHeader::showProgress(int done, int total) {
    progress_->setVisible(done < total);
    progress_->setMaximum(total);
    progress_->setValue(done);
    progress_->setFormat(tr("%v of %m frames"));
}

}  // namespace eyrie::ui

#include "moc_comparison_header.cpp"
