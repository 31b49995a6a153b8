#pragma once

#include <QObject>

namespace eyrie::ui {

class DockRegistry;
class GroundControl;
class MessageBar;
class MetadataPanel;
class ProjectSession;
class StartTime;
class VideoEarth;
class VideoView;
class WindowActions;

/// What it works on. All must outlive it.
struct EarthParts {
    ProjectSession& session;
    VideoView& canvas;
    DockRegistry& docks;
    WindowActions& actions;
    MessageBar& messages;
};

/// The dock with the metadata of the video and the control points that a person set, north over the picture, and the
/// command that asks when the video began.
class EarthDock : public QObject {
    Q_OBJECT

 public:
    explicit EarthDock(const EarthParts& parts);

    VideoEarth& earth() { return *earth_; }
    MetadataPanel& metadata() { return *metadata_; }
    GroundControl& control() { return *control_; }

 private:
    void showNorth();

    EarthParts parts_;
    VideoEarth* earth_;
    MetadataPanel* metadata_;
    GroundControl* control_;
    StartTime* start_time_;
};

}  // namespace eyrie::ui
