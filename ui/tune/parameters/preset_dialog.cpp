#include "tune/parameters/preset_dialog.h"

#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QInputDialog>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSplitter>
#include <QTableWidget>
#include <QVBoxLayout>

#include "tune/compare/live_preview.h"
#include "widgets/tables/table_look.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

/// Long values are cut off in the table; the tooltip has them whole.
QTableWidgetItem* presetCell(const QString& text) {
    auto* item = new QTableWidgetItem(text);
    item->setToolTip(text);
    return item;
}

QString text(const std::string& words) {
    return QString::fromStdString(words);
}

}  // namespace

PresetDialog::PresetDialog(PresetLibrary& presets, ChainOptions present, QWidget* parent)
    : QDialog(parent), presets_(presets), present_(std::move(present)) {
    setWindowTitle(tr("Presets"));
    resize(900, 520);
    list_ = tableToRead({tr("Preset"), tr("Stored in"), tr("Saved")});
    other_ = new QComboBox;
    other_->setAccessibleName(tr("Compare with"));
    differences_ = tableToRead({tr("Parameter"), tr("Preset"), tr("Compared with")});
    message_ = new QLabel;
    message_->setWordWrap(true);
    auto* right = new QWidget;
    auto* column = new QVBoxLayout(right);
    column->setContentsMargins(0, 0, 0, 0);
    auto* compare_line = new QHBoxLayout;
    compare_line->addWidget(new QLabel(tr("Compare with")));
    compare_line->addWidget(other_, 1);
    column->addLayout(compare_line);
    column->addWidget(differences_, 1);
    auto* splitter = new QSplitter;
    splitter->addWidget(list_);
    splitter->addWidget(right);
    splitter->setSizes({380, 520});
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(splitter, 1);
    layout->addWidget(message_);
    layout->addWidget(buildButtons());
    connect(list_, &QTableWidget::currentCellChanged, this, &PresetDialog::compare);
    onEdited(this, &PresetDialog::compare, other_);
    connect(&presets_, &PresetLibrary::changed, this, &PresetDialog::refresh);
    refresh();
    select(QStringLiteral("default"));
}

QWidget* PresetDialog::buildButtons() {
    auto* line = new QWidget;
    auto* layout = new QHBoxLayout(line);
    layout->setContentsMargins(0, 0, 0, 0);
    const auto button = [&](const QString& title, const std::function<void()>& work) {
        auto* made = new QPushButton(title);
        made->setAutoDefault(false);
        layout->addWidget(made);
        bindCommands(this, {{made, work}});
        return made;
    };
    rename_ = button(tr("Rename…"), [this] {
        bool accepted = false;
        const QString name =
            QInputDialog::getText(this, tr("Rename preset"), tr("New name:"), QLineEdit::Normal, selected(), &accepted);
        if (accepted) renameSelected(name);
    });
    remove_ = button(tr("Delete…"), [this] {
        const auto answer = QMessageBox::question(this, tr("Delete preset"), tr("Delete “%1”?").arg(selected()));
        if (answer == QMessageBox::Yes) removeSelected();
    });
    button(tr("Import…"), [this] {
        const QString file = QFileDialog::getOpenFileName(this, tr("Import preset"), {}, tr("Presets (*.json)"));
        if (!file.isEmpty()) importFile(file);
    });
    export_ = button(tr("Export…"), [this] {
        QString file = QFileDialog::getSaveFileName(this, tr("Export preset"), selected() + QStringLiteral(".json"),
                                                    tr("Presets (*.json)"));
        if (!file.isEmpty()) exportSelected(file);
    });
    layout->addStretch(1);
    use_ = button(tr("Use"), [this] {
        emit useRequested(selected());
        accept();
    });
    button(tr("Close"), [this] { reject(); });
    return line;
}

