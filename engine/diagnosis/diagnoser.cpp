#include "diagnosis/diagnoser.h"

#include <algorithm>
#include <array>
#include <list>
#include <memory>
#include <set>

namespace eyrie {
namespace {

constexpr int kRecently = 3;  ///< frames after one that was not registered

const std::vector<BoxRecord>& recordsOf(const BoxesByFrame& boxes, FrameIndex frame) {
    static const std::vector<BoxRecord> nothing;
    const auto found = boxes.find(frame);
    return found == boxes.end() ? nothing : found->second;
}

bool same(const OrientedBox& a, const OrientedBox& b) {
    return a.centre == b.centre && a.length == b.length && a.width == b.width && a.heading == b.heading;
}

/// First frame in which each object is in the ground truth.
std::map<int, FrameIndex> firstFrames(const BoxesByFrame& truth) {
    std::map<int, FrameIndex> first;
    for (const auto& [frame, records] : truth)
        for (const BoxRecord& record : records)
            if (record.id) first.emplace(*record.id, frame);
    return first;
}

/// Places of all errors by frame.
struct Placed {
    std::size_t error;
    std::size_t place;
};

/// Objects and results of a frame that take part in splits and merges.
struct PartsOfFrame {
    std::set<int> split_objects, split_results, merged_objects;
};

void takeMostFrequent(DiagnosedError& diagnosed, const std::vector<CauseHere>& causes) {
    std::array<int, kErrorCauses> counts{};
    for (const CauseHere& here : causes) ++counts[static_cast<std::size_t>(here.cause)];
    counts[0] = 0;  // an explanation, however rare, is better than none
    std::size_t best = causes.size();
    for (std::size_t i = 0; i < causes.size(); ++i) {
        const int count = counts[static_cast<std::size_t>(causes[i].cause)];
        if (count > 0 && (best == causes.size() || count > counts[static_cast<std::size_t>(causes[best].cause)]))
            best = i;
    }
    if (best == causes.size()) {
        diagnosed.place = diagnosed.error.places.size() / 2;
        return;
    }
    diagnosed.cause = causes[best].cause;
    diagnosed.frames_of_cause = counts[static_cast<std::size_t>(diagnosed.cause)];
    // The middle one of those with the cause is typical.
    int left = diagnosed.frames_of_cause / 2;
    std::size_t typical = 0;
    while (causes[typical].cause != diagnosed.cause || left-- > 0) ++typical;
    diagnosed.place = typical;
    diagnosed.text = causes[typical].text;
}

/// Causes of switches and fragments follow from the other errors and from who found what.
class IdentityCauses {
 public:
    IdentityCauses(const Comparison& comparison, const std::vector<DiagnosedError>& all)
        : comparison_(comparison), all_(all) {
        for (const FrameMatch& match : comparison.matches)
            for (const MatchedPair& pair : match.pairs) {
                const auto& object = recordsOf(comparison.truth, match.frame)[static_cast<std::size_t>(pair.truth)];
                const auto& track = recordsOf(comparison.result, match.frame)[static_cast<std::size_t>(pair.result)];
                if (object.id && track.id) found_[*track.id][match.frame] = *object.id;
            }
        for (const auto& [frame, records] : comparison.result)
            for (const BoxRecord& record : records)
                if (record.id) last_seen_[*record.id] = frame;
    }

