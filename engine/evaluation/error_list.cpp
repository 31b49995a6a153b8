#include "evaluation/error_list.h"

#include <algorithm>
#include <map>
#include <optional>

namespace eyrie {
namespace {

constexpr double kSameBox = 0.3;   ///< overlap from which boxes without id in neighbouring frames are one thing
constexpr double kPart = 0.5;      ///< share of a part that lies in the whole
constexpr double kSameArea = 0.5;  ///< share from which two parts lie on one another rather than side by side

const std::vector<BoxRecord>& recordsOf(const BoxesByFrame& boxes, FrameIndex frame) {
    static const std::vector<BoxRecord> nothing;
    const auto found = boxes.find(frame);
    return found == boxes.end() ? nothing : found->second;
}

const BoxRecord& at(const std::vector<BoxRecord>& records, int index) {
    return records[static_cast<std::size_t>(index)];
}

double shareInside(const OrientedBox& part, const OrientedBox& whole) {
    const double area = part.area();
    return area > 0 ? intersectionArea(part, whole) / area : 0;
}

void addId(std::vector<int>& ids, const std::optional<int>& id) {
    if (id && std::find(ids.begin(), ids.end(), *id) == ids.end()) ids.push_back(*id);
}

/// Puts errors of one kind together that go on from frame to frame.
class Grouping {
 public:
    Grouping(ResultErrorKind kind, std::vector<ResultError>& errors) : kind_(kind), errors_(errors) {}

    void nextFrame() {
        before_ = std::move(now_);
        now_.clear();
    }
    /// The error that the place belongs to, new or continued; `id`: of what is followed.
    ResultError& add(std::optional<int> id, ErrorPlace place) {
        const std::size_t index = find(id, place.box);
        ResultError& error = errors_[index];
        if (error.places.empty()) error.first_frame = place.frame;
        error.last_frame = place.frame;
        now_.push_back({id, place.box, index});
        error.places.push_back(std::move(place));
        return error;
    }

 private:
    struct Open {
        std::optional<int> id;
        OrientedBox box;
        std::size_t error;
    };
    std::size_t find(const std::optional<int>& id, const OrientedBox& box) {
        for (const Open& open : before_)
            if (open.id == id && (id || overlap(open.box, box) >= kSameBox)) return open.error;
        errors_.push_back({});
        errors_.back().kind = kind_;
        return errors_.size() - 1;
    }

    ResultErrorKind kind_;
    std::vector<ResultError>& errors_;
    std::vector<Open> before_;
    std::vector<Open> now_;
};

/// Splits and merges of one frame.
class PartFinder {
 public:
    PartFinder(const std::vector<BoxRecord>& truth, const std::vector<BoxRecord>& result, const EvaluationFrame& frame,
               bool upright)
        : truth_(truth), result_(result), frame_(frame), upright_(upright) {}

    /// Results that lie side by side in the object, ascending; fewer than two: none is meant.
    std::vector<int> partsOf(int object) const {
        const OrientedBox whole = shown(at(truth_, object).box);
        std::vector<int> inside;
        for (const int result : frame_.results)
            if (shareInside(shown(at(result_, result).box), whole) >= kPart) inside.push_back(result);
        std::vector<int> parts;
        for (const int one : inside) {
            const bool beside = std::any_of(inside.begin(), inside.end(), [&](int other) {
                return other != one && sideBySide(at(result_, one).box, at(result_, other).box);
            });
            if (beside) parts.push_back(one);
        }
        return parts;
    }
    /// Counting objects that lie mostly in the result, ascending.
    std::vector<int> objectsIn(int result) const {
        const OrientedBox whole = shown(at(result_, result).box);
        std::vector<int> inside;
        for (const int object : frame_.truth)
            if (shareInside(shown(at(truth_, object).box), whole) >= kPart) inside.push_back(object);
        return inside;
    }

 private:
    OrientedBox shown(const OrientedBox& box) const { return upright_ ? box.upright() : box; }
    bool sideBySide(const OrientedBox& a, const OrientedBox& b) const {
        return containment(shown(a), shown(b)) < kSameArea;
    }

    const std::vector<BoxRecord>& truth_;
    const std::vector<BoxRecord>& result_;
    const EvaluationFrame& frame_;
    bool upright_;
};

/// Switches and fragments of true tracks; the same rules as tallyTracks().
class IdentityFinder {
 public:
    IdentityFinder(Convention convention, std::vector<ResultError>& errors)
        : thesis_(convention == Convention::thesis), errors_(errors) {}

    void matched(int object, int track, const ErrorPlace& place) {
        Memory& memory = memory_[object];
        if (memory.track && *memory.track != track) {
            ResultError error;
            error.kind = ResultErrorKind::id_switch;
            error.objects = {object};
            error.tracks = {*memory.track, track};
            error.first_frame = memory.matched_in;
            error.last_frame = place.frame;
            error.places.push_back(place);
            errors_.push_back(std::move(error));
        }
        if (!thesis_ && memory.track && !memory.tracked) begin(object, memory, memory.lost_at);
        memory.fragment.reset();
        memory.track = track;
        memory.tracked = true;
        memory.matched_in = place.frame;
        memory.box = place.box;
        memory.lost_at.frame = -1;
    }
    void missed(int object, const ErrorPlace& place) {
        Memory& memory = memory_[object];
        if (memory.fragment) errors_[*memory.fragment].last_frame = place.frame;
        if (memory.tracked && memory.lost_at.frame < 0) memory.lost_at = place;
        if (!thesis_ || !memory.tracked) return;
        memory.tracked = false;
        begin(object, memory, place);
    }
    /// For trackeval, whose tracked runs end with absence, too.
    void endFrame(FrameIndex frame, bool passed_over) {
        if (thesis_ || passed_over) return;
        for (auto& [object, memory] : memory_) {
            if (!memory.track || memory.matched_in == frame) continue;
            if (memory.lost_at.frame < 0) {
                memory.lost_at = {};
                memory.lost_at.frame = frame;
                memory.lost_at.box = memory.box;
            }
            memory.tracked = false;
        }
    }

