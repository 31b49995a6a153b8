#pragma once

#include <QObject>
#include <memory>

#include "events/stored_events.h"
#include "ground/ground_sheets.h"
#include "session/background/background_query.h"

namespace eyrie::ui {

/// A run's tracks and the ground under them. Never changed, safe to share.
struct RunGround {
    explicit RunGround(std::shared_ptr<const StoredTracks> tracks) : run(std::move(tracks)), stretches(run->footage) {}

    const EventTrack* track(TrackId id) const;

    std::shared_ptr<const StoredTracks> run;
    GroundStretches stretches;
};

/// The ground of the run shown, worked out in the background. Until it is there, and for a run that is at work, there
/// is none.
class WatchedGround : public QObject {
    Q_OBJECT

 public:
    explicit WatchedGround(QObject* parent = nullptr) : QObject(parent) {}

    /// The tracks of the run shown; null for none.
    void setRun(const std::shared_ptr<const StoredTracks>& run);
    const std::shared_ptr<const RunGround>& ground() const { return ground_; }

    /// All frames laid on the ground as this one shows it; asked for anew for every run.
    void lay(FrameIndex anchor);
    /// Nobody looks at sheets any more.
    void forgetSheets();
    /// Null until they are made, or while nobody asked.
    const std::shared_ptr<const GroundSheets>& sheets() const { return sheets_; }

 signals:
    /// ground() or sheets() are others.
    void changed();

 private:
    std::shared_ptr<const StoredTracks> run_;
    std::shared_ptr<const RunGround> ground_;
    std::shared_ptr<const GroundSheets> sheets_;
    BackgroundQuery sheets_query_;
    BackgroundQuery ground_query_;  ///< last: both stop before the rest goes
};

}  // namespace eyrie::ui
