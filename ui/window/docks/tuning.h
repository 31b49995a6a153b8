#pragma once

#include <QObject>
#include <QPointF>
#include <QPointer>
#include <optional>

#include "tune/compare/live_preview.h"
#include "tune/inspect/why.h"

class QMainWindow;

namespace eyrie::ui {

class ComparisonWindow;
class DockRegistry;
class OverlayColumn;
class OverlaySettings;
class ParameterBinding;
class ParameterForm;
class PreviewBar;
class VideoView;
class WhyPanel;
class WindowActions;

/// What the tuning tools work on. All must outlive them.
struct TuningParts {
    ProjectSession& session;
    VideoView& canvas;
    OverlayColumn& over_canvas;
    DockRegistry& docks;
    ParameterForm& form;
    WindowActions& actions;
    ParameterBinding& parameters;
    OverlaySettings& overlays;
    QMainWindow& window;
};

/// The tools for tuning the chain by looking: "Why?" and the live preview.
class Tuning : public QObject {
    Q_OBJECT

 public:
    explicit Tuning(const TuningParts& parts);

    WhyPanel& whyPanel() { return *why_panel_; }
    Why& why() { return *why_; }
    LivePreview& preview() { return *preview_; }
    PreviewBar& previewBar() { return *preview_bar_; }
    /// Asks about a place, image coordinates, and shows the answer.
    void askWhy(QPointF place, double margin = 0);
    /// Asks about a box of the frame that is shown or on its way, such as that of an error.
    void askWhyAbout(const OrientedBox& box, const QString& about = {});
    /// A and B of the project's runs.
    ComparisonWindow& compareRuns();
    /// Opens the form of parameters at one of them.
    void showParameter(const QString& name);

 private:
    void buildWhy();
    void buildPreview();
    /// About the place under the cursor, else the middle of the canvas.
    void askWhyHere();
    void discardPreview();
    void parametersEdited();
    void parameterMoved(const QString& name, const QString& value);
    void showPreview();
    void train();
    void markStale(bool stale);
    void showPlaceMenu(QPointF place, double margin, QPoint global);
    void showPlaceMark();

    TuningParts parts_;
    Why* why_;
    WhyPanel* why_panel_;
    LivePreview* preview_;
    PreviewBar* preview_bar_;
    QPointer<ComparisonWindow> comparison_;
    bool preview_shown_ = false;
    std::optional<QPointF> cursor_;  ///< over the canvas, image coordinates
};

}  // namespace eyrie::ui