    void explainSwitch(DiagnosedError& diagnosed) const {
        const ResultError& error = diagnosed.error;
        const int object = error.objects.front();
        const int before = error.tracks.front();
        const int after = error.tracks.back();
        diagnosed.frames_of_cause = 1;
        const auto other = lastObjectOf(after, error.last_frame, object);
        const auto went_to = objectAt(before, error.last_frame);
        if (other || (went_to && *went_to != object)) {
            diagnosed.cause = ErrorCause::swapped;
            diagnosed.text =
                other ? "track " + std::to_string(after) + " followed object " + std::to_string(*other)
                      : "track " + std::to_string(before) + " now follows object " + std::to_string(*went_to);
            return;
        }
        const auto last = last_seen_.find(before);
        if (last != last_seen_.end() && last->second >= error.last_frame) {
            diagnosed.cause = ErrorCause::track_left;
            diagnosed.text = "track " + std::to_string(before) + " goes on to frame " + std::to_string(last->second);
            return;
        }
        diagnosed.cause = ErrorCause::track_ended;
        if (last != last_seen_.end())
            diagnosed.text = "track " + std::to_string(before) + " ends in frame " + std::to_string(last->second);
        if (const DiagnosedError* miss = missWithin(object, error.first_frame, error.last_frame))
            diagnosed.text += std::string(diagnosed.text.empty() ? "" : ", then: ") + nameOf(miss->cause);
    }
    void explainFragment(DiagnosedError& diagnosed) const {
        const ResultError& error = diagnosed.error;
        const DiagnosedError* miss = missWithin(error.objects.front(), error.first_frame, error.last_frame);
        if (miss == nullptr) return;
        diagnosed.cause = miss->cause;
        diagnosed.text = miss->text;
        diagnosed.frames_of_cause = 1;
    }

 private:
    std::optional<int> objectAt(int track, FrameIndex frame) const {
        const auto frames = found_.find(track);
        if (frames == found_.end()) return std::nullopt;
        const auto here = frames->second.find(frame);
        return here == frames->second.end() ? std::nullopt : std::optional(here->second);
    }
    /// The object that a track found last before a frame, unless it is `object`.
    std::optional<int> lastObjectOf(int track, FrameIndex before, int object) const {
        const auto frames = found_.find(track);
        if (frames == found_.end()) return std::nullopt;
        auto last = frames->second.lower_bound(before);
        if (last == frames->second.begin()) return std::nullopt;
        --last;
        return last->second == object ? std::nullopt : std::optional(last->second);
    }
    const DiagnosedError* missWithin(int object, FrameIndex first, FrameIndex last) const {
        const DiagnosedError* found = nullptr;
        for (const DiagnosedError& one : all_) {
            const ResultError& m = one.error;
            if (m.kind != ResultErrorKind::miss || m.objects.empty() || m.objects.front() != object) continue;
            if (m.last_frame < first || m.first_frame > last) continue;
            if (found == nullptr || m.count() > found->error.count()) found = &one;
        }
        return found;
    }

    const Comparison& comparison_;
    const std::vector<DiagnosedError>& all_;
    std::map<int, std::map<FrameIndex, int>> found_;  ///< per track: the object it found in each frame
    std::map<int, FrameIndex> last_seen_;             ///< per track
};

}  // namespace

class Diagnoser::FrameLookup {
 public:
    FrameLookup(Diagnoser& owner, FrameIndex frame) : owner_(owner), frame_(frame) {}

    /// Null where nothing is stored. Valid while the lookup lives.
    const BoxFacts* at(const OrientedBox& box) {
        if (!owner_.source_.frame_result) return nullptr;
        for (const Known& known : owner_.known_[frame_])
            if (same(known.box, box)) return &copies_.emplace_back(known.facts);
        if (!read_) {
            read_ = true;
            const DiagnosisSource& source = owner_.source_;
            if (auto result = source.frame_result(frame_))
                facts_.emplace(std::move(*result), source.options, source.scale, owner_.upright_);
        }
        if (!facts_) return nullptr;
        const BoxFacts& facts = copies_.emplace_back(facts_->at(box));
        owner_.known_[frame_].push_back({box, facts});
        return &facts;
    }

