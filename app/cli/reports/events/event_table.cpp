#include "cli/reports/events/event_table.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "core/time/time_text.h"

namespace eyrie::cli {
namespace {

/// "relevant *", the star where there is one; nothing for what nobody judged.
std::string verdictText(const Verdict* verdict) {
    if (verdict == nullptr) return "";
    return nameOf(verdict->judgement) + std::string(verdict->starred ? " *" : "");
}

/// What was said besides, and by whom.
std::string remarkText(const Verdict* verdict) {
    if (verdict == nullptr) return "";
    std::string text;
    if (!verdict->note.empty()) {
        std::string note = verdict->note;
        std::replace_if(
            note.begin(), note.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
        text += "  \"" + note + "\"";
    }
    if (!verdict->tags.empty()) text += "  [" + tagText(verdict->tags) + "]";
    if (!verdict->person.empty()) text += "  " + verdict->person;
    return text + (verdict->when_utc.empty() ? "" : "  " + verdict->when_utc);
}

std::string framesText(const Event& event) {
    const std::string first = std::to_string(event.first_frame);
    return event.first_frame == event.last_frame ? first : first + "-" + std::to_string(event.last_frame);
}

std::string tracksText(const Event& event) {
    std::string text;
    for (const TrackId id : event.tracks) text += (text.empty() ? "" : ", ") + std::to_string(id);
    return text;
}

std::string whereText(const Event& event) {
    char place[80];
    std::snprintf(place, sizeof place, "%.0f, %.0f", event.place.x, event.place.y);
    std::string text = place;
    if (event.first_frame != event.last_frame) text += " in " + std::to_string(event.frame);
    if (!event.zone.empty()) text += "  " + event.zone;
    if (event.sense != CrossingSense::none) text += std::string(" ") + nameOf(event.sense);
    return text;
}

}  // namespace

void printEvents(const JudgedEvents& judged, const StoredTracks& stored, const FrameMoment& moment) {
    const std::vector<Event>& events = judged.events;
    const int verdict_width = judged.any ? 15 : 0;
    const int moment_width = moment ? 25 : 0;
    std::printf("%-5s %-17s %-13s %-10s %-*s%-12s %-14s %-*s%s\n", "no", "kind", "frames", "clock", moment_width,
                moment ? "utc" : "", "tracks", "figure", verdict_width, judged.any ? "verdict" : "", "place");
    std::map<EventKind, int> counts;
    for (std::size_t i = 0; i < events.size(); ++i) {
        const Event& event = events[i];
        const Verdict* verdict = judged.verdicts[i];
        // A degree sign is two bytes, but one column.
        const int width = event.unit == FigureUnit::degrees ? 15 : 14;
        std::printf("%-5d %-17s %-13s %-10s %-*s%-12s %-*s %-*s%s%s\n", judged.numbers[i], nameOf(event.kind),
                    framesText(event).c_str(), videoClockText(stored.secondsOf(event.first_frame)).c_str(),
                    moment_width, moment ? moment(event.first_frame).c_str() : "", tracksText(event).c_str(), width,
                    figureText(event).c_str(), verdict_width, verdictText(verdict).c_str(), whereText(event).c_str(),
                    remarkText(verdict).c_str());
        ++counts[event.kind];
    }
    std::printf("%zu event%s of %zu tracks", events.size(), events.size() == 1 ? "" : "s", stored.tracks.size());
    const char* separator = ": ";
    for (const auto& [kind, count] : counts) {
        std::printf("%s%d %s", separator, count, nameOf(kind));
        separator = ", ";
    }
    std::puts("");
}

void printLeft(const JudgedEvents& judged, const ReviewSet& review) {
    if (judged.left.empty()) return;
    std::printf("%zu verdict%s could not be carried over to this run:\n", judged.left.size(),
                judged.left.size() == 1 ? "" : "s");
    for (const LeftVerdict& left : judged.left) {
        const Verdict& verdict = review.verdicts.at(left.verdict);
        const ReviewSubject& subject = verdict.subject;
        std::printf("%-17s frame %-7d %-10s %-14s %s%s%s\n", subject.kind ? nameOf(*subject.kind) : "not searched",
                    subject.frame, videoClockText(subject.first_s).c_str(), verdictText(&verdict).c_str(),
                    nameOf(left.fault), subject.zone.empty() ? "" : ("  " + subject.zone).c_str(),
                    remarkText(&verdict).c_str());
    }
}

void printCorrections(const CorrectedTracks& corrected, const ReviewSet& review) {
    if (corrected.states.empty()) return;
    const std::string words = correctionsInWords(corrected);
    std::printf("tracks as people corrected them:%s\n", words.empty() ? "" : (" " + words + ":").c_str());
    for (const auto& [id, state] : corrected.states) {
        const TrackCorrection& correction = review.corrections.at(id);
        std::string tracks;
        for (const auto* all : {&corrected.tracks, &corrected.rejected}) {
            for (const auto& [track, made] : *all) {
                if (std::find(made.corrections.begin(), made.corrections.end(), id) != made.corrections.end())
                    tracks += (tracks.empty() ? "" : ", ") + std::to_string(track);
            }
        }
        const auto covering = corrected.covering.find(id);
        if (covering != corrected.covering.end()) tracks = std::to_string(covering->second);
        std::printf("%-17s frame %-7d %-23s %s  %s  %s\n", nameOf(correction.kind), correction.frame,
                    tracks.empty() ? "" : ("tracks " + tracks).c_str(), nameOf(state), correction.person.c_str(),
                    correction.when_utc.c_str());
    }
}

}  // namespace eyrie::cli
