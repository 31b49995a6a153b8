#pragma once

#include <QObject>
#include <QPointF>
#include <optional>

#include "session/why.h"

class QDockWidget;
class QMainWindow;

namespace eyrie::ui {

class OverlaySettings;
class ReviewDocks;
class VideoView;
class WhyPanel;
class WindowActions;

/// What the tuning tools work on. All must outlive them.
struct TuningParts {
    ProjectSession& session;
    VideoView& canvas;
    ReviewDocks& docks;
    WindowActions& actions;
    OverlaySettings& overlays;
    QMainWindow& window;
};

/// The tools of who tunes the chain by looking: "Why?".
class Tuning : public QObject {
    Q_OBJECT

 public:
    explicit Tuning(const TuningParts& parts);

    WhyPanel& whyPanel() { return *why_panel_; }
    Why& why() { return *why_; }
    /// Asks about a place, image coordinates, and shows the answer.
    void askWhy(QPointF place, double margin = 0);
    /// Opens the form of parameters at one of them.
    void showParameter(const QString& name);

 private:
    void buildWhy();
    void showPlaceMenu(QPointF place, double margin, QPoint global);
    void showPlaceMark();

    TuningParts parts_;
    Why* why_;
    WhyPanel* why_panel_;
    QDockWidget* why_dock_;
    std::optional<QPointF> cursor_;  ///< over the canvas, image coordinates
};

}  // namespace eyrie::ui
