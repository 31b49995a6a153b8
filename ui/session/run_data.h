#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "chain/recording/run_facts.h"
#include "correction/corrected_tracks.h"
#include "store/runs/run_store.h"

namespace eyrie::ui {

/// What lists, charts and timeline show of one stored run. Read once, then shared and never changed.
struct RunData {
    RunRecord record;
    std::vector<std::pair<std::string, std::string>> parameters;
    std::vector<FrameSummary> frames;  ///< ascending frames
    std::vector<TrackSummary> tracks;  ///< ascending id; also those that their score or a person kept out of the result
    /// What people made of the tracks, if that is shown; never null. `tracks` are these.
    std::shared_ptr<const CorrectedTracks> corrected = std::make_shared<const CorrectedTracks>();
    bool correctable = false;    ///< people corrected tracks of the video, whether that is shown or not
    double score_threshold = 0;  ///< below which these are; 0 where tracks have no score
    RunFacts facts;
};

/// How many tracks the run itself holds.
inline std::size_t ownTracks(const RunData& data) {
    return data.tracks.size() + data.corrected->replaced.size() - data.corrected->tracks.size() -
           data.corrected->rejected.size();
}

}  // namespace eyrie::ui
