#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <optional>

#include "events/stored_events.h"
#include "session/background/background_query.h"

namespace eyrie::ui {

/// Reads the tracks of a run, as the run found them, while its lists are read: each takes half a second for an hour of
/// video. For the window's thread.
class TracksAhead {
 public:
    /// Tracks that are read, or will be; for any thread.
    class Reading {
     public:
        /// Waits for them; null where nothing was begun, or it came to nothing: then they are read anew, and what is
        /// wrong with them is told.
        std::shared_ptr<const StoredTracks> wait() const;

     private:
        friend class TracksAhead;
        std::shared_future<std::shared_ptr<const StoredTracks>> read_;
    };

    /// Begins unless that has begun for the run.
    void begin(const std::filesystem::path& project, const RunRecord& run);
    /// Hands out what was begun, once, if it is of this state of the run.
    Reading take(const std::filesystem::path& project, const RunRecord& run);
    void forget() { begun_.reset(); }

 private:
    struct Begun {
        std::filesystem::path project;
        int run = 0;
        int frames_done = 0;
        Reading reading;
    };
    std::optional<Begun> begun_;
    BackgroundQuery query_;
};

}  // namespace eyrie::ui
