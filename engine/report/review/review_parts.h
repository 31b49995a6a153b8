#pragma once

#include "events/ground/ground_path.h"
#include "report/report_page.h"
#include "report/review/review_report.h"

/// The chapters of a report about a reviewed run, for its own room only.
namespace eyrie {

/// What the chapters share: made once, since they are dear.
class ReviewScene {
 public:
    explicit ReviewScene(const ReviewReportInput& input);
    ReviewScene(const ReviewScene&) = delete;
    ReviewScene& operator=(const ReviewScene&) = delete;

    const ReviewReportInput& input() const { return input_; }
    const GroundStretches& ground() const { return ground_; }
    /// The box of a track in a frame; null for none.
    const OrientedBox* boxOf(TrackId track, FrameIndex frame) const;
    /// The piece of a track's path on the ground that holds a frame, or lies nearest to it; null without any.
    const GroundPath* pathOf(TrackId track, FrameIndex frame) const;
    /// "0:14.2", and the clock time where it is known: "0:14.2, 2009-01-12T22:08:36.200Z".
    std::string momentText(FrameIndex frame) const;
    /// Seconds from the beginning of the video.
    double secondsOf(FrameIndex frame) const { return input_.reviewed.tracks.secondsOf(frame); }

 private:
    const ReviewReportInput& input_;
    GroundStretches ground_;
    std::vector<GroundPath> paths_;
    std::map<TrackId, const EventTrack*> tracks_;
};

/// The events that are told, as indices, in the order of time.
std::vector<std::size_t> chosenEvents(const ReviewReportInput& input);

/// Video, run, scale, registration, what was seen, parameters.
void tellReviewedVideo(ReportPage& page, const ReviewScene& scene);
/// Stretches that could not be searched, verdicts without an event, and bookmarks.
void tellRemainder(ReportPage& page, const ReviewScene& scene);

/// The frame of an event with the boxes and trails of its vehicles, JPEG.
std::string eventStill(const ReviewScene& scene, const Event& event, const Frame& frame);
/// What is around its first vehicle, enlarged, JPEG; of the place where there is no box.
std::string eventCloseUp(const ReviewScene& scene, const Event& event, const Frame& frame);
/// The ways of its vehicles over the ground, SVG; empty without any.
std::string pathSketch(const ReviewScene& scene, const Event& event);
/// Speed of its vehicles some seconds around the event, SVG; empty without any.
std::string speedSketch(const ReviewScene& scene, const Event& event);

/// The ground on which events lie, seen from above.
struct GroundChapter {
    std::vector<std::string> pictures;  ///< names in the report: one for each stretch of ground, busiest first
    std::size_t left_out = 0;           ///< events on stretches that have no picture
};
/// Adds mosaics of the ground with the ways of the vehicles of `events`, as indices, and the events' places and
/// numbers. `progress` (0 … 1) may be empty. Throws Error(input) where the video cannot be read. Stopped, there is
/// none.
GroundChapter addGround(const ReviewScene& scene, const std::vector<std::size_t>& events, FrameSource& pixels,
                        ReportFile& report, const std::function<void(double)>& progress, const std::stop_token& stop);

/// "Ada at 2026-11-21T08:00:00Z"; empty where nobody is known.
std::string judgeText(const Verdict& verdict);

}  // namespace eyrie
