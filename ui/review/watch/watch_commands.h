#pragma once

#include <QObject>
#include <filesystem>

#include <optional>

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
    /// What can be used depends on whether there is a video.
    void enableActions();
    /// Writes a PNG file in the background; never over the video, a project or a file of another kind.
    void writeSnapshot(const std::filesystem::path& path, const QImage& picture);

 private:
    void askForSnapshot(SnapshotKind kind);
    void playMoving();
    void followSensitivity();
    QString whyAllIsPlayed() const;

    WatchParts parts_;
    MeasureTool* measure_;
    bool active_ = true;
    std::optional<double> played_score_;  ///< tracks below it do not count as moving; nothing: all is played
    BackgroundQuery spans_query_;
    BackgroundQuery snapshot_query_;  ///< last: both stop before the rest goes
};

}  // namespace eyrie::ui
