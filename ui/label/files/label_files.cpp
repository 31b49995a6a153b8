#include "label/files/label_files.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QVBoxLayout>
#include <exception>

#include "exchange/label_import.h"
#include "label/files/label_files_text.h"
#include "label/label_classes.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

LabelImportDialog::LabelImportDialog(LabelSession& labels, QWidget* parent)
    : QDialog(parent),
      labels_(labels),
      format_(new QComboBox),
      columns_(new QLineEdit),
      shift_(new QSpinBox),
      scale_(new QDoubleSpinBox),
      tolerance_(new QDoubleSpinBox),
      classes_(new QTableWidget(0, 3)),
      add_doubles_(new QCheckBox(tr("Add objects that are labelled here already"))),
      link_(new QCheckBox(tr("Link boxes without id by their overlap from frame to frame"))),
      text_(reportField()) {
    setWindowTitle(tr("Import labels"));
    format_->addItem(tr("Detect"), QStringLiteral("auto"));
    for (const LabelFormatInfo& format : labelFormats())
        if (format.reads) format_->addItem(QString::fromStdString(format.title), QString::fromStdString(format.name));
    columns_->setPlaceholderText(QStringLiteral("frame,id,cname,x1,y1,x2,y2"));
    columns_->setToolTip(tr("Columns of your own table, in order"));
    shift_->setRange(-1000000, 1000000);
    shift_->setSuffix(tr(" frames"));
    shift_->setKeyboardTracking(false);
    scale_->setRange(0.001, 1000);
    scale_->setDecimals(4);
    scale_->setValue(1);
    scale_->setKeyboardTracking(false);
    tolerance_->setRange(0, 100);
    tolerance_->setDecimals(1);
    tolerance_->setValue(1.5);
    tolerance_->setSuffix(tr(" px"));
    tolerance_->setToolTip(tr("As few keyframes as keep every box within this distance; 0 makes every box a keyframe"));
    classes_->setHorizontalHeaderLabels({tr("Class in the file"), tr("Boxes"), tr("becomes")});
    classes_->verticalHeader()->hide();
    classes_->horizontalHeader()->setStretchLastSection(true);
    classes_->setMaximumHeight(150);
    buttons_ = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
    buttons_->button(QDialogButtonBox::Ok)->setText(tr("Import"));
    auto* form = new QFormLayout;
    form->addRow(tr("Format"), format_);
    form->addRow(tr("Columns"), columns_);
    form->addRow(tr("Shift"), shift_);
    form->addRow(tr("Scale"), scale_);
    form->addRow(tr("Keyframes within"), tolerance_);
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(form);
    layout->addWidget(new QLabel(tr("Found in the file:")));
    layout->addWidget(text_, 1);
    layout->addWidget(classes_);
    add_doubles_->hide();
    layout->addWidget(add_doubles_);
    link_->hide();
    layout->addWidget(link_);
    layout->addWidget(buttons_);
    const auto show_columns = [this, form] {
        const bool wanted = format_->currentData().toString() == QLatin1String("columns");
        form->setRowVisible(columns_, wanted);
    };
    onEdited(this, show_columns, format_);
    onEdited(this, &LabelImportDialog::read, format_, shift_, scale_, link_);
    onFinished(this, &LabelImportDialog::read, columns_);
    QPushButton* folder = buttons_->addButton(tr("A folder instead…"), QDialogButtonBox::ActionRole);
    folder->setToolTip(
        tr("For formats with a text file per image, such as YOLO-OBB and DOTA, and for trees of MOTChallenge"));
    bindCommands(this, {{folder, [this] { chooseFolder(); }},
                        {buttons_->button(QDialogButtonBox::Ok), [this] { accept(); }},
                        {buttons_->button(QDialogButtonBox::Cancel), [this] { reject(); }}});
    // What was read is meant for these labels: those that are opened next have objects of the same numbers.
    whenAny(&labels_, this, &LabelImportDialog::giveUp, &LabelSession::closed);
    show_columns();
    setBusy(true);
}

LabelImportDialog::~LabelImportDialog() = default;

void LabelImportDialog::giveUp() {
    report_.reset();
    path_.clear();
    query_.cancel();
    importing_.request_stop();
    setEnabled(true);
    setBusy(true);
    text_->setPlainText(tr("The labels this import was for are no longer open. Nothing was imported."));
    reject();
}

