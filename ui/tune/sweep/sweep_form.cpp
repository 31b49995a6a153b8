#include "tune/sweep/sweep_form.h"

#include <QComboBox>
#include <QCompleter>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>
#include <algorithm>
#include <cmath>
#include <set>

#include "io/tables/number_text.h"
#include "tune/evaluate/evaluation_session.h"
#include "tune/evaluate/truth_choice.h"
#include "widgets/theme_colours.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

/// Values around the present one that are worth a first look: eight steps up and down within the range.
QString suggestionFor(const Parameter& parameter) {
    if (parameter.kind == ParameterKind::flag) return QStringLiteral("false,true");
    if (parameter.kind == ParameterKind::choice) {
        QStringList words;
        for (const std::string& word : parameter.choices) words << QString::fromStdString(word);
        return words.join(QLatin1Char(','));
    }
    if (parameter.kind == ParameterKind::words) return {};
    const double value = parseReal(parameter.value).value_or(0);
    double step = std::pow(10.0, std::floor(std::log10(std::max(std::abs(value), 1e-3) / 4)));
    if (step * 10 <= std::abs(value) / 2) step *= 2;
    if (parameter.kind == ParameterKind::integer) step = std::max(1.0, std::round(step));
    const double from = std::max(std::ceil(parameter.min / step) * step, value - 8 * step);
    const double to = std::min(parameter.max, value + 8 * step);
    const auto number = [](double at) { return QString::number(at, 'g', 6); };
    return number(std::max(from, parameter.min)) + QLatin1Char(':') + number(step) + QLatin1Char(':') + number(to);
}

}  // namespace

SweepForm::SweepForm(EvaluationSession& evaluation, QWidget* parent) : QWidget(parent), evaluation_(evaluation) {
    // One field below the other: a dock is narrow.
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(8, 6, 8, 6);
    grid->setHorizontalSpacing(6);
    grid->setVerticalSpacing(4);
    axes_.push_back(addAxis(*grid, tr("Change")));
    axes_.push_back(addAxis(*grid, tr("and")));
    const auto add = [&](const QString& title, QWidget* field) {
        const int row = grid->rowCount();
        auto* label = new QLabel(title, this);
        label->setBuddy(field);
        grid->addWidget(label, row, 0);
        grid->addWidget(field, row, 1);
    };
    over_ = new QToolButton(this);
    over_->setPopupMode(QToolButton::InstantPopup);
    over_->setToolButtonStyle(Qt::ToolButtonTextOnly);
    over_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    over_->setMenu(new QMenu(over_));
    over_->setToolTip(
        tr("Runs whose motion vectors are swept over together, with the parameters of the run that is shown. The "
           "figures of a point are those over all of them"));
    add(tr("Over"), over_);
    add(tr("Against"), new TruthChoice(evaluation_, this));
    overlaps_ = new QLineEdit(QStringLiteral("0.1, 0.2, 0.3"), this);
    overlaps_->setToolTip(tr("Smallest overlap T_ov at which a box counts as found; several are possible"));
    add(tr("T_ov"), overlaps_);
    count_ = new QLabel(this);
    start_ = new QPushButton(tr("Start"), this);
    start_->setObjectName(QStringLiteral("sweep_start"));
    auto* last = new QHBoxLayout;
    last->addWidget(count_, 1);
    last->addWidget(start_);
    grid->addLayout(last, grid->rowCount(), 0, 1, 2);
    grid->setColumnStretch(1, 1);
    bindCommands(this, {{start_, [this] { start(); }}});
    refresh();
}

SweepForm::Axis SweepForm::addAxis(QGridLayout& grid, const QString& title) {
    Axis axis{new QComboBox(this), new QLineEdit(this), new QLabel(this)};
    const bool first = axes_.empty();
    axis.name->setEditable(true);
    axis.name->setInsertPolicy(QComboBox::NoInsert);
    axis.name->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    axis.name->setMinimumContentsLength(14);
    axis.name->completer()->setFilterMode(Qt::MatchContains);
    axis.name->completer()->setCompletionMode(QCompleter::PopupCompletion);
    axis.name->lineEdit()->setPlaceholderText(first ? tr("parameter") : tr("a second one, if wanted"));
    axis.values->setPlaceholderText(tr("first:step:last, or a list"));
    axis.hint->setWordWrap(true);
    const int row = grid.rowCount();
    grid.addWidget(new QLabel(title, this), row, 0);
    grid.addWidget(axis.name, row, 1);
    grid.addWidget(axis.values, row + 1, 1);
    grid.addWidget(axis.hint, row + 2, 1);
    const auto index = axes_.size();
    connect(axis.name, &QComboBox::currentTextChanged, this, [this, index] {
        if (index < axes_.size()) suggestValues(axes_[index]);
        refresh();
    });
    onEdited(this, &SweepForm::refresh, axis.values);
    connect(axis.values, &QLineEdit::returnPressed, this, &SweepForm::start);
    return axis;
}

void SweepForm::setParameters(const std::vector<Parameter>& parameters) {
    const bool same_names = std::equal(parameters.begin(), parameters.end(), parameters_.begin(), parameters_.end(),
                                       [](const Parameter& a, const Parameter& b) { return a.name == b.name; });
    parameters_ = parameters;
    if (!same_names) {
        QStringList names{QString()};
        for (const Parameter& parameter : parameters_) names << QString::fromStdString(parameter.name);
        for (const Axis& axis : axes_) {
            const QString before = axis.name->currentText();
            const QString values = axis.values->text();
            axis.name->clear();
            axis.name->addItems(names);
            axis.name->setCurrentText(before);
            axis.values->setText(values);
        }
    }
    refresh();
}

