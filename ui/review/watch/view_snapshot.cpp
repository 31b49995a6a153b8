#include "review/watch/view_snapshot.h"

#include <QFileInfo>

#include "canvas/video_view.h"
#include "core/time/time_text.h"
#include "session/project_session.h"

namespace eyrie::ui {

QImage snapshotOf(const VideoView& canvas, const ProjectSession& session, SnapshotKind kind) {
    const ViewFrame& frame = canvas.frame();
    if (frame.image.isNull()) return {};
    QImage picture = kind == SnapshotKind::as_seen ? canvas.picture() : frame.image.copy();
    picture.setText(QStringLiteral("Software"), QStringLiteral("Eyrie"));
    picture.setText(QStringLiteral("Frame"), QString::number(frame.index));
    picture.setText(QStringLiteral("Time"), QString::fromStdString(timeText(frame.time_us)));
    if (session.media()) picture.setText(QStringLiteral("Video"), QString::fromStdString(session.media()->name));
    return picture;
}

QString snapshotName(const VideoView& canvas, const ProjectSession& session) {
    const QString video = session.media() ? QString::fromStdString(session.media()->name) : QString();
    const QString stem = QFileInfo(video).completeBaseName();
    return QStringLiteral("%1-%2.png")
        .arg(stem.isEmpty() ? QStringLiteral("frame") : stem)
        .arg(canvas.frame().index, 6, 10, QLatin1Char('0'));
}

}  // namespace eyrie::ui
