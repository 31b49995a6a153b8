#include "correction/corrected_tracks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "correction/joined_states.h"
#include "correction/track_frames.h"

namespace eyrie {
namespace {

constexpr double kLongestGap_s = 10;
constexpr double kMostOfALife = 0.6;  ///< share of boxes that cover an added track
constexpr double kSameCentre = 0.35;  ///< of a length: boxes that hardly overlap may be one vehicle still
constexpr double kLeastOverlap = 0.1;

using States = std::vector<TrackFrame>;

/// The tracks while corrections are applied, one after the other.
class Workbench {
 public:
    Workbench(const TracksToCorrect& run, const CameraMotion& camera) : run_(run), camera_(camera) {
        for (const auto& [id, states] : run.tracks) present_[id].states = states;
    }

    CorrectionState apply(const TrackCorrection& correction) {
        switch (correction.kind) {
            case CorrectionKind::add:
                return add(correction);
            case CorrectionKind::join:
                return join(correction);
            case CorrectionKind::split:
                return split(correction);
            case CorrectionKind::reject:
                return reject(correction);
        }
        return CorrectionState::no_track;
    }

    CorrectedTracks take() {
        CorrectedTracks result;
        std::erase_if(present_, [](const auto& each) { return each.second.corrections.empty(); });
        for (auto* made : {&present_, &rejected_})
            for (auto& [id, track] : *made) std::sort(track.corrections.begin(), track.corrections.end());
        result.tracks = std::move(present_);
        result.rejected = std::move(rejected_);
        result.replaced = std::move(replaced_);
        result.covering = std::move(covering_);
        return result;
    }

 private:
    bool isOfRun(FrameIndex frame) const { return frame >= run_.first_frame && frame <= run_.last_frame; }

    std::vector<Sighting> ofRun(const std::vector<Sighting>& sightings) const {
        std::vector<Sighting> found;
        for (const Sighting& each : sightings)
            if (isOfRun(each.frame)) found.push_back(each);
        return found;
    }

    /// The track that lies best on at least half of them; 0 for none.
    TrackId match(const std::vector<Sighting>& sightings) const {
        return match(sightings, [](TrackId, const CorrectedTrack&) { return true; });
    }

    /// The same of those that are `meant`.
    template <class Meant>
    TrackId match(const std::vector<Sighting>& sightings, const Meant& meant) const {
        TrackId best = 0;
        double most = 0;
        for (const auto& [id, track] : present_) {
            if (!meant(id, track)) continue;
            std::size_t hits = 0;
            double likeness = 0;
            for (const Sighting& each : sightings) {
                const TrackState* state = stateIn(track.states, each.frame);
                const auto like = state != nullptr ? likenessOf(each.box, state->box) : std::nullopt;
                if (!like) continue;
                ++hits;
                likeness += *like;
            }
            if (2 * hits < sightings.size() || likeness <= most) continue;
            best = id;
            most = likeness;
        }
        return best;
    }

    /// How many of the boxes any track lies on, and how many each does.
    struct Met {
        int boxes = 0;
        std::map<TrackId, int> by_track;
    };
    Met met(const std::vector<Sighting>& compared) const {
        Met found;
        for (const Sighting& each : compared) {
            bool any = false;
            for (const auto& [id, track] : present_) {
                const TrackState* state = stateIn(track.states, each.frame);
                if (state == nullptr || !likenessOf(each.box, state->box)) continue;
                ++found.by_track[id];
                any = true;
            }
            found.boxes += any ? 1 : 0;
        }
        return found;
    }

    CorrectionState add(const TrackCorrection& correction) {
        const std::vector<Sighting> seen = ofRun(correction.track);
        if (seen.empty()) return CorrectionState::not_searched;
        const std::vector<Sighting> compared = comparedOf(seen);
        const Met there = met(compared);
        if (there.boxes >= kMostOfALife * static_cast<double>(compared.size())) {
            covering_[correction.id] =
                std::max_element(there.by_track.begin(), there.by_track.end(), [](auto& a, auto& b) {
                    return a.second < b.second;
                })->first;
            return CorrectionState::covered;
        }
        keep(run_.last_id + correction.id, {CorrectionKind::add, {correction.id}, statesByHand(seen, camera_)});
        return CorrectionState::applied;
    }

