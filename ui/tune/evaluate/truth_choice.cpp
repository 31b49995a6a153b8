#include "tune/evaluate/truth_choice.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QSignalBlocker>
#include <QWheelEvent>

#include "formats/label_formats.h"
#include "tune/evaluate/evaluation_session.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {
enum TruthEntry { labels_entry, file_entry, choose_entry };
}  // namespace

TruthChoice::TruthChoice(EvaluationSession& evaluation, QWidget* parent) : QComboBox(parent), evaluation_(evaluation) {
    addItem(tr("Labels of the project"));
    addItem(QString());
    addItem(tr("Choose a file…"));
    setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Ground truth"));
    bindCommands(this, {{this, [this](int entry) { choose(entry); }}});
    whenAny(&evaluation_, this, &TruthChoice::showChosen, &EvaluationSession::settingsChanged);
    showChosen();
}

void TruthChoice::wheelEvent(QWheelEvent* event) {
    if (hasFocus())
        QComboBox::wheelEvent(event);
    else
        event->ignore();
}

void TruthChoice::showChosen() {
    const QSignalBlocker blocker(this);
    const QString path = QString::fromStdString(evaluation_.settings().truth_file.string());
    setItemText(file_entry, path.isEmpty() ? tr("No file chosen") : QFileInfo(path).fileName());
    setItemData(file_entry, path, Qt::ToolTipRole);
    setCurrentIndex(path.isEmpty() ? labels_entry : file_entry);
    setToolTip(tr("What runs are compared with, by evaluations and sweeps alike: %1")
                   .arg(path.isEmpty() ? tr("the labels of the project") : path));
}

void TruthChoice::choose(int entry) {
    const QString known = QString::fromStdString(evaluation_.settings().truth_file.string());
    if (entry == labels_entry) return useFile(QString());
    if (entry == file_entry && !known.isEmpty()) return;
    const QString patterns = QString::fromStdString(labelFilePatterns());
    const QString path = QFileDialog::getOpenFileName(this, tr("Ground truth"), QFileInfo(known).path(),
                                                      tr("Labels (%1);;All files (*)").arg(patterns));
    if (path.isEmpty())
        showChosen();
    else
        useFile(path);
}

void TruthChoice::useFile(const QString& path) {
    EvaluationSettings settings = evaluation_.settings();
    settings.truth_file = path.toStdString();
    evaluation_.setSettings(settings);
    showChosen();
}

}  // namespace eyrie::ui

#include "moc_truth_choice.cpp"