void SweepForm::setRun(const QString& run) {
    run_ = run;
    refresh();
}

void SweepForm::setRuns(const std::vector<std::pair<int, QString>>& runs, std::optional<int> shown) {
    std::set<int> chosen;
    for (const auto& [run, action] : runs_)
        if (action->isChecked() && action->isEnabled()) chosen.insert(run);
    runs_.clear();
    over_->menu()->clear();
    for (const auto& [run, name] : runs) {
        QAction* action = over_->menu()->addAction(name, this, &SweepForm::showRuns);
        action->setCheckable(true);
        action->setChecked(run == shown || chosen.contains(run));
        action->setEnabled(run != shown);  // it is always swept over
        runs_[run] = action;
    }
    showRuns();
}

void SweepForm::showRuns() {
    QStringList others;
    for (const auto& [run, action] : runs_)
        if (action->isChecked() && action->isEnabled()) others << QString::number(run);
    over_->setEnabled(!run_.isEmpty() && runs_.size() > 1);
    over_->setText(run_.isEmpty()     ? tr("no run yet")
                   : others.isEmpty() ? tr("%1 alone").arg(run_)
                                      : tr("%1 and %2").arg(run_, others.join(QStringLiteral(", "))));
    if (run_.isEmpty()) return;
    start_->setText(others.isEmpty() ? tr("Sweep over %1").arg(run_) : tr("Sweep over %1 runs").arg(others.size() + 1));
}

void SweepForm::setRunning(bool running) {
    running_ = running;
    refresh();
}

QString SweepForm::unitOf(const std::string& name) const {
    for (const Parameter& parameter : parameters_) {
        if (parameter.name == name) return QString::fromStdString(parameter.text.unit);
    }
    return {};
}

void SweepForm::setAxis(int axis, const QString& name, const QString& values) {
    const Axis& chosen = axes_[static_cast<std::size_t>(axis)];
    chosen.name->setCurrentText(name);
    chosen.values->setText(values);
}

const Parameter* SweepForm::parameterOf(const Axis& axis) const {
    const std::string name = axis.name->currentText().trimmed().toStdString();
    const auto found =
        std::find_if(parameters_.begin(), parameters_.end(), [&](const Parameter& p) { return p.name == name; });
    return found == parameters_.end() ? nullptr : &*found;
}

void SweepForm::suggestValues(const Axis& axis) {
    if (const Parameter* parameter = parameterOf(axis)) axis.values->setText(suggestionFor(*parameter));
}

void SweepForm::refresh() {
    if (axes_.size() < 2) return;
    double points = 1;
    bool complete = parameterOf(axes_[0]) != nullptr;
    for (const Axis& axis : axes_) {
        const Parameter* parameter = parameterOf(axis);
        const QString name = axis.name->currentText().trimmed();
        axis.hint->setVisible(!name.isEmpty());
        axis.values->setVisible(!name.isEmpty());
        if (name.isEmpty()) continue;
        if (parameter == nullptr) {
            axis.hint->setText(tr("There is no such parameter."));
            complete = false;
            continue;
        }
        axis.hint->setText(tr("%1; now %2")
                               .arg(QString::fromStdString(parameter->expected()).toHtmlEscaped(),
                                    QString::fromStdString(parameter->value).toHtmlEscaped()));
        axis.hint->setToolTip(QString::fromStdString(parameter->text.help));
        points *= countValues(axis.values->text().toStdString());
    }
    if (complete && points <= 0) {
        count_->setText(tr("No value to try"));
        complete = false;
    } else {
        count_->setText(!complete     ? QString()
                        : points == 1 ? tr("1 point")
                                      : tr("%1 points").arg(QLocale().toString(points, 'f', 0)));
    }
    start_->setText(tr("Start"));
    showRuns();
    start_->setEnabled(complete && !running_ && !run_.isEmpty());
    start_->setToolTip(
        run_.isEmpty()
            ? tr("Run the video first, or choose a run")
            : tr("Motion vectors are taken from the run; every stage behind the changed parameters is computed again"));
}

SweepRequest SweepForm::request() const {
    SweepRequest request;
    for (const Axis& axis : axes_) {
        const QString name = axis.name->currentText().trimmed();
        if (!name.isEmpty())
            request.axes.push_back((name + QLatin1Char('=') + axis.values->text().trimmed()).toStdString());
    }
    for (const auto& [run, action] : runs_)
        if (action->isChecked() && action->isEnabled()) request.other_runs.push_back(run);
    request.truth_file = evaluation_.settings().truth_file;
    request.wishes = evaluation_.settings().wishes;
    request.overlaps.clear();
    for (const QString& part : overlaps_->text().split(QLatin1Char(','), Qt::SkipEmptyParts))
        request.overlaps.push_back(parseReal(part.trimmed().toStdString()).value_or(-1));
    return request;
}

void SweepForm::start() {
    if (start_->isEnabled()) emit startRequested(request());
}

}  // namespace eyrie::ui

#include "moc_sweep_form.cpp"
