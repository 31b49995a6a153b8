// event_figures PROJECT GROUND_TRUTH: how many events of the true tracks the tracks of a project's last run have, and
// how many they have besides, as rows "kind,true,found,matched". Both are computed on the same ground.
#include <cstdio>
#include <exception>
#include <map>
#include <set>

#include "core/error.h"
#include "events/event_search.h"
#include "events/stored_events.h"
#include "formats/label_formats.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"

namespace {

using namespace eyrie;

constexpr double kNear_s = 1;
constexpr double kNearLengths = 2;
constexpr double kAway_s = 1;

/// One that left the picture and comes back appears once more: nobody saw what it did meanwhile.
std::vector<EventTrack> visitsOf(const EventTrack& vehicle, double rate_hz) {
    std::vector<EventTrack> visits;
    for (const TrackedBox& box : vehicle.boxes) {
        if (visits.empty() || box.frame - visits.back().boxes.back().frame > kAway_s * rate_hz)
            visits.push_back({vehicle.id, {}});
        visits.back().boxes.push_back(box);
    }
    return visits;
}

/// Vehicles of the ground truth, each visit to the picture by itself. One that stands is to be ignored there; what
/// never counts is no vehicle that moves, and people on foot are none.
std::vector<EventTrack> trueTracks(const std::string& file, const Footage& footage) {
    const LabelFile labels = readLabels(file);
    std::map<int, EventTrack> tracks;
    std::set<int> counted;
    for (const auto& [frame, boxes] : labels.boxes) {
        if (frame < footage.first_frame || frame > footage.last_frame) continue;
        for (const LabelBox& box : boxes) {
            if (!box.id || box.object_class == "person") continue;
            EventTrack& track = tracks[*box.id];
            track.id = *box.id;
            track.boxes.push_back({frame, box.box});
            if (!box.ignore) counted.insert(*box.id);
        }
    }
    std::vector<EventTrack> vehicles;
    for (const auto& [id, track] : tracks) {
        if (!counted.contains(id)) continue;
        for (EventTrack& visit : visitsOf(track, footage.scale.frame_rate_hz)) {
            visit.id = static_cast<TrackId>(vehicles.size()) + 1;
            vehicles.push_back(std::move(visit));
        }
    }
    return vehicles;
}

double lengthOf(const std::vector<EventTrack>& tracks, const Event& event) {
    for (const EventTrack& track : tracks)
        if (!event.tracks.empty() && track.id == event.tracks.front()) return track.boxes.front().box.length;
    return 0;
}

/// Whether an event of ours is this true one.
bool fits(const Event& truth, const Event& found, const Footage& footage, double length) {
    const double near = kNear_s * footage.scale.frame_rate_hz;
    if (found.kind != truth.kind || found.first_frame > truth.last_frame + near ||
        found.last_frame < truth.first_frame - near)
        return false;
    const auto map = footage.camera.map(found.frame, truth.frame);
    if (!map) return false;
    // What lasts happens along a way.
    const double way = truth.first_frame == truth.last_frame ? 0 : length * (truth.last_frame - truth.first_frame) / 10;
    return cv::norm(map->apply(found.place) - truth.place) <= kNearLengths * length + way;
}

struct Counts {
    int truth = 0;
    int found = 0;
    int matched = 0;
};

int print(const std::string& project, const std::string& ground_truth) {
    ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
    const RunStore store(file);
    if (store.runs().empty()) throw Error(ErrorKind::project, project + ": holds no run");
    const StoredTracks stored = readTracks(store, store.runs().back());
    const std::vector<EventTrack> true_tracks = trueTracks(ground_truth, stored.footage);
    const auto truth = findEvents(true_tracks, stored.footage);
    const auto found = findEvents(stored.tracks, stored.footage);
    std::map<EventKind, Counts> counts;
    std::vector<bool> used(found.size(), false);
    for (const Event& event : found) ++counts[event.kind].found;
    for (const Event& event : truth) {
        ++counts[event.kind].truth;
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (used[i] || !fits(event, found[i], stored.footage, lengthOf(true_tracks, event))) continue;
            used[i] = true;
            ++counts[event.kind].matched;
            break;
        }
    }
    for (const auto& [kind, count] : counts)
        std::printf("%s,%d,%d,%d\n", nameOf(kind), count.truth, count.found, count.matched);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc == 3) return print(argv[1], argv[2]);
        std::fprintf(stderr, "event_figures PROJECT GROUND_TRUTH\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "event_figures: %s\n", error.what());
    }
    return 1;
}
