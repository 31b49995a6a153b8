#pragma once

#include <QImage>
#include <QString>

namespace eyrie::ui {

class ProjectSession;
class VideoView;

/// What a picture of the canvas shows.
enum class SnapshotKind {
    as_seen,  ///< the view, with all that is drawn over it
    alone     ///< the whole frame, pixel by pixel, as bright as it is shown
};

/// A picture of what the canvas shows; the file name of the video, frame and time are kept in it as texts. Null while
/// there is no picture.
QImage snapshotOf(const VideoView& canvas, const ProjectSession& session, SnapshotKind kind);
/// "clip-000123.png".
QString snapshotName(const VideoView& canvas, const ProjectSession& session);

}  // namespace eyrie::ui
