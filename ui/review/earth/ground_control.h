#pragma once

#include <QObject>
#include <QPointF>
#include <QString>
#include <functional>
#include <optional>
#include <vector>

#include "core/geometry/control_point.h"
#include "session/background/background_query.h"

namespace eyrie::ui {

class ControlPointsModel;
class ControlPointsPanel;
class ControlPointTool;
class MessageBar;
class ProjectSession;
class VideoEarth;
class VideoView;
class WindowActions;

/// What it works on. All must outlive it.
struct GroundControlParts {
    ProjectSession& session;
    VideoView& canvas;
    WindowActions& actions;
    MessageBar& messages;
    VideoEarth& earth;
};

/// Ground control by hand: places that a person finds in the picture and on a map. Set, moved, changed, removed and
/// undone; kept in the project as soon as they are made. What was done can be undone until the video is closed.
class GroundControl : public QObject {
    Q_OBJECT

 public:
    /// Asks the person for latitude and longitude, given what she wrote before and why that is no place, if it is none;
    /// nothing: no point is wanted.
    using AskForPlace = std::function<std::optional<QString>(const QString& text, const QString& why)>;

    explicit GroundControl(const GroundControlParts& parts, QObject* parent = nullptr);
    ~GroundControl() override;
    /// Asks with a dialog over the window until told otherwise.
    void setAskForPlace(AskForPlace ask) { ask_ = std::move(ask); }

    /// Without a parent until somebody takes it into a layout.
    ControlPointsPanel& panel() { return *panel_; }
    ControlPointsModel& model() { return *model_; }
    ControlPointTool& tool() { return *tool_; }
    const std::vector<ControlPoint>& points() const { return points_; }

    /// Whether the canvas may be worked on: labelling has it otherwise.
    void setActive(bool active);
    void undo();
    void redo();

 private:
    void bindCommands();
    void forget();
    void adoptStored();
    void add(QPointF px);
    void move(int number, QPointF px);
    void editPlace(int number, const QString& text);
    void remove(const std::vector<int>& numbers);
    void goTo(int number);
    void change(std::vector<ControlPoint> after);
    void store(std::vector<ControlPoint> after);
    void showPoints();
    void showMarks();
    void showState();
    void enableActions();

    GroundControlParts parts_;
    ControlPointsModel* model_;
    ControlPointsPanel* panel_;
    ControlPointTool* tool_;
    AskForPlace ask_;
    bool active_ = true;
    std::vector<ControlPoint> points_;
    std::vector<std::vector<ControlPoint>> undo_, redo_;  ///< the newest last
    int writing_ = 0;                                     ///< changes that are not stored yet
    /// What the earth knew when our last change was stored, until it has read that.
    std::optional<std::vector<ControlPoint>> outdated_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
