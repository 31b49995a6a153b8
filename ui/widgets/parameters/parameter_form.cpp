#include "widgets/parameters/parameter_form.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/layout/collapsible_section.h"
#include "widgets/parameters/parameter_row.h"
#include "widgets/wiring.h"

namespace eyrie::ui {
namespace {

constexpr int kHelpLines = 5;

std::string groupOf(const std::string& name) {
    return name.substr(0, name.find('.'));
}

/// "Registration" for "registration".
QString titleOf(const std::string& group) {
    QString title = QString::fromStdString(group).replace(QLatin1Char('_'), QLatin1Char(' '));
    if (!title.isEmpty()) title[0] = title[0].toUpper();
    return title;
}

bool sameDeclaration(const Parameter& a, const Parameter& b) {
    return a.name == b.name && a.kind == b.kind && a.min == b.min && a.max == b.max && a.choices == b.choices;
}

}  // namespace

ParameterForm::ParameterForm(QWidget* parent)
    : QWidget(parent),
      presets_(new QComboBox(this)),
      save_preset_(new QToolButton(this)),
      search_(new QLineEdit(this)),
      modified_only_(new QToolButton(this)),
      reset_all_(new QToolButton(this)),
      scroll_(new QScrollArea(this)),
      rows_area_(new QWidget(this)),
      rows_layout_(new QVBoxLayout(rows_area_)),
      nothing_(new QLabel(this)),
      help_(new QLabel(this)) {
    nothing_->setWordWrap(true);
    nothing_->setAlignment(Qt::AlignCenter);
    rows_layout_->setContentsMargins(0, 0, 0, 0);
    rows_layout_->addWidget(nothing_);
    rows_layout_->addStretch(1);
    scroll_->setWidget(rows_area_);
    scroll_->setWidgetResizable(true);
    scroll_->setFrameShape(QFrame::NoFrame);
    scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);

    help_->setWordWrap(true);
    help_->setTextFormat(Qt::RichText);
    help_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    help_->setMinimumHeight(help_->fontMetrics().lineSpacing() * kHelpLines);
    help_->setText(tr("Point at a parameter to read what it does."));

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(4, 4, 4, 4);
    layout->addWidget(makePresetLine());
    layout->addWidget(makeSearchLine());
    layout->addWidget(scroll_, 1);
    layout->addWidget(help_);
    refresh();
}

QWidget* ParameterForm::makePresetLine() {
    auto* line = new QWidget(this);
    auto* layout = new QHBoxLayout(line);
    layout->setContentsMargins(0, 0, 0, 0);
    auto* label = new QLabel(tr("Preset"), line);
    label->setBuddy(presets_);
    presets_->setToolTip(tr("Start from these values"));
    save_preset_->setText(tr("Save as…"));
    save_preset_->setToolTip(tr("Save the current values as a preset"));
    layout->addWidget(label);
    layout->addWidget(presets_, 1);
    layout->addWidget(save_preset_);
    auto* all = new QToolButton(line);
    all->setText(tr("Presets…"));
    all->setToolTip(tr("Compare, rename, delete, export and import presets"));
    layout->addWidget(all);
    bindCommands(this, {{presets_, [this] { emit presetChosen(presets_->currentText()); }},
                        {all, [this] { commands_.show_presets(); }},
                        {save_preset_, [this] { commands_.save_preset(); }}});
    return line;
}

QWidget* ParameterForm::makeSearchLine() {
    auto* line = new QWidget(this);
    auto* layout = new QHBoxLayout(line);
    layout->setContentsMargins(0, 0, 0, 0);
    search_->setPlaceholderText(tr("Search names and help"));
    search_->setClearButtonEnabled(true);
    search_->setAccessibleName(tr("Search the parameters"));
    modified_only_->setCheckable(true);
    modified_only_->setText(tr("Modified"));
    modified_only_->setToolTip(tr("Show only what differs from the defaults"));
    reset_all_->setText(tr("Reset all"));
    reset_all_->setToolTip(tr("Set everything back to the defaults"));
    layout->addWidget(search_, 1);
    layout->addWidget(modified_only_);
    layout->addWidget(reset_all_);
    onEdited(this, &ParameterForm::refresh, search_, modified_only_);
    bindCommands(this, {{reset_all_, [this] { resetAll(); }}});
    return line;
}

bool ParameterForm::hasRowsFor(const std::vector<Parameter>& parameters) const {
    return std::equal(parameters.begin(), parameters.end(), declarations_.begin(), declarations_.end(),
                      sameDeclaration);
}

