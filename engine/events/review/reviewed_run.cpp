#include "events/review/reviewed_run.h"

#include <algorithm>

#include "correction/corrected_run.h"
#include "store/review/review_store.h"

namespace eyrie {
namespace {

const Verdict* verdictWith(const ReviewSet& review, int id) {
    const auto found = review.verdicts.find(id);
    return found == review.verdicts.end() ? nullptr : &found->second;
}

template <class Value>
bool isNoneOrAmong(const std::vector<Value>& values, const Value& value) {
    return values.empty() || std::find(values.begin(), values.end(), value) != values.end();
}

bool haveCommon(const std::vector<std::string>& some, const std::vector<std::string>& others) {
    return std::find_first_of(some.begin(), some.end(), others.begin(), others.end()) != some.end();
}

}  // namespace

const Verdict* ReviewedRun::verdictOn(std::size_t event) const {
    return verdictWith(review, carried.of_event.at(event));
}

const Verdict* ReviewedRun::verdictOnStretch(std::size_t stretch) const {
    return verdictWith(review, carried.of_stretch.at(stretch));
}

bool EventChoice::wants(const std::optional<EventKind>& kind, const Verdict* verdict, int number) const {
    return (!kind || isNoneOrAmong(kinds, *kind)) && isNoneOrAmong(numbers, number) &&
           isNoneOrAmong(judgements, verdict == nullptr ? Judgement::open : verdict->judgement) &&
           (tags.empty() || (verdict != nullptr && haveCommon(tags, verdict->tags)));
}

ReviewedRun readReviewedRun(ProjectFile& project, const RunRecord& run, const EventChoice& choice) {
    ReviewedRun found;
    found.run = run;
    const RunStore store(project);
    found.review = readReview(project, run.sequence.id);
    found.tracks = readTracks(
        store, run, choice.uncorrected ? CorrectedTracks() : correctedTracksOf(store, run, found.review.corrections));
    found.zones = choice.zones ? *choice.zones : zonesOf(found.review.zones);
    found.events = findEvents(found.tracks.tracks, found.tracks.footage, choice.options, found.zones);
    found.unsearched = unsearchedStretches(found.tracks.footage, choice.review);
    found.carried =
        carryOver(found.review.verdicts, found.events, found.unsearched, found.tracks, found.zones, choice.review);
    return found;
}

}  // namespace eyrie
