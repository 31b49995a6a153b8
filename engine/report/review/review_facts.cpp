#include "core/time/time_text.h"
#include "io/tables/number_text.h"
#include "report/report_parts.h"
#include "report/review/review_parts.h"

namespace eyrie {
namespace {

std::string share(double part) {
    return fixedDigits(100 * part, part > 0 && part < 0.1 ? 1 : 0) + " %";
}

std::string secondsText(double seconds) {
    return videoClockText(seconds) + (seconds < 60 ? " s" : "");
}

std::string scaleText(const ReviewReportInput& input) {
    const RunRecord& run = input.reviewed.run;
    std::string text = describe(run.scale, run.scale_basis, run.sequence.size);
    if (!run.scale.gsd_known) text = "not known; the search worked with " + text + ", and no speeds in km/h are given";
    return text + (input.scale_remark.empty() ? "" : "; " + input.scale_remark);
}

/// "Watched: gate 3, a line."
std::string watchedText(const Zone& zone) {
    const std::string name = markupEscaped(zone.name);
    switch (zone.shape) {
        case ZoneShape::area:
            break;
        case ZoneShape::line:
            return "Watched: " + name + ", a line.";
        case ZoneShape::arrow:
            return "The right way by " + name + ", an arrow that a person drew.";
    }
    return "Watched: " + name + ", an area.";
}

std::string clockFact(const ReviewReportInput& input) {
    if (input.clock.source() == VideoClock::Source::none) return "not known: times are those of the video";
    return "from " + input.clock.origin();
}

std::string placeFact(const ReviewReportInput& input) {
    if (!input.places.known()) return "not known";
    return "WGS 84, from " + input.places.origin();
}

/// "12.4 s of 60.0 s (21 %) in 3 stretches; …", or that all could be searched.
std::string searchedFact(const ReviewScene& scene) {
    const ReviewReportInput& input = scene.input();
    const Footage& footage = input.reviewed.tracks.footage;
    const int frames = footage.last_frame - footage.first_frame + 1;
    std::string text;
    if (frames <= 0) return "nothing: the run has no frames";
    const std::int64_t lost = framesIn(input.reviewed.unsearched);
    if (lost == 0) {
        text = "all of it";
    } else {
        text = "not " + secondsText(static_cast<double>(lost) / footage.scale.frame_rate_hz) + " (" +
               share(static_cast<double>(lost) / frames) + ") in " + std::to_string(input.reviewed.unsearched.size()) +
               (input.reviewed.unsearched.size() == 1 ? " stretch" : " stretches") + ", listed below; " +
               std::to_string(input.reviewed.tracks.unregistered) + " frames could not be registered";
        std::string reasons;
        for (const ReasonCount& reason : input.facts.counts.reasons)
            reasons += (reasons.empty() ? "" : ", ") + nameOf(reason.fault, reason.picture) + " " +
                       std::to_string(reason.frames);
        if (!reasons.empty()) text += " (" + reasons + ")";
    }
    return text;
}

std::string seenFact(const ReviewReportInput& input) {
    const Footage& footage = input.reviewed.tracks.footage;
    const FrameSpan all{footage.first_frame, footage.last_frame};
    std::vector<FrameSpan> anybody;
    std::string by;
    for (const auto& [person, spans] : input.seen) {
        anybody.insert(anybody.end(), spans.begin(), spans.end());
        by += (by.empty() ? "" : ", ") + (person.empty() ? std::string("somebody without a name") : person) + " " +
              share(seenShare(spans, all));
    }
    if (anybody.empty()) return "nothing: nobody watched it in the window";
    return share(seenShare(mergedSpans(anybody), all)) + " (" + by + "), at four times the speed at most";
}

/// Thresholds that differ from the default.
std::vector<std::pair<std::string, std::string>> changedLimits(const EventChoice& choice) {
    const auto valuesOf = [](EventOptions events, ReviewOptions review) {
        return eyrie::listParameters([&](ParameterVisitor& visitor) {
            events.describe(visitor);
            review.describe(visitor);
        });
    };
    const std::vector<Parameter> now = valuesOf(choice.options, choice.review),
                                 usual = valuesOf(EventOptions(), ReviewOptions());
    std::vector<std::pair<std::string, std::string>> changed;
    for (std::size_t i = 0; i < now.size(); ++i)
        if (now[i].value != usual[i].value)
            changed.emplace_back(now[i].name, now[i].value + " (" + usual[i].value + ")");
    return changed;
}

std::string chosenText(const EventChoice& choice) {
    std::string text;
    const auto add = [&](const std::string& word) { text += (text.empty() ? "" : ", ") + word; };
    if (choice.judgements.empty()) add("all events, judged or not");
    for (const Judgement judgement : choice.judgements)
        add(judgement == Judgement::open ? "not judged" : nameOf(judgement));
    if (!choice.kinds.empty()) {
        text += "; only ";
        for (std::size_t i = 0; i < choice.kinds.size(); ++i)
            text += (i > 0 ? ", " : "") + std::string(nameOf(choice.kinds[i]));
    }
    for (const std::string& tag : choice.tags) text += (&tag == &choice.tags.front() ? "; tagged " : " or ") + tag;
    return text;
}

/// "stops 26, stands 23, against the flow 1", in the order of kinds.
std::string kindsText(const ReviewReportInput& input, const std::vector<std::size_t>& events) {
    std::map<EventKind, int> counts;
    for (const std::size_t i : events) ++counts[input.reviewed.events[i].kind];
    std::string text;
    for (const auto& [kind, count] : counts)
        text += (text.empty() ? "" : ", ") + std::string(nameOf(kind)) + " " + std::to_string(count);
    return text;
}

}  // namespace

std::string judgeText(const Verdict& verdict) {
    if (verdict.person.empty()) return verdict.when_utc;
    return verdict.person + (verdict.when_utc.empty() ? "" : ", " + verdict.when_utc);
}

void tellReviewedVideo(ReportPage& page, const ReviewScene& scene) {
    const ReviewReportInput& input = scene.input();
    const RunRecord& run = input.reviewed.run;
    const Footage& footage = input.reviewed.tracks.footage;
    std::size_t judged = 0;
    for (std::size_t i = 0; i < input.reviewed.events.size(); ++i) {
        const Verdict* verdict = input.reviewed.verdictOn(i);
        judged += verdict != nullptr && verdict->judgement != Judgement::open ? 1U : 0U;
    }
    page.beginTable({});
    const auto fact = [&](const char* name, const std::string& value) {
        page.row({"<b>" + markupEscaped(name) + "</b>", markupEscaped(value)});
    };
    fact("Video", run.sequence.path);
    fact("SHA-256", input.video_digest.empty() ? "not known" : input.video_digest);
    fact("Image", std::to_string(run.sequence.size.width) + " × " + std::to_string(run.sequence.size.height) + " px, " +
                      fixedText(run.scale.frame_rate_hz, 3) + " frames/s" + (run.rate_assumed ? " (assumed)" : "") +
                      ", " + std::to_string(run.sequence.frame_count) + " frames");
    std::string searched = std::to_string(run.id) + (run.name.empty() ? "" : ", " + run.name);
    if (footage.last_frame >= footage.first_frame)
        searched += ", frames " + std::to_string(footage.first_frame) + " to " + std::to_string(footage.last_frame) +
                    " (" + scene.momentText(footage.first_frame) + " to " + scene.momentText(footage.last_frame) + ")";
    fact("Run",
         searched + ", started " + run.started_utc + ", Eyrie " + run.engine_version + ", " + nameOf(stateNow(run)));
    fact("Clock", clockFact(input));
    fact("Scale", scaleText(input));
    if (const std::string light = describe(run.light, run.scale); !light.empty()) fact("Light", light);
    fact("Places", placeFact(input));
    fact("Searched", searchedFact(scene));
    fact("Seen", seenFact(input));
    fact("Events", std::to_string(input.reviewed.events.size()) + " found in " +
                       std::to_string(input.reviewed.tracks.tracks.size()) + " tracks, " + std::to_string(judged) +
                       " judged by a person");
    const std::string corrections = correctionsInWords(input.reviewed.tracks.corrections);
    fact("Tracks", input.choice.uncorrected ? "as the machine found them, corrections left out"
                   : corrections.empty()    ? "as the machine found them"
                                            : "as people corrected them: " + corrections);
    const std::vector<std::size_t> told = chosenEvents(input);
    fact("Reported here", std::to_string(told.size()) + ": " + chosenText(input.choice));
    if (!told.empty()) fact("By kind", kindsText(input, told));
    if (!input.made_utc.empty()) fact("Report made", input.made_utc);
    page.endTable();
    tellDifferentParameters(page, input.parameters);
    const auto limits = changedLimits(input.choice);
    if (!limits.empty()) {
        page.heading("Limits of events that differ from the default");
        page.beginTable({"Limit", "Value (default)"});
        for (const auto& [name, value] : limits) page.row({markupEscaped(name), markupEscaped(value)});
        page.endTable();
    }
    for (const Zone& zone : input.reviewed.zones) page.paragraph(watchedText(zone));
}

void tellRemainder(ReportPage& page, const ReviewScene& scene) {
    const ReviewedRun& reviewed = scene.input().reviewed;
    if (!reviewed.unsearched.empty()) {
        page.heading("Could not be searched");
        page.beginTable({"From", "To", "Frames", "Verdict", "Note", "Judged by"});
        for (std::size_t i = 0; i < reviewed.unsearched.size(); ++i) {
            const FrameSpan span = reviewed.unsearched[i];
            const Verdict* verdict = reviewed.verdictOnStretch(i);
            page.row({markupEscaped(scene.momentText(span.first)), markupEscaped(scene.momentText(span.last)),
                      std::to_string(span.first) + "–" + std::to_string(span.last),
                      verdict != nullptr ? nameOf(verdict->judgement) : "not judged",
                      verdict != nullptr ? markupEscaped(verdict->note) : "",
                      verdict != nullptr ? markupEscaped(judgeText(*verdict)) : ""});
        }
        page.endTable();
    }
    if (!reviewed.carried.left.empty()) {
        page.heading("Judged before, without an event in this run");
        page.beginTable({"Kind", "Time", "Frame", "Verdict", "Note", "Judged by", "Why it has none"});
        for (const LeftVerdict& left : reviewed.carried.left) {
            const Verdict& verdict = reviewed.review.verdicts.at(left.verdict);
            const auto& kind = verdict.subject.kind;
            page.row({kind ? nameOf(*kind) : "not searched", markupEscaped(videoClockText(verdict.subject.first_s)),
                      std::to_string(verdict.subject.frame), nameOf(verdict.judgement), markupEscaped(verdict.note),
                      markupEscaped(judgeText(verdict)), nameOf(left.fault)});
        }
        page.endTable();
    }
    if (!reviewed.tracks.corrections.states.empty()) {
        page.heading("Tracks corrected by a person");
        page.beginTable({"What", "Frame", "By", "In this run"});
        for (const auto& [id, state] : reviewed.tracks.corrections.states) {
            const TrackCorrection& correction = reviewed.review.corrections.at(id);
            page.row(
                {nameOf(correction.kind), std::to_string(correction.frame),
                 markupEscaped(correction.person + (correction.when_utc.empty() ? "" : ", " + correction.when_utc)),
                 nameOf(state)});
        }
        page.endTable();
    }
    if (!reviewed.review.bookmarks.empty()) {
        page.heading("Bookmarks, set by a person");
        page.beginTable({"Time", "Frame", "Note", "By"});
        for (const auto& [id, bookmark] : reviewed.review.bookmarks)
            page.row({markupEscaped(videoClockText(bookmark.seconds)), std::to_string(bookmark.frame),
                      markupEscaped(bookmark.note),
                      markupEscaped(bookmark.person + (bookmark.when_utc.empty() ? "" : ", " + bookmark.when_utc))});
        page.endTable();
    }
}

}  // namespace eyrie