void ParameterForm::makeRows(const std::vector<Parameter>& parameters) {
    for (const Group& group : groups_) {
        rows_layout_->removeWidget(group.section);
        group.section->hide();
        group.section->deleteLater();  // one of its rows may be telling a change right now
    }
    groups_.clear();
    rows_.clear();
    declarations_ = parameters;
    std::map<std::string, std::size_t> place_of_group;
    for (const Parameter& parameter : parameters) {
        const auto [place, is_new] = place_of_group.try_emplace(groupOf(parameter.name), groups_.size());
        if (is_new) {
            const QString title = titleOf(place->first);
            groups_.push_back({title, new CollapsibleSection(title, rows_area_), {}});
            // Above the stretch that ends the column.
            rows_layout_->insertWidget(rows_layout_->count() - 1, groups_.back().section);
        }
        Group& group = groups_[place->second];
        auto* row = new ParameterRow(parameter, group.section);
        row->setReadOnly(read_only_);
        group.section->addRow(row);
        group.rows.push_back(row);
        rows_.push_back(row);
        connect(row, &ParameterRow::valueChanged, this, &ParameterForm::onRowChanged);
        connect(row, &ParameterRow::pointedAt, this, [this, row] {
            help_->setText(row->helpText());
            emit pointedAt(row->name());
        });
    }
}

void ParameterForm::setParameters(const std::vector<Parameter>& current, const std::vector<Parameter>& defaults) {
    if (!hasRowsFor(current)) makeRows(current);
    std::map<std::string, std::string> default_values;
    for (const Parameter& parameter : defaults) default_values[parameter.name] = parameter.value;
    for (std::size_t i = 0; i < current.size(); ++i) {
        const auto known = default_values.find(current[i].name);
        const std::string& default_value = known == default_values.end() ? current[i].value : known->second;
        rows_[i]->setValues(QString::fromStdString(current[i].value), QString::fromStdString(default_value));
    }
    refresh();
}

std::vector<std::pair<std::string, std::string>> ParameterForm::values() const {
    std::vector<std::pair<std::string, std::string>> values;
    for (const ParameterRow* row : rows_) values.emplace_back(row->name().toStdString(), row->value().toStdString());
    return values;
}

int ParameterForm::modifiedCount() const {
    return static_cast<int>(
        std::count_if(rows_.begin(), rows_.end(), [](const ParameterRow* row) { return row->isModified(); }));
}

void ParameterForm::onRowChanged(const QString& name, const QString& value) {
    refresh();
    emit valueChanged(name, value);
}

void ParameterForm::refresh() {
    const QStringList words = search_->text().simplified().split(QLatin1Char(' '), Qt::SkipEmptyParts);
    const bool modified_only = modified_only_->isChecked();
    bool any_shown = false;
    for (const Group& group : groups_) {
        int shown = 0;
        int modified = 0;
        for (ParameterRow* row : group.rows) {
            // A row that is being edited does not vanish under the hands of who edits it.
            const bool is_edited = row->isAncestorOf(focusWidget());
            const bool fits = row->matches(words) && (!modified_only || row->isModified() || is_edited);
            row->setVisible(fits);
            shown += fits ? 1 : 0;
            modified += row->isModified() ? 1 : 0;
        }
        group.section->setVisible(shown > 0);
        group.section->setForcedOpen(!words.isEmpty() || modified_only);
        group.section->setTitle(modified > 0 ? tr("%1 · %n modified", nullptr, modified).arg(group.title)
                                             : group.title);
        any_shown = any_shown || shown > 0;
    }
    nothing_->setVisible(!any_shown);
    nothing_->setText(rows_.empty()      ? tr("No parameters.")
                      : !words.isEmpty() ? tr("No parameter has “%1” in its name or help.").arg(search_->text())
                                         : tr("Nothing differs from the defaults."));
    reset_all_->setEnabled(!read_only_ && isModified());
}

void ParameterForm::setPresets(const QStringList& names, const QString& current) {
    presets_->clear();
    presets_->addItems(names);
    presets_->setCurrentIndex(names.indexOf(current));
}

void ParameterForm::setReadOnly(bool read_only) {
    read_only_ = read_only;
    for (ParameterRow* row : rows_) row->setReadOnly(read_only);
    presets_->setEnabled(!read_only);
    save_preset_->setEnabled(!rows_.empty());
    refresh();
}

void ParameterForm::setFilterText(const QString& text) {
    search_->setText(text);
}

void ParameterForm::setModifiedOnly(bool modified_only) {
    modified_only_->setChecked(modified_only);
}

bool ParameterForm::reveal(const QString& name) {
    for (const Group& group : groups_) {
        for (ParameterRow* row : group.rows) {
            if (row->name() != name) continue;
            search_->clear();
            modified_only_->setChecked(false);
            group.section->setExpanded(true);
            help_->setText(row->helpText());
            // Sections that were folded take their room with the next layout.
            QTimer::singleShot(0, row, [this, row] {
                scroll_->ensureWidgetVisible(row, 0, scroll_->height() / 3);
                row->setFocus();
                row->flash();
            });
            return true;
        }
    }
    return false;
}

void ParameterForm::resetAll() {
    if (read_only_) return;
    for (ParameterRow* row : rows_) row->resetToDefault();
}

}  // namespace eyrie::ui

#include "moc_parameter_form.cpp"
