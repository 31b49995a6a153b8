#include "formats/earth/placed_tracks.h"

namespace eyrie {

PlacedTracks::PlacedTracks(const LabelFile& labels, bool timed) : labels_(labels) {
    const TrackWorld& world = *labels.world;
    // In the order of frames, in which places are found quickest.
    for (const auto& [frame, boxes] : labels.boxes) {
        const auto utc = world.utc_us ? world.utc_us(frame) : std::nullopt;
        for (const LabelBox& box : boxes) {
            const auto place = world.place(frame, box.box.centre);
            if (place && (utc || !timed))
                tracks_[box.id.value()].push_back({&box, *place, utc});
            else
                ++without_place_;
        }
    }
}

void PlacedTracks::visit(const std::function<void(int, const std::vector<PlacedBox>&)>& take) const {
    for (const auto& [id, boxes] : tracks_) take(id, boxes);
}

void PlacedTracks::tell(ExportReport& report) const {
    std::erase_if(report.losses, [](const ExportLoss& loss) {
        return loss.kind == LossKind::velocity || loss.kind == LossKind::rotation || loss.kind == LossKind::heading;
    });
    report.notes.push_back("only the middle of each box is written");
    report.add(LossKind::other, without_place_, "were left out: their place or time is not known");
    tellWorld(labels_.world.get(), report);
}

void tellWorld(const TrackWorld* world, ExportReport& report) {
    if (world == nullptr) return;
    if (!world->clock_origin.empty()) report.notes.push_back("times are from " + world->clock_origin);
    if (!world->utc_us && !world->no_clock.empty()) report.notes.push_back("no clock times: " + world->no_clock);
    if (!world->place_origin.empty()) report.notes.push_back("places are from " + world->place_origin);
    if (!world->place && !world->no_place.empty()) report.notes.push_back("no places on the earth: " + world->no_place);
}

void tellAssumedRate(ExportReport& report) {
    report.notes.push_back("times count " + std::to_string(kAssumedRate_hz) +
                           " frames a second, as no frame rate is known");
}

}  // namespace eyrie
