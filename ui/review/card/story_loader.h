#pragma once

#include <QImage>
#include <functional>
#include <memory>
#include <vector>

#include "ground/track_story.h"
#include "session/background/background_query.h"
#include "session/project/media.h"

namespace eyrie::ui {

struct RunGround;

/// What of a run is to be looked at.
struct StoryWish {
    std::shared_ptr<const RunGround> ground;
    Media media;
    TrackId track = 0;
    FrameIndex frame = 0;  ///< around which

    bool operator==(const StoryWish& other) const {
        return ground == other.ground && media.identity == other.media.identity && track == other.track &&
               frame == other.frame;
    }
};

/// A vehicle around one moment, as it can be shown. Made in the background, then never changed.
struct VehicleStory {
    StoryWish wish;
    std::vector<StoryPoint> points;  ///< of the whole drive on this ground
    std::vector<StoryPoint> shown;   ///< those that have a chip, or get one
    std::vector<QImage> chips;       ///< of these in their order; none while they come
    QImage stack;                    ///< the vehicle over many frames, heading to the right; none while it comes
};

/// Reads the story of a vehicle and its chips, in the background; of several wishes the newest counts. Keeps the video
/// open for the next one, until close().
class StoryLoader {
 public:
    static constexpr int kChipSize = 132;  ///< px

    using Came = std::function<void(const std::shared_ptr<const VehicleStory>& story)>;

    explicit StoryLoader(Came came);
    ~StoryLoader();

    /// Answered three times: without pictures, with chips, and with the stack, too, where there can be one.
    void ask(const StoryWish& wish);
    void cancel();
    /// The same; and lets the video go.
    void close();

 private:
    struct Opened;
    Came came_;
    std::shared_ptr<Opened> opened_;  ///< used in the background alone
    BackgroundQuery query_;           ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