    CorrectionState join(const TrackCorrection& correction) {
        const std::vector<Sighting> of_one = ofRun(correction.track), of_other = ofRun(correction.other);
        if (of_one.empty() || of_other.empty()) return CorrectionState::not_searched;
        TrackId one = match(of_one), other = match(of_other);
        if (one == 0 || other == 0) return CorrectionState::no_track;
        if (one == other) {
            covering_[correction.id] = one;
            return CorrectionState::covered;
        }
        if (present_[other].states.front().frame < present_[one].states.front().frame) std::swap(one, other);
        const CorrectedTrack first = present_[one], second = present_[other];
        if (areApart(first.states, second.states)) return CorrectionState::apart;
        drop(one);
        drop(other);
        const int longest_gap = static_cast<int>(kLongestGap_s * run_.frame_rate_hz);
        CorrectedTrack joined{CorrectionKind::join, first.corrections,
                              joinedStates(first.states, second.states, camera_, longest_gap)};
        joined.corrections.insert(joined.corrections.end(), second.corrections.begin(), second.corrections.end());
        joined.corrections.push_back(correction.id);
        keep(one, std::move(joined));
        return CorrectionState::applied;
    }

    CorrectionState split(const TrackCorrection& correction) {
        std::vector<Sighting> earlier, later;
        for (const Sighting& each : ofRun(correction.track))
            (each.frame < correction.frame ? earlier : later).push_back(each);
        if (earlier.empty() || later.empty()) return CorrectionState::not_searched;
        const TrackId id = match(earlier);
        const TrackId next = match(later);
        if (id == 0 || next == 0) return CorrectionState::no_track;
        if (id != next) {
            covering_[correction.id] = next;
            return CorrectionState::covered;
        }
        const CorrectedTrack whole = present_[id];
        const auto cut = firstFrom(whole.states, correction.frame);
        drop(id);
        CorrectedTrack before{CorrectionKind::split, whole.corrections, {whole.states.begin(), cut}};
        CorrectedTrack after{CorrectionKind::split, whole.corrections, {cut, whole.states.end()}};
        for (CorrectedTrack* part : {&before, &after}) part->corrections.push_back(correction.id);
        keep(id, std::move(before));
        keep(run_.last_id + correction.id, std::move(after));
        return CorrectionState::applied;
    }

    CorrectionState reject(const TrackCorrection& correction) {
        const std::vector<Sighting> seen = comparedOf(ofRun(correction.track));
        if (seen.empty()) return CorrectionState::not_searched;
        const TrackId id = match(seen);
        // In pieces it is there still.
        if (id == 0)
            return 2 * static_cast<std::size_t>(met(seen).boxes) < seen.size() ? CorrectionState::absent
                                                                               : CorrectionState::no_track;
        const States& states = present_[id].states;
        if (!livesMostly(sightingsOf(states.begin(), states.end()), seen.front().frame, seen.back().frame))
            return CorrectionState::no_track;
        if (isAlone(id, ofRun(correction.other))) return CorrectionState::alone;
        CorrectedTrack track = present_[id];
        drop(id);
        track.kind = CorrectionKind::reject;
        track.corrections.push_back(correction.id);
        rejected_[id] = std::move(track);
        return CorrectionState::applied;
    }

    /// Whether a track is the only one of the result on a vehicle of which `kept` are boxes.
    bool isAlone(TrackId id, const std::vector<Sighting>& kept) const {
        const bool lies_on_it = match(kept, [&](TrackId each, const CorrectedTrack&) { return each == id; }) != 0;
        return lies_on_it && match(kept, [&](TrackId each, const CorrectedTrack& track) {
                                 return each != id && isOfResult(track.states);
                             }) == 0;
    }

    /// Whether half of the boxes or more are of these frames.
    static bool livesMostly(const std::vector<Sighting>& seen, FrameIndex first, FrameIndex last) {
        const auto within = std::count_if(
            seen.begin(), seen.end(), [&](const Sighting& each) { return each.frame >= first && each.frame <= last; });
        return 2 * static_cast<std::size_t>(within) >= seen.size();
    }

    /// Whether two tracks are in different places in most of the frames that they share.
    static bool areApart(const States& one, const States& other) {
        int shared = 0, apart = 0;
        for (const TrackFrame& each : other) {
            const TrackState* state = stateIn(one, each.frame);
            if (state == nullptr) continue;
            ++shared;
            const cv::Point2d way = state->box.centre - each.state.box.centre;
            apart += std::hypot(way.x, way.y) > std::max(state->box.length, each.state.box.length) ? 1 : 0;
        }
        return 2 * apart > shared;
    }

