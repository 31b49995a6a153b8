#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include "core/values/ids.h"
#include "ground/track_likeness.h"
#include "session/background/background_query.h"

namespace eyrie {
class LookReading;
}

namespace eyrie::ui {

class DockRegistry;
class MessageBar;
class ProjectSession;
struct RunGround;
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

/// Tracks like the one selected: the command, and what the list asks for, worked out in the background. Where looks
/// count, the list is there without them first; the pictures are read once for a run, also where what counts is changed
/// meanwhile.
class LikeTracks : public QObject {
    Q_OBJECT

 public:
    explicit LikeTracks(const LikeParts& parts, QObject* parent = nullptr);

    /// The tracks of the run shown with the ground under them; null for none, or until they are there. A list of tracks
    /// like one of another run ends.
    void setGround(const std::shared_ptr<const RunGround>& ground);
    /// What the list asks for: TrackListCommands::want_likeness.
    void want(std::optional<TrackId> track);

 private:
    void search();
    void take(TrackId chosen, const std::vector<TrackLikeness>& found, const LikenessChoice& counts);
    void takeLooks(std::shared_ptr<const LooksByTrack> looks, const QString& missing);
    void sayWaiting(bool waits);
    void fail(const QString& text);
    void enableAction();

    LikeParts parts_;
    std::shared_ptr<const RunGround> ground_;
    std::shared_ptr<const LooksByTrack> looks_;  ///< of the tracks of `ground_`; null: not looked at
    std::shared_ptr<LookReading> reading_;       ///< what was looked at so far; `query_` alone goes on with it
    std::optional<TrackId> wanted_;
    std::optional<int> shown_run_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
