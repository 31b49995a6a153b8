#include "window/earlier_state_dialog.h"

#include <QDateTime>
#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QLocale>
#include <QPushButton>
#include <QVBoxLayout>

#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

/// "21.11.26 09:00, first use that day, 12 MB".
QString titleOf(const ProjectBackup& backup) {
    const QDateTime made = QDateTime::fromSecsSinceEpoch(backup.made.time_since_epoch().count());
    const QLocale locale;
    return EarlierStateDialog::tr("%1, %2, %3")
        .arg(locale.toString(made, QLocale::ShortFormat), QString::fromUtf8(nameOf(backup.reason)),
             locale.formattedDataSize(static_cast<qint64>(backup.bytes)));
}

}  // namespace

EarlierStateDialog::EarlierStateDialog(const std::filesystem::path& project, EarlierStateCommands commands,
                                       QWidget* parent)
    : QDialog(parent), commands_(std::move(commands)) {
    setObjectName(QStringLiteral("earlier_states"));
    setWindowTitle(tr("Restore an earlier state of %1").arg(QString::fromStdString(project.filename().string())));
    resize(720, 360);
    list_ = new QListWidget(this);
    differences_ = new QLabel(tr("Reading the kept states…"), this);
    differences_->setWordWrap(true);
    differences_->setTextFormat(Qt::PlainText);
    differences_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    differences_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* columns = new QHBoxLayout;
    columns->addWidget(list_, 1);
    columns->addWidget(differences_, 1);
    auto* note = new QLabel(tr("The project's state is kept at the start of each day of use. The present state is kept "
                               "before another one replaces it."),
                            this);
    note->setWordWrap(true);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    restore_ = buttons->addButton(tr("Restore"), QDialogButtonBox::AcceptRole);
    open_ = buttons->addButton(tr("Open as a new project"), QDialogButtonBox::ActionRole);
    auto* rows = new QVBoxLayout(this);
    rows->addWidget(note);
    rows->addLayout(columns, 1);
    rows->addWidget(buttons);
    connect(list_, &QListWidget::currentRowChanged, this, &EarlierStateDialog::choose);
    bindCommands(this, {{restore_, [this] { answer(commands_.restore); }},
                        {open_, [this] { answer(commands_.open_as_new); }},
                        {buttons->button(QDialogButtonBox::Cancel), [this] { reject(); }}});
    choose(-1);
}

void EarlierStateDialog::answer(const std::function<void(const ProjectBackup& backup)>& command) {
    const auto row = static_cast<std::size_t>(list_->currentRow());
    if (row >= shown_.size()) return;
    const ProjectBackup chosen = shown_[row].backup;
    accept();
    command(chosen);
}

void EarlierStateDialog::show(const std::vector<EarlierState>& states) {
    shown_ = states;
    list_->clear();
    for (const EarlierState& state : shown_) list_->addItem(titleOf(state.backup));
    if (shown_.empty())
        differences_->setText(tr("No earlier state is kept yet. One is kept on each day of use."));
    else
        list_->setCurrentRow(0);
}

void EarlierStateDialog::showProblem(const QString& text) {
    differences_->setText(text);
}

void EarlierStateDialog::choose(int row) {
    const bool any = row >= 0 && static_cast<std::size_t>(row) < shown_.size();
    restore_->setEnabled(any);
    open_->setEnabled(any);
    if (!any) return;
    const QStringList& lines = shown_[static_cast<std::size_t>(row)].differences;
    differences_->setText(lines.isEmpty() ? tr("Nothing is different in it.")
                                          : tr("With it in place of the present state:\n\n%1")
                                                .arg(QStringLiteral("• ") + lines.join(QStringLiteral("\n• "))));
}

}  // namespace eyrie::ui

#include "moc_earlier_state_dialog.cpp"
