#pragma once

#include <string>
#include <utility>
#include <vector>

#include "chain/recording/run_facts.h"
#include "store/runs/run_store.h"

namespace eyrie::ui {

/// What lists, charts and timeline show of one stored run. Read once, then shared and never changed.
struct RunData {
    RunRecord record;
    std::vector<std::pair<std::string, std::string>> parameters;
    std::vector<FrameSummary> frames;  ///< ascending frames
    std::vector<TrackSummary> tracks;  ///< ascending id; also those that only their score kept out of the result
    double score_threshold = 0;        ///< below which these are; 0 where tracks have no score
    RunFacts facts;
};

}  // namespace eyrie::ui
