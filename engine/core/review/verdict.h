#pragma once

#include <map>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/review/event_kind.h"
#include "core/review/track_correction.h"
#include "core/review/zone.h"
#include "core/values/ids.h"

/// What a person says about what happened in a video. It belongs to the video, not to a run: nothing here names a
/// track.
namespace eyrie {

/// `open`: not judged yet; there may be a note, a star or tags all the same.
enum class Judgement { open, relevant, not_relevant, unsure };
/// The word used in files and on screen: "not relevant".
const char* nameOf(Judgement judgement);
/// A judgement by its name; "-" and "_" count as blanks. Throws Error(parameter).
Judgement judgementOf(const std::string& name);

/// What is judged: an event, or a stretch of the video that could not be searched. Frames and pixels are those of the
/// video, so they mean the same in every run.
struct ReviewSubject {
    std::optional<EventKind> kind;  ///< nothing: a stretch that could not be searched
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;  ///< included
    double first_s = 0;         ///< when these are shown, s from the beginning of the video
    double last_s = 0;
    FrameIndex frame = 0;     ///< the frame to look at, between the two
    cv::Point2d place{0, 0};  ///< px in `frame`; of no meaning without a kind
    FrameIndex ground_frame = 0;
    cv::Point2d ground{0, 0};  ///< the same place on the ground, px in `ground_frame`, by the run that was judged
    std::string zone;          ///< of enters, exits and crosses; of against the flow where an arrow told
    CrossingSense sense = CrossingSense::none;

    bool operator==(const ReviewSubject&) const = default;
};

/// What a person said of an event or of a moment.
struct Verdict {
    int id = 0;  ///< within a project, from 1; never used again
    ReviewSubject subject;
    Judgement judgement = Judgement::open;
    std::string note;
    std::vector<std::string> tags;  ///< see tagsOf()
    bool starred = false;
    std::string person;    ///< who changed it last
    std::string when_utc;  ///< and when, ISO 8601

    bool operator==(const Verdict&) const = default;
};

/// A note at a time, and maybe a place, where no event is.
struct Bookmark {
    int id = 0;  ///< as of verdicts, counted apart
    FrameIndex frame = 0;
    double seconds = 0;                ///< when it is shown, s from the beginning of the video
    std::optional<cv::Point2d> place;  ///< px in `frame`
    std::string note;
    std::string person;
    std::string when_utc;

    bool operator==(const Bookmark&) const = default;
};

/// All that was said about one video.
struct ReviewSet {
    std::map<int, Verdict> verdicts;                  ///< by id
    std::map<int, Bookmark> bookmarks;                ///< by id
    std::map<int, StoredZone> zones;                  ///< by id; each name once
    std::map<int, TrackCorrection> corrections = {};  ///< by id
};

/// Tags from "gate 3, lorry": without blanks around them, empty ones and doubles; and back.
std::vector<std::string> tagsOf(const std::string& text);
std::string tagText(const std::vector<std::string>& tags);

}  // namespace eyrie