 private:
    struct Memory {
        std::optional<int> track;
        bool tracked = false;
        FrameIndex matched_in = -1;
        OrientedBox box;  ///< there
        ErrorPlace lost_at{.frame = -1, .box = {}, .truth = {}, .results = {}};
        std::optional<std::size_t> fragment;  ///< the one that goes on
    };
    void begin(int object, Memory& memory, const ErrorPlace& place) {
        ResultError error;
        error.kind = ResultErrorKind::fragment;
        error.objects = {object};
        if (memory.track) error.tracks = {*memory.track};
        error.first_frame = error.last_frame = place.frame;
        error.places.push_back(place);
        memory.fragment = errors_.size();
        errors_.push_back(std::move(error));
    }

    bool thesis_;
    std::vector<ResultError>& errors_;
    std::map<int, Memory> memory_;
};

void findParts(const std::vector<BoxRecord>& truth, const std::vector<BoxRecord>& result, const EvaluationFrame& frame,
               const FrameMatch& match, bool upright, Grouping& splits, Grouping& merges) {
    const PartFinder finder(truth, result, frame, upright);
    for (const int object : frame.truth) {
        std::vector<int> parts = finder.partsOf(object);
        if (parts.size() < 2) continue;
        const BoxRecord& record = at(truth, object);
        ResultError& error = splits.add(record.id, {frame.frame, record.box, {object}, parts});
        addId(error.objects, record.id);
        for (const int part : parts) addId(error.tracks, at(result, part).id);
    }
    for (const int index : frame.results) {
        std::vector<int> objects = finder.objectsIn(index);
        if (objects.size() < 2) continue;
        const bool any_missed = std::any_of(objects.begin(), objects.end(), [&](int object) {
            return std::find(match.missed.begin(), match.missed.end(), object) != match.missed.end();
        });
        if (!any_missed) continue;
        const BoxRecord& record = at(result, index);
        ResultError& error = merges.add(record.id, {frame.frame, record.box, objects, {index}});
        addId(error.tracks, record.id);
        for (const int object : objects) addId(error.objects, at(truth, object).id);
    }
}

}  // namespace

const char* nameOf(ResultErrorKind kind) {
    switch (kind) {
        case ResultErrorKind::miss:
            return "miss";
        case ResultErrorKind::false_alarm:
            return "false alarm";
        case ResultErrorKind::id_switch:
            return "switch";
        case ResultErrorKind::fragment:
            return "fragment";
        case ResultErrorKind::split:
            return "split";
        case ResultErrorKind::merge:
            return "merge";
    }
    return "";
}

std::vector<ResultError> listErrors(const BoxesByFrame& truth, const BoxesByFrame& result, const EvaluationInput& input,
                                    const std::vector<FrameMatch>& matches, const EvaluationOptions& options) {
    std::vector<ResultError> errors;
    Grouping misses(ResultErrorKind::miss, errors);
    Grouping alarms(ResultErrorKind::false_alarm, errors);
    Grouping splits(ResultErrorKind::split, errors);
    Grouping merges(ResultErrorKind::merge, errors);
    IdentityFinder identities(options.convention, errors);

    for (std::size_t f = 0; f < matches.size(); ++f) {
        const EvaluationFrame& frame = input.frames[f];
        const FrameMatch& match = matches[f];
        const auto& objects = recordsOf(truth, frame.frame);
        const auto& results = recordsOf(result, frame.frame);
        for (Grouping* grouping : {&misses, &alarms, &splits, &merges}) grouping->nextFrame();
        if (input.has_tracks) {
            for (const MatchedPair& pair : match.pairs) {
                const BoxRecord& object = at(objects, pair.truth);
                identities.matched(*object.id, *at(results, pair.result).id,
                                   {frame.frame, object.box, {pair.truth}, {pair.result}});
            }
        }
        for (const int index : match.missed) {
            const BoxRecord& object = at(objects, index);
            const ErrorPlace place{frame.frame, object.box, {index}, {}};
            ResultError& error = misses.add(object.id, place);
            addId(error.objects, object.id);
            if (input.has_tracks) identities.missed(*object.id, place);
        }
        if (input.has_tracks) identities.endFrame(frame.frame, frame.truth.empty() || frame.results.empty());
        for (const int index : match.false_results) {
            const BoxRecord& record = at(results, index);
            ResultError& error = alarms.add(record.id, {frame.frame, record.box, {}, {index}});
            addId(error.tracks, record.id);
        }
        findParts(objects, results, frame, match, options.upright, splits, merges);
    }
    std::stable_sort(errors.begin(), errors.end(), [](const ResultError& a, const ResultError& b) {
        return a.first_frame != b.first_frame ? a.first_frame < b.first_frame : a.kind < b.kind;
    });
    return errors;
}

}  // namespace eyrie