 private:
    Diagnoser& owner_;
    FrameIndex frame_;
    bool read_ = false;
    std::optional<FrameFacts> facts_;
    std::list<BoxFacts> copies_;  ///< the known ones move when more are added
};

std::vector<DiagnosedError> Diagnoser::diagnose(std::vector<ResultError> errors, const Comparison& comparison,
                                                const std::stop_token& stop) {
    if (upright_ != comparison.options.upright) known_.clear();
    upright_ = comparison.options.upright;
    std::vector<DiagnosedError> diagnosed;
    diagnosed.reserve(errors.size());
    for (ResultError& error : errors) {
        diagnosed.emplace_back();
        diagnosed.back().error = std::move(error);
    }
    std::map<FrameIndex, std::vector<Placed>> by_frame;
    std::map<FrameIndex, PartsOfFrame> parts;
    for (std::size_t m = 0; m < diagnosed.size(); ++m) {
        const ResultError& error = diagnosed[m].error;
        for (std::size_t p = 0; p < error.places.size(); ++p) {
            const ErrorPlace& place = error.places[p];
            by_frame[place.frame].push_back({m, p});
            PartsOfFrame& here = parts[place.frame];
            if (error.kind == ResultErrorKind::split) {
                here.split_objects.insert(place.truth.begin(), place.truth.end());
                here.split_results.insert(place.results.begin(), place.results.end());
            }
            if (error.kind == ResultErrorKind::merge)
                here.merged_objects.insert(place.truth.begin(), place.truth.end());
        }
    }
    const std::map<int, FrameIndex> first_frames = firstFrames(comparison.truth);
    std::vector<std::vector<CauseHere>> causes(diagnosed.size());
    for (std::size_t m = 0; m < diagnosed.size(); ++m) causes[m].resize(diagnosed[m].error.places.size());

    FrameIndex unregistered = -1000;
    std::size_t position = 0;  // of the frame among those compared
    for (const auto& [frame, placed] : by_frame) {
        if (stop.stop_requested()) break;
        while (comparison.matches[position].frame != frame) ++position;
        FrameLookup lookup(*this, frame);
        const PartsOfFrame& here = parts[frame];
        for (const auto& [m, p] : placed) {
            const ResultError& error = diagnosed[m].error;
            if (error.kind == ResultErrorKind::id_switch || error.kind == ResultErrorKind::fragment) continue;
            const ErrorPlace& place = error.places[p];
            ErrorEvidence evidence{.truth = recordsOf(comparison.truth, frame),
                                   .result = recordsOf(comparison.result, frame),
                                   .frame = comparison.input.frames[position],
                                   .match = comparison.matches[position],
                                   .min_overlap = comparison.options.overlap,
                                   .upright = comparison.options.upright,
                                   .facts = lookup.at(place.box),
                                   .object_facts = {},
                                   .frames_needed = source_.options.motion.atRate(source_.scale.frame_rate_hz).min_age};
            if (evidence.facts != nullptr && evidence.facts->registration == RegistrationState::failed)
                unregistered = frame;
            evidence.recently_unregistered = frame - unregistered <= kRecently;
            switch (error.kind) {
                case ResultErrorKind::miss: {
                    const int object = place.truth.front();
                    evidence.in_split = here.split_objects.contains(object);
                    evidence.in_merge = here.merged_objects.contains(object);
                    FrameIndex since = source_.first_frame;
                    if (!error.objects.empty())
                        since = std::max(since, first_frames.at(error.objects.front()));
                    else
                        since = std::max(since, error.first_frame);
                    evidence.frames_in_view = frame - since;
                    causes[m][p] = causeOfMiss(place, evidence);
                    break;
                }
                case ResultErrorKind::false_alarm:
                    evidence.in_split = here.split_results.contains(place.results.front());
                    causes[m][p] = causeOfFalseAlarm(place, evidence);
                    break;
                case ResultErrorKind::split:
                    causes[m][p] = causeOfSplit(place, evidence);
                    break;
                case ResultErrorKind::merge:
                    for (const int object : place.truth) {
                        const auto& record = recordsOf(comparison.truth, frame)[static_cast<std::size_t>(object)];
                        if (const BoxFacts* facts = lookup.at(record.box)) evidence.object_facts.push_back(facts);
                    }
                    causes[m][p] = causeOfMerge(place, evidence);
                    break;
                case ResultErrorKind::id_switch:
                case ResultErrorKind::fragment:
                    break;
            }
        }
    }
    for (std::size_t m = 0; m < diagnosed.size(); ++m) takeMostFrequent(diagnosed[m], causes[m]);
    const IdentityCauses identities(comparison, diagnosed);
    for (DiagnosedError& one : diagnosed) {
        if (one.error.kind == ResultErrorKind::id_switch) identities.explainSwitch(one);
        if (one.error.kind == ResultErrorKind::fragment) identities.explainFragment(one);
    }
    return diagnosed;
}

}  // namespace eyrie