    void drop(TrackId id) {
        present_.erase(id);
        if (run_.tracks.contains(id)) replaced_.insert(id);
    }

    void keep(TrackId id, CorrectedTrack track) {
        renumber(track.states, id);
        present_[id] = std::move(track);
    }

    const TracksToCorrect& run_;
    const CameraMotion& camera_;
    std::map<TrackId, CorrectedTrack> present_;  ///< those of the run as they are have no corrections
    std::map<TrackId, CorrectedTrack> rejected_;
    std::set<TrackId> replaced_;
    std::map<int, TrackId> covering_;
};

}  // namespace

const char* nameOf(CorrectionState state) {
    constexpr std::array<const char*, 7> kNames = {"applied",
                                                   "covered by the run's own",
                                                   "no such track near",
                                                   "the tracks are in different places at the same time",
                                                   "not searched by this run",
                                                   "not found by this run",
                                                   "the only track of its vehicle in this run"};
    return kNames.at(static_cast<std::size_t>(state));
}

bool isLeft(CorrectionState state) {
    return state != CorrectionState::applied && state != CorrectionState::covered && state != CorrectionState::absent;
}

std::optional<double> likenessOf(const OrientedBox& a, const OrientedBox& b) {
    const cv::Point2d way = a.centre - b.centre;
    const double far = std::hypot(way.x, way.y);
    const double longer = std::max(a.length, b.length);
    if (far > longer) return std::nullopt;
    const double shared = overlap(a, b);
    if (shared < kLeastOverlap && far > kSameCentre * longer) return std::nullopt;
    return shared + kLeastOverlap * (1 - far / longer);
}

std::vector<TrackState> CorrectedTracks::in(FrameIndex frame, std::vector<TrackState> of_run) const {
    if (empty()) return of_run;
    std::erase_if(of_run, [&](const TrackState& state) { return replaced.contains(state.id); });
    for (const auto& [id, each] : tracks) {
        if (const TrackState* state = stateIn(each.states, frame)) of_run.push_back(*state);
    }
    std::sort(of_run.begin(), of_run.end(), [](const TrackState& a, const TrackState& b) { return a.id < b.id; });
    return of_run;
}

const CorrectedTrack* CorrectedTracks::track(TrackId id) const {
    const auto found = tracks.find(id);
    return found == tracks.end() ? nullptr : &found->second;
}

const CorrectedTrack* CorrectedTracks::touched(TrackId id) const {
    const auto found = rejected.find(id);
    return found == rejected.end() ? track(id) : &found->second;
}

CorrectedTracks correctTracks(const TracksToCorrect& run, const std::map<int, TrackCorrection>& corrections,
                              const CameraMotion& camera) {
    Workbench bench(run, camera);
    std::map<int, CorrectionState> states;
    std::map<CorrectionKind, int> applied;
    for (const auto& [id, correction] : corrections) {
        states[id] = bench.apply(correction);
        if (states[id] == CorrectionState::applied) ++applied[correction.kind];
    }
    CorrectedTracks result = bench.take();
    result.applied = std::move(applied);
    result.states = std::move(states);
    return result;
}

std::string correctionsInWords(const CorrectedTracks& corrected) {
    std::string text;
    const auto add = [&](CorrectionKind kind, const char* one, const char* many) {
        const auto found = corrected.applied.find(kind);
        if (found == corrected.applied.end()) return;
        text += (text.empty() ? "" : ", ") + std::to_string(found->second) + ' ' + (found->second == 1 ? one : many);
    };
    add(CorrectionKind::add, "track added", "tracks added");
    add(CorrectionKind::join, "join", "joins");
    add(CorrectionKind::split, "split", "splits");
    add(CorrectionKind::reject, "track rejected", "tracks rejected");
    const auto left = std::count_if(corrected.states.begin(), corrected.states.end(),
                                    [](const auto& each) { return isLeft(each.second); });
    if (left > 0)
        text += (text.empty() ? "" : "; ") + std::to_string(left) + (left == 1 ? " correction" : " corrections") +
                " could not be carried over";
    return text;
}

bool isOfResult(const std::vector<TrackFrame>& states) {
    return std::any_of(states.begin(), states.end(),
                       [](const TrackFrame& each) { return each.state.status != TrackStatus::tentative; });
}

}  // namespace eyrie
