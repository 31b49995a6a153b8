#pragma once

#include <QObject>
#include <QPointF>
#include <optional>
#include <vector>

#include "canvas/marks/zone_mark.h"
#include "core/review/zone.h"
#include "session/background/background_query.h"

namespace eyrie::ui {

class EventReview;
class MessageBar;
class ProjectSession;
class VideoView;
class WindowActions;
class ZonePointsTool;
class ZoneTool;
class ZonesModel;
class ZonesPanel;

/// What zones work on. All must outlive them.
struct ZoneParts {
    ProjectSession& session;
    VideoView& canvas;
    WindowActions& actions;
    MessageBar& messages;
    EventReview& review;
};

/// The zones of the video in the window: drawn, listed, changed, shown over each frame where the ground has carried
/// them.
class ZoneReview : public QObject {
    Q_OBJECT

 public:
    explicit ZoneReview(const ZoneParts& parts, QObject* parent = nullptr);
    /// Files that were asked for are written before it goes.
    ~ZoneReview() override;

    /// Without a parent until somebody takes it into a layout.
    ZonesPanel& panel() { return *panel_; }
    ZonesModel& model() { return *model_; }
    ZoneTool& tool() { return *tool_; }
    ZonePointsTool& pointsTool() { return *points_tool_; }

    /// Whether drawing is wanted: labelling draws otherwise.
    void setActive(bool active);
    /// The zones, or what was found in them, are others.
    void showZones();
    /// Files as the command line reads them; what is wrong with one is told. Read in the background.
    void readFile(const QString& path);
    /// Written in the background, with the zones as they are now; what came of it is told.
    void writeFile(const QString& path);

 signals:
    /// A person draws: the list should be in sight.
    void listWanted();

 private:
    void bindCommands();
    void startDrawing(ZoneShape shape, bool wanted);
    void add(ZoneShape shape, const std::vector<cv::Point2d>& points);
    void setAnchor(int id, ZoneAnchor anchor);
    void startMoving(int id);
    void movePoint(std::size_t point, cv::Point2d to);
    /// The points that are moved lie elsewhere in another frame, or when somebody undoes.
    void followMoving();
    void showMarks();
    void enableActions();
    void carryDrawing();
    /// Whether zones can be taken in, and tells why not.
    bool mayRead();
    void takeFrom(const QString& path, const std::vector<Zone>& zones);
    /// What is wrong with a file.
    void tellFault(const QString& fault);
    /// Where the points of a zone lie in the frame shown; nothing where nobody knows.
    std::optional<std::vector<cv::Point2d>> inFrameShown(const Zone& zone) const;
    void tellUnconnected(const Zone& zone);
    /// Points of one frame as another shows the same ground; nothing where nobody knows.
    std::optional<std::vector<cv::Point2d>> carried(const std::vector<cv::Point2d>& points, int from, int to) const;
    QString hintText() const;

    ZoneParts parts_;
    ZonesModel* model_;
    ZonesPanel* panel_;
    ZoneTool* tool_;
    ZonePointsTool* points_tool_;
    bool active_ = true;
    int moved_zone_ = 0;     ///< whose points are moved
    int drawn_in_ = 0;       ///< frame that the points being drawn are meant in
    BackgroundQuery files_;  ///< reads are questions, writes are posted; last: stops before the rest goes
};

}  // namespace eyrie::ui
