#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include "events/stored_events.h"
#include "session/background/background_query.h"

namespace eyrie::ui {

class DockRegistry;
class MessageBar;
class ProjectSession;
class TracksPanel;
class WindowActions;

/// What the search for tracks like one works on. All must outlive it.
struct LikeParts {
    ProjectSession& session;
    TracksPanel& panel;
    DockRegistry& docks;
    WindowActions& actions;
    MessageBar& messages;
};

/// Tracks like the one selected: the command, and what the list asks for, worked out in the background.
class LikeTracks : public QObject {
    Q_OBJECT

 public:
    explicit LikeTracks(const LikeParts& parts, QObject* parent = nullptr);

    /// The tracks of the run shown; null for none, or while they are read. A list of tracks like one of another run
    /// ends.
    void setRun(const std::shared_ptr<const StoredTracks>& run);
    /// What the list asks for: TrackListCommands::want_likeness.
    void want(std::optional<TrackId> track);

 private:
    void search();
    void fail(const QString& text);
    void enableAction();

    LikeParts parts_;
    std::shared_ptr<const StoredTracks> run_;
    std::optional<TrackId> wanted_;
    std::optional<int> shown_run_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
