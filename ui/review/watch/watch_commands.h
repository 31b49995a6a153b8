#pragma once

#include <QObject>
#include <filesystem>

#include "review/watch/view_snapshot.h"
#include "session/background/background_query.h"

namespace eyrie::ui {

class MeasureTool;
class MessageBar;
class OverlaySettings;
class ProjectSession;
class VideoView;
class WatchedGround;
class WindowActions;

/// What watching commands work on. All must outlive them.
struct WatchParts {
    ProjectSession& session;
    VideoView& canvas;
    WindowActions& actions;
    MessageBar& messages;
    OverlaySettings& overlays;
    WatchedGround& ground;
};

/// What is done while one watches: measuring, playing only where something moves, pictures of what is seen.
class WatchCommands : public QObject {
    Q_OBJECT

 public:
    explicit WatchCommands(const WatchParts& parts, QObject* parent = nullptr);
    ~WatchCommands() override;

    MeasureTool& measureTool() { return *measure_; }
    /// Labelling has a tool of its own.
    void setActive(bool active);
    /// Writes a PNG file in the background; never over the video, a project or a file of another kind.
    void writeSnapshot(const std::filesystem::path& path, SnapshotKind kind);

 private:
    void askForSnapshot(SnapshotKind kind);
    void playMoving();

    WatchParts parts_;
    MeasureTool* measure_;
    BackgroundQuery spans_query_;
    BackgroundQuery snapshot_query_;  ///< last: both stop before the rest goes
};

}  // namespace eyrie::ui
