#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "chain/recording/run_facts.h"
#include "events/review/reviewed_run.h"
#include "georeference/geo_reference.h"
#include "georeference/video_clock.h"
#include "io/video/frame_source.h"
#include "report/report_file.h"

namespace eyrie {

/// What a report about a reviewed run is made of. All that a project or a video may not have may be left out.
struct ReviewReportInput {
    ReviewedRun reviewed;
    EventChoice choice;  ///< which events are told
    RunFacts facts;
    std::vector<std::pair<std::string, std::string>> parameters;  ///< of the run
    std::map<std::string, std::vector<FrameSpan>> seen;           ///< by person, merged
    VideoClock clock;
    GeoReference places;
    std::string scale_remark;  ///< for people: what the video's metadata say about the scale; may be empty
    std::string video_digest;  ///< SHA-256; empty: not known
    std::string made_utc;      ///< when the report is made, ISO 8601; empty: not told
};

/// What is read of a project and its video for a report. `pixels` may be null: then there are neither stills nor
/// metadata, which the report says. `start_utc_us`: when the video began, if a person says so now; else
/// as the project keeps it. Throws Error(project).
ReviewReportInput gatherReviewReport(ProjectFile& project, const RunRecord& run, const EventChoice& choice,
                                     const FrameSource* pixels, std::optional<std::int64_t> start_utc_us = {},
                                     const std::stop_token& stop = {});

/// Video, its digest, run, scale and where it came from; how much was seen, by whom, and what could not be searched;
/// then each event with a still, a close-up, its path on the ground, speed over time, place, and what was said by whom.
/// `pixels` may be null. What of it cannot be read is left out and said. `progress` (0 … 1) may be empty. When `stop`
/// is requested the rest of the pictures is left out.
ReportFile makeReviewReport(const ReviewReportInput& input, FrameSource* pixels,
                            const std::function<void(double)>& progress = {}, const std::stop_token& stop = {});

/// How many events it tells.
std::size_t countOfEvents(const ReviewReportInput& input);

}  // namespace eyrie