void PresetDialog::refresh() {
    const QString before = selected();
    const QString other_before = other_->currentText();
    const QSignalBlocker quiet(list_);
    const QSignalBlocker quiet_other(other_);
    const auto& entries = presets_.presets();
    list_->setRowCount(static_cast<int>(entries.size()));
    other_->clear();
    for (int row = 0; row < list_->rowCount(); ++row) {
        const auto& entry = entries[static_cast<std::size_t>(row)];
        list_->setItem(row, 0, presetCell(text(entry.name)));
        list_->setItem(row, 1,
                       new QTableWidgetItem(entry.origin == PresetStore::Origin::built_in  ? tr("the program")
                                            : entry.origin == PresetStore::Origin::project ? tr("this project")
                                                                                           : tr("your settings")));
        list_->setItem(
            row, 2, new QTableWidgetItem(text(entry.saved_utc).left(16).replace(QLatin1Char('T'), QLatin1Char(' '))));
        list_->item(row, 0)->setData(Qt::UserRole, static_cast<int>(entry.origin));
        other_->addItem(text(entry.name));
    }
    other_->addItem(tr("the parameters of the form"));
    list_->resizeColumnsToContents();
    other_->setCurrentIndex(std::max(0, other_->findText(other_before)));
    select(before);
    compare();
}

void PresetDialog::select(const QString& name) {
    for (int row = 0; row < list_->rowCount(); ++row)
        if (list_->item(row, 0)->text() == name) list_->setCurrentCell(row, 0);
}

QString PresetDialog::selected() const {
    const QTableWidgetItem* item = list_->item(list_->currentRow(), 0);
    return item != nullptr ? item->text() : QString();
}

QString PresetDialog::message() const {
    return message_->text();
}

void PresetDialog::compare() {
    const QTableWidgetItem* item = list_->item(list_->currentRow(), 0);
    const bool built_in =
        item != nullptr && item->data(Qt::UserRole).toInt() == static_cast<int>(PresetStore::Origin::built_in);
    for (QPushButton* button : {rename_, remove_}) button->setEnabled(item != nullptr && !built_in);
    for (QPushButton* button : {use_, export_}) button->setEnabled(item != nullptr);
    differences_->setRowCount(0);
    if (item == nullptr) return;
    const bool with_form = other_->currentIndex() == other_->count() - 1;
    const ChainOptions* other = with_form ? &present_ : optionsOf(other_->currentText());
    const ChainOptions* chosen = optionsOf(selected());
    if (other == nullptr || chosen == nullptr) return;
    const auto differences = differencesBetween(*chosen, *other);
    differences_->setRowCount(static_cast<int>(differences.size()));
    for (int row = 0; row < differences_->rowCount(); ++row) {
        const ParameterDifference& d = differences[static_cast<std::size_t>(row)];
        differences_->setItem(row, 0, presetCell(text(d.name)));
        differences_->setItem(row, 1, presetCell(text(d.first)));
        differences_->setItem(row, 2, presetCell(text(d.second)));
    }
    differences_->resizeColumnsToContents();
    const QString with = other_->currentText();
    if (!with_form && with == selected())
        message_->setText(tr("Choose another preset, or another one to compare it with."));
    else if (differences.empty())
        message_->setText(tr("“%1” is the same as %2.").arg(selected(), with));
    else if (differences.size() == 1)
        message_->setText(tr("“%1” differs from %2 in one parameter.").arg(selected(), with));
    else
        message_->setText(tr("“%1” differs from %2 in %3 parameters.").arg(selected(), with).arg(differences.size()));
}

const ChainOptions* PresetDialog::optionsOf(const QString& name) {
    const PresetLibrary::Preset* preset = presets_.find(name.toStdString());
    if (preset == nullptr || !preset->options) {
        message_->setText(preset != nullptr ? preset->problem : tr("There is no preset “%1”.").arg(name));
        return nullptr;
    }
    return preset->options.get();
}

PresetLibrary::Answer PresetDialog::then(const QString& said) {
    return [this, said](const QString& name, const QString& problem) {
        if (problem.isEmpty()) {
            const QString shown = name.isEmpty() ? QStringLiteral("default") : name;
            if (shown != selected()) select(shown);
        }
        const QString text = problem.isEmpty() ? said : problem;
        if (!text.isEmpty()) message_->setText(text);
    };
}

void PresetDialog::renameSelected(const QString& name) {
    presets_.rename(selected().toStdString(), name.toStdString(), this, then({}));
}

void PresetDialog::removeSelected() {
    presets_.remove(selected().toStdString(), this, then({}));
}

void PresetDialog::importFile(const QString& file) {
    presets_.importFile(file.toStdString(), this, then({}));
}

void PresetDialog::exportSelected(const QString& file) {
    presets_.exportFile(selected().toStdString(), file.toStdString(), this, then(tr("Wrote %1.").arg(file)));
}

}  // namespace eyrie::ui

#include "moc_preset_dialog.cpp"
