// The dialog that writes labels to files.
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QVBoxLayout>
#include <exception>
#include <utility>

#include "exchange/project_labels.h"
#include "io/output_files.h"
#include "label/files/label_files.h"
#include "label/files/label_files_text.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

LabelExportDialog::LabelExportDialog(LabelSession& labels, QWidget* parent)
    : QDialog(parent),
      labels_(labels),
      format_(new QComboBox),
      carries_(new QLabel),
      target_(new QLineEdit),
      columns_(new QLineEdit(QStringLiteral("frame,id,cname,x1,y1,x2,y2"))),
      clip_(new QCheckBox(tr("Clip boxes to the image"))),
      text_(reportField()) {
    setWindowTitle(tr("Export labels"));
    for (const LabelFormatInfo& format : labelFormats())
        // Paths on the earth are of runs; labels have none.
        if (format.writes && (format.reads || !format.tells_world))
            format_->addItem(QString::fromStdString(format.title), QString::fromStdString(format.name));
    carries_->setWordWrap(true);
    auto* choose = new QPushButton(tr("Choose…"));
    auto* place = new QHBoxLayout;
    place->addWidget(target_, 1);
    place->addWidget(choose);
    auto* form = new QFormLayout;
    form->addRow(tr("Format"), format_);
    form->addRow(tr("Holds"), carries_);
    form->addRow(tr("Columns"), columns_);
    form->addRow(tr("To"), place);
    form->addRow(clip_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    export_ = buttons->addButton(tr("Export"), QDialogButtonBox::ActionRole);
    export_->setDefault(true);
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(form);
    layout->addWidget(text_, 1);
    layout->addWidget(buttons);
    const auto show_columns = [this, form] {
        form->setRowVisible(columns_, format_->currentData().toString() == QLatin1String("columns"));
        showFormat();
    };
    onEdited(this, show_columns, format_);
    bindCommands(this, {{choose, [this] { browse(); }},
                        {export_, [this] { startExport(); }},
                        {buttons->button(QDialogButtonBox::Close), [this] { reject(); }}});
    form->setRowVisible(columns_, format_->currentData().toString() == QLatin1String("columns"));
    showFormat();
}

LabelExportDialog::~LabelExportDialog() = default;

void LabelExportDialog::showFormat() {
    const LabelFormatInfo* format = formatNamed(format_->currentData().toString());
    if (format == nullptr) return;
    QStringList with;
    QStringList without;
    const Carries& carries = format->carries;
    (carries.rotation ? with : without) << tr("rotation");
    (carries.id ? with : without) << tr("ids");
    (carries.object_class ? with : without) << tr("classes");
    (carries.occlusion ? with : without) << tr("occlusion");
    (carries.ignore ? with : without) << tr("ignored boxes");
    QString text = with.join(QStringLiteral(", "));
    if (!without.isEmpty()) text += tr("; not: %1").arg(without.join(QStringLiteral(", ")));
    carries_->setText(text);
}

void LabelExportDialog::browse() {
    const LabelFormatInfo* format = formatNamed(format_->currentData().toString());
    if (format == nullptr) return;
    QString suggestion = QStringLiteral("labels");
    if (!format->folder && !format->extensions.empty())
        suggestion += QLatin1Char('.') + QString::fromStdString(format->extensions.front()).remove(QLatin1Char('.'));
    const QString path = QFileDialog::getSaveFileName(this, tr("Export labels"), suggestion, tr("All files (*)"));
    if (path.isEmpty()) return;
    target_->setText(path);
    agreed_ = path;  // the file dialog asks
}

void LabelExportDialog::setFormat(const QString& name) {
    format_->setCurrentIndex(std::max(0, format_->findData(name)));
}

void LabelExportDialog::setTarget(const std::filesystem::path& path) {
    target_->setText(QString::fromStdString(path.string()));
}

QString LabelExportDialog::report() const {
    return text_->toPlainText();
}

void LabelExportDialog::showEnd(const QString& text, bool fine) {
    export_->setEnabled(true);
    text_->setPlainText(text);
    emit finishedExport(fine);
}

void LabelExportDialog::startExport() {
    if (target_->text().trimmed().isEmpty()) browse();
    if (target_->text().trimmed().isEmpty()) return;
    ExportOptions options;
    options.columns = columns_->text().toStdString();
    if (clip_->isChecked()) options.clip = true;
    options.sequence = std::filesystem::path(labels_.sequence().path).stem().string();
    if (options.sequence.empty()) options.sequence = "sequence";
    const QString target = target_->text().trimmed();
    const bool agreed = std::exchange(agreed_, {}) == target;
    export_->setEnabled(false);
    text_->setPlainText(tr("Writing…"));
    const auto work = [this, set = labels_.annotations(), sequence = labels_.sequence(),
                       camera = labels_.sharedCamera(), path = std::filesystem::path(target.toStdString()),
                       project = labels_.projectPath(), target, agreed,
                       format = format_->currentData().toString().toStdString(), options](const BackgroundTask& task) {
        std::vector<OutputFile> files;
        for (const ExportFile& file : filesToWrite(path, format, options))
            files.push_back({file.path, file.kind, file.grows, true});
        const auto replaced = filesToReplace(files, {project, sequence.path});
        if (!replaced.empty() && !agreed) {
            task.tell([this, target, names = QString::fromStdString(shortList(replaced))] {
                agreed_ = target;
                showEnd(tr("%1 would be replaced. Name another file, or press Export again to replace what is there.")
                            .arg(names),
                        false);
            });
            return;
        }
        const ExportReport report = writeLabels(labelsOf(set, sequence, *camera), path, format, options);
        QString text = tr("Wrote %1 boxes.\n").arg(report.boxes);
        for (const auto& file : report.files) text += QString::fromStdString(file.string()) + QLatin1Char('\n');
        text += report.losses.empty() ? tr("Nothing was lost.\n") : tr("What the format could not hold:\n");
        for (const ExportLoss& loss : report.losses)
            text += QStringLiteral("• %1\n").arg(QString::fromStdString(loss.remark));
        text += lines(report.notes);
        task.tell([this, text] { showEnd(text, true); });
    };
    query_.post(work, [this](const QString& failure) { showEnd(failure, false); });
}

}  // namespace eyrie::ui
