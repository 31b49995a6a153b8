#include "review/correct/correction_trial.h"

#include <string>
#include <utility>

#include "core/error.h"
#include "correction/made_corrections.h"
#include "session/background/background_query.h"
#include "session/project/corrected_tracks_memo.h"

namespace eyrie::ui {

std::vector<TrackFrame> CorrectionTrial::statesOf(TrackId track) const {
    if (corrected.rejected.contains(track))
        throw Error(ErrorKind::parameter, "track " + std::to_string(track) + " is rejected; take that back first");
    std::vector<TrackFrame> states = trackStates(store, run.id, track, corrected);
    if (states.empty())
        throw Error(ErrorKind::parameter, "track " + std::to_string(track) +
                                              " is not part of the run's result (its score kept it out); only tracks "
                                              "of the result are joined, split and rejected");
    return states;
}

TrackCorrection CorrectionTrial::rejectionOf(TrackId track, const std::set<TrackId>& but) const {
    const std::vector<TrackFrame> states = statesOf(track);
    const TrackCorrection alone = eyrie::rejectionOf(states);
    return eyrie::rejectionOf(states, trackBeside(store, run.id, alone, but, corrected));
}

TriedCorrections tryCorrections(const TriedOn& on, const MakeCorrections& make, const std::vector<int>& numbers,
                                const BackgroundTask& task) {
    ProjectFile file = ProjectFile::open(on.project, ProjectFile::Mode::read_only);
    const RunStore store(file);
    TriedCorrections tried;
    const auto before = on.memo->of(store, on.project, on.run, on.corrections);
    std::vector<TrackCorrection> wanted = make({store, on.run, *before, task, tried});
    std::map<int, TrackCorrection> corrections = on.corrections;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        wanted[i].id = numbers.at(i);
        corrections[wanted[i].id] = wanted[i];
    }
    const auto after = on.memo->of(store, on.project, on.run, corrections);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const CorrectionState state = after->states.at(wanted[i].id);
        if (state == CorrectionState::applied) {
            tried.made_at.push_back(i);
            tried.made.push_back(std::move(wanted[i]));
            continue;
        }
        tried.state = state;
        const auto covering = after->covering.find(wanted[i].id);
        if (covering != after->covering.end()) tried.covering = covering->second;
        tried.refused = std::move(wanted[i]);
    }
    tried.last_id = store.lastTrackId(on.run.id);
    return tried;
}

}  // namespace eyrie::ui
