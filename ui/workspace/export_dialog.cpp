#include "workspace/export_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSettings>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "core/error.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {
const QString kFolder = QStringLiteral("export/folder");
constexpr QSize kReportSize(460, 150);
}  // namespace

ExportDialog::ExportDialog(ExportSource source, QWidget* parent)
    : QDialog(parent),
      source_(std::move(source)),
      form_(new QFormLayout),
      format_(new QComboBox),
      holds_(new QLabel),
      target_(new QLineEdit),
      columns_(new QLineEdit(QStringLiteral("frame,id,cname,x1,y1,x2,y2"))),
      clip_(new QCheckBox(tr("Clip boxes to the image"))),
      text_(new QPlainTextEdit) {
    setWindowTitle(source_.title);
    for (const ExportOffer& each : source_.offers) format_->addItem(each.title, each.name);
    holds_->setWordWrap(true);
    text_->setReadOnly(true);
    text_->setPlaceholderText(source_.offers.size() > 1
                                  ? tr("What was written, and what the format cannot hold, is listed here.")
                                  : tr("What was written is told here."));
    text_->setMinimumSize(kReportSize);
    auto* choose = new QPushButton(tr("Choose…"));
    auto* place = new QHBoxLayout;
    place->addWidget(target_, 1);
    place->addWidget(choose);
    form_->addRow(tr("Format"), format_);
    form_->addRow(tr("Holds"), holds_);
    form_->addRow(tr("Columns"), columns_);
    form_->addRow(tr("To"), place);
    form_->addRow(clip_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    QPushButton* close = buttons->button(QDialogButtonBox::Close);
    export_ = buttons->addButton(tr("Export"), QDialogButtonBox::ActionRole);
    export_->setDefault(true);
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(form_);
    layout->addWidget(text_, 1);
    layout->addWidget(buttons);
    onEdited(
        this, [this] { showFormat(); }, format_);
    bindCommands(this,
                 {{choose, [this] { browse(); }}, {export_, [this] { startExport(); }}, {close, [this] { reject(); }}});
    form_->setRowVisible(format_, source_.offers.size() > 1);
    showFormat();
}

ExportDialog::~ExportDialog() = default;

const ExportOffer& ExportDialog::offer() const {
    return source_.offers[std::max(0, format_->currentIndex())];
}

void ExportDialog::addRow(const QString& label, QWidget* row) {
    constexpr int kAboveColumns = 2;
    form_->insertRow(kAboveColumns, label, row);
}

void ExportDialog::showFormat() {
    holds_->setText(offer().holds);
    form_->setRowVisible(holds_, !offer().holds.isEmpty());
    form_->setRowVisible(columns_, offer().asks_columns);
    form_->setRowVisible(clip_, offer().clips);
}

void ExportDialog::browse() {
    QSettings settings;
    const QString folder = settings.value(kFolder, QDir::homePath()).toString();
    QString suggestion = source_.name;
    if (!offer().ending.isEmpty()) suggestion += QLatin1Char('.') + offer().ending;
    const QString path =
        QFileDialog::getSaveFileName(this, source_.title, QDir(folder).filePath(suggestion), tr("All files (*)"));
    if (path.isEmpty()) return;
    settings.setValue(kFolder, QFileInfo(path).path());
    target_->setText(path);
    agreed_ = path;  // the file dialog asks
}

void ExportDialog::setFormat(const QString& name) {
    format_->setCurrentIndex(std::max(0, format_->findData(name)));
}

void ExportDialog::setTarget(const std::filesystem::path& path) {
    target_->setText(QString::fromStdString(path.string()));
}

QString ExportDialog::report() const {
    return text_->toPlainText();
}

void ExportDialog::showWorking(bool working) {
    export_->setText(working ? tr("Stop") : tr("Export"));
    for (QWidget* each : {static_cast<QWidget*>(format_), static_cast<QWidget*>(target_)}) each->setEnabled(!working);
}

void ExportDialog::showEnd(const QString& text, bool fine) {
    writing_.reset();
    showWorking(false);
    text_->setPlainText(text);
    emit finishedExport(fine);
}

void ExportDialog::startExport() {
    if (writing_) {
        writing_->request_stop();
        return;
    }
    if (target_->text().trimmed().isEmpty()) browse();
    if (target_->text().trimmed().isEmpty()) return;
    const QString target = target_->text().trimmed();
    const bool agreed = std::exchange(agreed_, {}) == target;
    const ExportWish wish{offer().name.toStdString(), target.toStdString(), columns_->text().toStdString(),
                          offer().clips && clip_->isChecked()};
    showWorking(true);
    text_->setPlainText(tr("Writing…"));
    const auto work = [this, files = source_.files, read = source_.read, write = source_.begin(wish), wish,
                       agreed](const BackgroundTask& task) {
        const auto replaced = filesToReplace(files(wish), read);
        if (!replaced.empty() && !agreed) {
            task.tell([this, target = QString::fromStdString(wish.path.string()),
                       names = QString::fromStdString(shortList(replaced))] {
                agreed_ = target;
                showEnd(tr("%1 would be replaced. Name another file, or press Export again to replace what is there.")
                            .arg(names),
                        false);
            });
            return;
        }
        const auto progress = [this, &task, shown = -1](double share) mutable {
            const int percent = static_cast<int>(100 * share);
            if (std::exchange(shown, percent) == percent) return;
            task.tell([this, percent] { text_->setPlainText(tr("Writing… %1 %").arg(percent)); });
        };
        std::optional<QString> text;
        try {
            text = write(progress, task.stop());
        } catch (const Error&) {
            if (!task.stop().stop_requested()) throw;  // who stops it knows why it ends
        }
        task.tell([this, text] { showEnd(text.value_or(tr("Stopped; nothing was written.")), text.has_value()); });
    };
    writing_ = query_.post(work, [this](const QString& failure) { showEnd(failure, false); });
}

}  // namespace eyrie::ui

#include "moc_export_dialog.cpp"
