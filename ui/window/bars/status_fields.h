#pragma once

#include <QPointF>
#include <QWidget>
#include <functional>
#include <optional>

#include "core/geometry/local_plane.h"
#include "session/project_session.h"
#include "widgets/clock_of_frames.h"

class QLabel;
class QProgressBar;
class QStatusBar;
class QToolButton;

namespace eyrie::ui {

/// Where pixels of the frame shown lie on the earth.
struct PlacesInPicture {
    /// Nothing where nobody knows.
    std::function<std::optional<GeoPoint>(QPointF px)> place_of = [](QPointF) { return std::nullopt; };
    /// What that rests on, for people.
    std::function<QString()> origin = [] { return QString(); };
};

/// The fields of the status bar: frame, time, clock, cursor, the place on the earth under it, zoom; and, while
/// something works, its progress with a cross.
class StatusFields : public QObject {
    Q_OBJECT

 public:
    /// Adds its fields to `bar`, which owns them.
    StatusFields(ProjectSession& session, QStatusBar& bar);

    void setPlaces(PlacesInPicture places);
    void setClock(ClockOfFrames clock);
    void showCursor(std::optional<QPointF> image_point);
    /// The place under the cursor may be another now.
    void showPlace();
    /// The time at which the frame was taken may be another now.
    void showClock();
    void showZoom(double zoom, bool ground_held);

 private:
    void stop();
    void showFrame();
    void showRun(const RunProgress& progress);
    void showOpening(const QString& name, double share);
    void showProgress();
    void hideProgress();
    void showPreparing();

    ProjectSession& session_;
    QLabel* frame_;
    QLabel* clock_;
    QLabel* cursor_;
    QLabel* place_;
    QLabel* zoom_;
    QLabel* work_;
    QProgressBar* bar_;
    QToolButton* stop_;
    PlacesInPicture places_;
    ClockOfFrames clock_of_frames_;
    std::optional<QPointF> cursor_at_;  ///< px of the picture; nothing while it is elsewhere
};

}  // namespace eyrie::ui
