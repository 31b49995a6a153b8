#pragma once

#include "formats/format_functions.h"
#include "formats/track_world.h"

/// What formats of paths on the earth share; inside of this room only.
namespace eyrie {

/// A box with its place.
struct PlacedBox {
    const LabelBox* box = nullptr;
    GeoPoint place;
    std::optional<std::int64_t> utc_us;
};

/// Tracks as far as their places are known (`timed`: their times, too).
class PlacedTracks {
 public:
    /// `labels` must have a world with places and outlive it; each box has an id (LabelFormat::needs_id).
    explicit PlacedTracks(const LabelFile& labels, bool timed = false);

    /// By ascending id; tracks without any place are left out.
    void visit(const std::function<void(int, const std::vector<PlacedBox>&)>& take) const;
    /// Says in the report what was left out and where places and times come from, and takes back what it says of
    /// rotation and velocity.
    void tell(ExportReport& report) const;

 private:
    const LabelFile& labels_;
    std::map<int, std::vector<PlacedBox>> tracks_;
    int without_place_ = 0;
};

/// Notes where times and places of the world come from, or why they are not known. `world` may be null.
void tellWorld(const TrackWorld* world, ExportReport& report);
/// Notes that times are those of kAssumedRate_hz.
void tellAssumedRate(ExportReport& report);

}  // namespace eyrie
