#include "window/live/live_watching.h"

#include <QFileInfo>
#include <QMainWindow>
#include <QStandardPaths>

#include "io/live/live_address.h"
#include "widgets/wiring.h"
#include "window/run_guard.h"
#include "window/window_settings.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {
const QString kAddress = QStringLiteral("live/address");
const QString kLiveFolder = QStringLiteral("live/folder");
}  // namespace

LiveWatching::LiveWatching(const LiveParts& parts) : QObject(&parts.window), parts_(parts) {
    bindCommands(this, {{parts_.actions.watch_live, [this] { ask(); }}});
    whenChanged(parts_.session, this,
                {{SessionChange::run_started,
                  [this] {
                      if (dialog_ && parts_.session.liveSource() != nullptr) dialog_->accept();
                  }},
                 {SessionChange::run_ended, [this] { endWaiting(); }}});
    connect(&parts_.session, &ProjectSession::runProgress, this, [this](const RunProgress& progress) {
        if (dialog_ && progress.estimating_scale) dialog_->showLook(progress.frames_done, progress.frames_total);
    });
    connect(&parts_.session, &ProjectSession::liveRefused, this, [this](const QString& why) {
        if (dialog_) dialog_->showFault(why);
    });
}

void LiveWatching::ask(const QString& address, double gsd_m_per_px) {
    parts_.guard.beforeEnding(tr("a live source is watched"),
                              [this, address, gsd_m_per_px] { openDialog(address, gsd_m_per_px); });
}

QString LiveWatching::proposedProject() const {
    QString folder = parts_.settings.value(kLiveFolder, QString()).toString();
    if (folder.isEmpty() || !QFileInfo(folder).isDir())
        folder = QStandardPaths::writableLocation(QStandardPaths::MoviesLocation);
    if (folder.isEmpty() || !QFileInfo(folder).isDir())
        folder = QStandardPaths::writableLocation(QStandardPaths::HomeLocation);
    return folder + QLatin1Char('/') + QString::fromStdString(timedProjectName().string());
}

void LiveWatching::openDialog(const QString& address, double gsd_m_per_px) {
    if (dialog_) {
        dialog_->raise();
        return;
    }
    dialog_ = new LiveDialog({.watch = [this](const LiveRequest& request) { watch(request); },
                              .cancel = [this] { parts_.session.stopRun(); }},
                             &parts_.window);
    dialog_->setAttribute(Qt::WA_DeleteOnClose);
    dialog_->propose(address.isEmpty() ? parts_.settings.value(kAddress, QString()).toString() : address,
                     proposedProject(), gsd_m_per_px);
    dialog_->open();
}

void LiveWatching::watch(const LiveRequest& request) {
    parts_.settings.setValue(kAddress, QString::fromStdString(shownAddress(request.address)));
    parts_.settings.setValue(kLiveFolder, QString::fromStdString(request.project.parent_path().string()));
    parts_.leave_view();
    parts_.session.endWork();  // what is tracked ends, and is stored before the source answers
    parts_.session.watchLive(request);
}

void LiveWatching::endWaiting() {
    if (dialog_) dialog_->setWaiting(false);
}

}  // namespace eyrie::ui

#include "moc_live_watching.cpp"