bool LabelImportDialog::choose() {
    const QString beside = QString::fromStdString(labels_.projectPath().parent_path().string());
    const QString path =
        QFileDialog::getOpenFileName(parentWidget(), tr("Import labels"), beside,
                                     tr("Labels (%1);;All files (*)").arg(QString::fromStdString(labelFilePatterns())));
    if (path.isEmpty()) return false;
    setFile(path.toStdString());
    return true;
}

void LabelImportDialog::chooseFolder() {
    const QString inside = QString::fromStdString(path_.parent_path().string());
    const QString path = QFileDialog::getExistingDirectory(this, tr("Import a folder of labels"), inside);
    if (!path.isEmpty()) setFile(path.toStdString());
}

void LabelImportDialog::setFile(const std::filesystem::path& path) {
    path_ = path;
    setWindowTitle(tr("Import %1").arg(QString::fromStdString(path.filename().string())));
    read();
}

void LabelImportDialog::setBusy(bool busy) {
    buttons_->button(QDialogButtonBox::Ok)->setEnabled(!busy);
}

ImportOptions LabelImportDialog::options() const {
    ImportOptions options;
    options.frame_shift = shift_->value();
    options.scale = scale_->value();
    options.columns = columns_->text().toStdString();
    options.image_size = labels_.sequence().size;
    if (labels_.sequence().frame_count > 0) options.frame_count = labels_.sequence().frame_count;
    return options;
}

void LabelImportDialog::read() {
    if (path_.empty()) return;
    report_.reset();
    setBusy(true);
    text_->setPlainText(tr("Reading…"));
    const auto work = [this, path = path_, format = format_->currentData().toString().toStdString(),
                       options = options(), present = labels_.annotations(), camera = labels_.sharedCamera(),
                       within = 1 + tolerance_->value(),
                       loose = link_->isChecked() ? LooseBoxes::link : LooseBoxes::single](const BackgroundTask& task) {
        LabelFile labels = readLabels(path, format, options);
        const LabelReport report = reportOn(labels);
        gatherLooseBoxes(labels, loose);
        const auto doubles = static_cast<int>(alreadyLabelled(labels, present, *camera, within).size());
        task.tell([this, report, doubles] { showReport(report, doubles); });
    };
    query_.ask(work, [this](const QString& text) {
        text_->setPlainText(text);
        emit fileRead();
    });
}

void LabelImportDialog::showReport(const LabelReport& report, int doubles) {
    report_ = report;
    add_doubles_->setVisible(doubles > 0);
    link_->setVisible(report.loose > 0);
    const LabelFormatInfo* format = formatNamed(QString::fromStdString(report.format));
    QString text = tr("%1\n").arg(format != nullptr ? QString::fromStdString(format->title)
                                                    : QString::fromStdString(report.format));
    text += tr("%1 boxes in %2 frames, frames %3 to %4 (the file counts from %5)\n")
                .arg(report.boxes)
                .arg(report.frames)
                .arg(report.first_frame)
                .arg(report.last_frame)
                .arg(report.first_frame_number);
    text += report.ids > 0 ? tr("%1 ids, %2 to %3\n").arg(report.ids).arg(report.lowest_id).arg(report.highest_id)
                           : tr("no ids\n");
    if (report.loose > 0)
        text += tr("%1 boxes have no id; each becomes an object of one frame, unless you choose to link them\n")
                    .arg(report.loose);
    if (report.turned > 0) text += tr("%1 boxes are turned\n").arg(report.turned);
    if (report.ignored > 0) text += tr("%1 boxes are to be ignored\n").arg(report.ignored);
    if (report.occluded > 0) text += tr("%1 boxes are occluded\n").arg(report.occluded);
    if (report.outside > 0) text += tr("%1 boxes lie outside the image\n").arg(report.outside);
    const cv::Size ours = labels_.sequence().size;
    if (report.image_size && *report.image_size != ours)
        text += tr("Its images are %1 × %2 px, this video %3 × %4: is the scale right?\n")
                    .arg(report.image_size->width)
                    .arg(report.image_size->height)
                    .arg(ours.width)
                    .arg(ours.height);
    if (report.last_frame >= labels_.sequence().frame_count)
        text += tr("This video ends with frame %1; later boxes are left out. Is the shift right?\n")
                    .arg(labels_.sequence().frame_count - 1);
    if (doubles > 0)
        text += tr("%1 of its objects are labelled here already with the same boxes; they are left out unless you "
                   "choose to add them\n")
                    .arg(doubles);
    text_->setPlainText(text + lines(report.notes));

    classes_->setRowCount(0);
    for (const auto& [name, boxes] : report.boxes_of_class) {
        const int row = classes_->rowCount();
        classes_->insertRow(row);
        auto* from = new QTableWidgetItem(classText(name));
        from->setData(Qt::UserRole, QString::fromStdString(name));
        from->setFlags(Qt::ItemIsEnabled);
        auto* count = new QTableWidgetItem(QString::number(boxes));
        count->setFlags(Qt::ItemIsEnabled);
        classes_->setItem(row, 0, from);
        classes_->setItem(row, 1, count);
        auto* to = new QComboBox;
        to->setEditable(true);
        for (const ObjectClass& known : classesOf(labels_.annotations()))
            to->addItem(QString::fromStdString(known.name));
        to->setCurrentText(QString::fromStdString(name));
        classes_->setCellWidget(row, 2, to);
    }
    setBusy(report.boxes == 0);
    emit fileRead();
}

