#include "chain/recording/run_facts.h"

#include <algorithm>

#include "chain/chain_options.h"

namespace eyrie {
namespace {

NothingFollowed firstGap(const RunCounts& counts, int frames_needed) {
    if (counts.tracks > 0) return NothingFollowed::has_tracks;
    if (counts.frames == 0) return NothingFollowed::no_frames;
    if (counts.frames < frames_needed) return NothingFollowed::too_few_frames;
    // The first frame has nothing to be registered onto.
    if (counts.unregistered >= counts.frames - 1) return NothingFollowed::not_registered;
    if (!counts.any_detection)
        return counts.motion_vectors == 0 ? NothingFollowed::no_motion : NothingFollowed::no_detections;
    if (counts.detections == 0) return NothingFollowed::all_rejected;
    return counts.dropped_tracks > 0 ? NothingFollowed::all_dropped : NothingFollowed::none_confirmed;
}

/// In the first frame nothing can have moved yet; a track is detected in later ones, however they follow.
int framesNeeded(const RunStore& store, const RunRecord& run) {
    const TrackerOptions tracking = storedOptions(store.parameters(run.id)).tracking;
    return 1 + tracking.atRate(run.scale.frame_rate_hz).fewestDetections();
}

}  // namespace

std::string doubtfulScaleOf(const RunFacts& facts) {
    const bool empty = facts.nothing != NothingFollowed::has_tracks && facts.nothing != NothingFollowed::no_frames &&
                       facts.nothing != NothingFollowed::too_few_frames &&
                       facts.nothing != NothingFollowed::not_registered;
    const bool stated =
        facts.scale_basis.origin == ScaleOrigin::given || facts.scale_basis.origin == ScaleOrigin::metadata;
    return empty && stated ? doubtOfGsd(facts.gsd_m_per_px) : std::string();
}

RunFacts factsOf(ProjectFile& project, const RunRecord& run) {
    RunFacts facts;
    facts.state = run.state == RunState::running && !run.live ? RunState::stopped : run.state;
    facts.frames_planned = run.last_frame >= run.first_frame ? run.last_frame - run.first_frame + 1 : 0;
    facts.counts = countRun(project, run.id);
    facts.gsd_m_per_px = run.scale.gsd_m_per_px;
    facts.scale_basis = run.scale_basis;
    if (facts.counts.tracks == 0) facts.frames_needed = framesNeeded(RunStore(project), run);
    facts.nothing = firstGap(facts.counts, facts.frames_needed);
    return facts;
}

}  // namespace eyrie
