#include "window/live/live_dialog.h"

#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

#include "core/project_name.h"
#include "core/values/scene_scale.h"
#include "io/live/live_address.h"
#include "widgets/display_text.h"
#include "widgets/gsd_text.h"
#include "widgets/theme_colours.h"
#include "widgets/wiring.h"

namespace eyrie::ui {
namespace {

constexpr int kLiveWidth = 640;

QLabel* quietLabel(const QString& text, QWidget* parent) {
    auto* label = new QLabel(text, parent);
    label->setWordWrap(true);
    label->setTextFormat(Qt::PlainText);
    label->setForegroundRole(QPalette::PlaceholderText);
    return label;
}

}  // namespace

LiveDialog::LiveDialog(LiveDialogCommands commands, QWidget* parent) : QDialog(parent), commands_(std::move(commands)) {
    setObjectName(QStringLiteral("live_source"));
    setWindowTitle(tr("Watch a live source"));
    setMinimumWidth(kLiveWidth);
    buildFields();
    buildEnd();
}

void LiveDialog::buildFields() {
    fields_ = new QWidget(this);
    address_ = new QLineEdit(fields_);
    address_->setObjectName(QStringLiteral("live_address"));
    address_->setPlaceholderText(QStringLiteral("rtsp://camera/stream"));
    address_fault_ = quietLabel({}, fields_);
    auto* kinds = quietLabel(tr("rtsp://name:password@camera/stream   a camera that sends on request\n"
                                "udp://@239.0.0.1:5000   a transport stream sent to a group\n"
                                "udp://0.0.0.0:5000   one that is sent to this machine\n"
                                "/dev/video0   a camera of this machine\n"
                                "Also rtp, srt, tcp, http, https and rtmp. Name and password are not kept."),
                             fields_);
    project_ = new QLineEdit(fields_);
    project_->setObjectName(QStringLiteral("live_project"));
    recording_ = new QLineEdit(fields_);
    recording_->setObjectName(QStringLiteral("live_recording"));
    gsd_ = new QLineEdit(fields_);
    gsd_->setObjectName(QStringLiteral("live_gsd"));
    gsd_->setPlaceholderText(unknownGsdText());
    gsd_->setToolTip(
        tr("Ground sampling distance: metres on the ground per pixel. Without it, the metadata of the source are used "
           "if they give one; otherwise a scale to work with is estimated from the first pictures. That takes some "
           "seconds, and much of what comes in meanwhile is only recorded."));
    give_up_ = new QSpinBox(fields_);
    give_up_->setObjectName(QStringLiteral("live_give_up"));
    give_up_->setRange(5, 24 * 3600);
    give_up_->setValue(static_cast<int>(LiveOptions().give_up_s));
    give_up_->setSuffix(tr(" s without a picture"));
    auto* form = new QFormLayout(fields_);
    form->setContentsMargins(0, 0, 0, 0);
    form->addRow(tr("&Address"), address_);
    form->addRow(QString(), address_fault_);
    form->addRow(QString(), kinds);
    form->addRow(tr("&Project"), pathRow(project_, [this] { chooseProject(); }));
    form->addRow(tr("&Recording"), pathRow(recording_, [this] { chooseRecording(); }));
    form->addRow(tr("&GSD (m/px)"), gsd_);
    form->addRow(tr("G&ive up after"), give_up_);
    for (QLineEdit* field : {project_, recording_})
        if (auto* label = qobject_cast<QLabel*>(form->labelForField(field->parentWidget()))) label->setBuddy(field);
    onEdited(this, &LiveDialog::addressEdited, address_);
    onEdited(this, &LiveDialog::projectEdited, project_);
    connect(recording_, &QLineEdit::textEdited, this, [this] { recording_chosen_ = true; });
}

QWidget* LiveDialog::pathRow(QLineEdit* field, const std::function<void()>& choose) {
    auto* row = new QWidget(fields_);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(field, 1);
    auto* button = new QPushButton(tr("Choose…"), row);
    button->setAutoDefault(false);
    layout->addWidget(button);
    bindCommands(this, {{button, choose}});
    return row;
}

void LiveDialog::buildEnd() {
    fault_ = new QLabel(this);
    fault_->setWordWrap(true);
    fault_->setTextFormat(Qt::PlainText);
    fault_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    fault_->hide();
    busy_ = new QProgressBar(this);
    busy_->setRange(0, 0);
    busy_->setTextVisible(false);
    busy_->setMaximumHeight(8);
    QSizePolicy keeps = busy_->sizePolicy();
    keeps.setRetainSizeWhenHidden(true);
    busy_->setSizePolicy(keeps);
    busy_->hide();
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    watch_ = buttons->addButton(tr("Watch"), QDialogButtonBox::AcceptRole);
    auto* rows = new QVBoxLayout(this);
    rows->addWidget(fields_);
    rows->addWidget(fault_);
    rows->addStretch(1);
    rows->addWidget(busy_);
    rows->addWidget(buttons);
    bindCommands(this,
                 {{watch_, [this] { watch(); }}, {buttons->button(QDialogButtonBox::Cancel), [this] { reject(); }}});
    addressEdited();
}

void LiveDialog::propose(const QString& address, const QString& project, double gsd_m_per_px) {
    address_->setText(address);
    gsd_->setText(gsd_m_per_px > 0 ? QString::number(gsd_m_per_px, 'g', 6) : QString());
    project_->setText(project);
    address_->setFocus();
    address_->selectAll();
}

void LiveDialog::addressEdited() {
    const QString address = address_->text().trimmed();
    const QString fault = QString::fromStdString(faultOfAddress(address.toStdString()));
    // Of an empty field the examples tell enough.
    address_fault_->setText(address.isEmpty() ? QString() : capitalised(fault));
    address_fault_->setVisible(!address_fault_->text().isEmpty());
    watch_->setEnabled(fault.isEmpty() && !waiting_);
}

void LiveDialog::projectEdited() {
    if (recording_chosen_) return;
    const std::string project = withEnding(project_->text().trimmed(), kProjectEnding).toStdString();
    recording_->setText(project.empty() ? QString() : QString::fromStdString(recordingFor(project).string()));
}

void LiveDialog::chooseProject() {
    // Runs can be added to one that is there.
    const QString path = QFileDialog::getSaveFileName(this, tr("Project of the live source"), project_->text(),
                                                      projectFilter(), nullptr, QFileDialog::DontConfirmOverwrite);
    if (!path.isEmpty()) project_->setText(withEnding(path, kProjectEnding));
}

void LiveDialog::chooseRecording() {
    const QString path =
        QFileDialog::getSaveFileName(this, tr("Recording of the live source"), recording_->text(),
                                     tr("Transport streams (*.ts)"), nullptr, QFileDialog::DontConfirmOverwrite);
    if (path.isEmpty()) return;
    recording_chosen_ = true;
    recording_->setText(withEnding(path, ".ts"));
}

void LiveDialog::watch() {
    const auto gsd = gsdFromText(gsd_->text());
    if (!gsd) {
        showFault(gsdFaultText(gsd_->text()));
        gsd_->setFocus();
        return;
    }
    const QString project = withEnding(project_->text().trimmed(), kProjectEnding);
    const QString recording = recording_->text().trimmed();
    if (QFileInfo(project).completeBaseName().isEmpty()) {
        showFault(tr("Choose where the project goes."));
        project_->setFocus();
        return;
    }
    LiveRequest request;
    request.address = address_->text().trimmed().toStdString();
    request.project = std::filesystem::absolute(project.toStdString());
    // A proposed name that is taken becomes a further one.
    if (recording_chosen_ && !recording.isEmpty())
        request.stream.recording = std::filesystem::absolute(recording.toStdString());
    request.stream.give_up_s = give_up_->value();
    request.gsd_m_per_px = *gsd;
    fault_->hide();
    setWaiting(true);
    commands_.watch(request);
}

void LiveDialog::setWaiting(bool waiting) {
    waiting_ = waiting;
    fields_->setEnabled(!waiting);
    busy_->setRange(0, 0);
    busy_->setVisible(waiting);
    watch_->setText(waiting ? tr("Waiting for a picture…") : tr("Watch"));
    addressEdited();
}

void LiveDialog::showLook(int done, int total) {
    busy_->setRange(0, total);
    busy_->setValue(done);
    watch_->setText(tr("Looking for the scale…"));
}

void LiveDialog::showFault(const QString& why) {
    QPalette coloured = palette();
    coloured.setColor(QPalette::WindowText, faultText(palette()));
    fault_->setPalette(coloured);
    fault_->setText(why);
    fault_->show();
}

void LiveDialog::reject() {
    if (waiting_) {
        commands_.cancel();  // the source is no longer waited for; the dialog stays
        return;
    }
    QDialog::reject();
}

}  // namespace eyrie::ui

#include "moc_live_dialog.cpp"