QString LabelImportDialog::report() const {
    return text_->toPlainText();
}

void LabelImportDialog::setAddDoubles(bool add) {
    add_doubles_->setChecked(add);
}

void LabelImportDialog::setLink(bool link) {
    link_->setChecked(link);
}

void LabelImportDialog::accept() {
    if (!report_ || labels_.store() == nullptr) return;
    ImportOptions with_classes = options();
    for (int row = 0; row < classes_->rowCount(); ++row) {
        const QString from = classes_->item(row, 0)->data(Qt::UserRole).toString();
        const QString to = qobject_cast<QComboBox*>(classes_->cellWidget(row, 2))->currentText().trimmed();
        if (!to.isEmpty() && to != from) with_classes.class_map[from.toStdString()] = to.toStdString();
    }
    setBusy(true);
    setEnabled(false);
    text_->setPlainText(tr("Choosing keyframes…"));
    // The plan is made of values: the labels may be closed meanwhile, as when another project is opened.
    const auto work = [this, path = path_, format = report_->format, with_classes,
                       ground = ImportGround(*labels_.store()), version = labels_.store()->version(),
                       sequence = labels_.sequence(), camera = labels_.sharedCamera(), tolerance = tolerance_->value(),
                       doubles = add_doubles_->isChecked() ? Doubles::add : Doubles::skip,
                       loose = link_->isChecked() ? LooseBoxes::link : LooseBoxes::single](const BackgroundTask& task) {
        if (task.stop().stop_requested()) return;
        const LabelImport planned =
            planImport(readLabels(path, format, with_classes), sequence, *camera, ground, tolerance, doubles, loose);
        task.tell([this, planned, version, stop = task.stop()] {
            if (stop.stop_requested() || labels_.store() == nullptr) return;
            setEnabled(true);
            if (labels_.store()->version() != version) {  // what was tracked meanwhile has taken numbers
                accept();
                return;
            }
            if (planned.edit.empty() || !labels_.apply(planned.edit)) {
                text_->setPlainText(tr("Nothing was imported.\n") + lines(planned.notes));
                setBusy(false);
                return;
            }
            summary_ = tr("Imported %1 objects with %2 keyframes for %3 boxes. Undo takes it back.")
                           .arg(planned.objects)
                           .arg(planned.keyframes)
                           .arg(planned.boxes);
            for (const std::string& note : planned.notes) summary_ += QLatin1Char('\n') + QString::fromStdString(note);
            QDialog::accept();
        });
    };
    importing_ = query_.post(work, [this](const QString& failure) {
        if (path_.empty()) return;
        setEnabled(true);
        setBusy(false);  // what stood in the way may be gone the next time
        text_->setPlainText(failure);
    });
}

}  // namespace eyrie::ui

#include "moc_label_files.cpp"
