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

/// Puts mistakes of one kind together that go on from frame to frame.
class Grouping {
 public:
    Grouping(MistakeKind kind, std::vector<Mistake>& mistakes) : kind_(kind), mistakes_(mistakes) {}

    void nextFrame() {
        before_ = std::move(now_);
        now_.clear();
    }
    /// The mistake that the place belongs to, new or continued; `id`: of what is followed.
    Mistake& add(std::optional<int> id, MistakePlace place) {
        const std::size_t index = find(id, place.box);
        Mistake& mistake = mistakes_[index];
        if (mistake.places.empty()) mistake.first_frame = place.frame;
        mistake.last_frame = place.frame;
        now_.push_back({id, place.box, index});
        mistake.places.push_back(std::move(place));
        return mistake;
    }

 private:
    struct Open {
        std::optional<int> id;
        OrientedBox box;
        std::size_t mistake;
    };
    std::size_t find(const std::optional<int>& id, const OrientedBox& box) {
        for (const Open& open : before_)
            if (open.id == id && (id || overlap(open.box, box) >= kSameBox)) return open.mistake;
        mistakes_.push_back({});
        mistakes_.back().kind = kind_;
        return mistakes_.size() - 1;
    }

    MistakeKind kind_;
    std::vector<Mistake>& mistakes_;
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
    IdentityFinder(Convention convention, std::vector<Mistake>& mistakes)
        : thesis_(convention == Convention::thesis), mistakes_(mistakes) {}

    void matched(int object, int track, const MistakePlace& place) {
        Memory& memory = memory_[object];
        if (memory.track && *memory.track != track) {
            Mistake mistake;
            mistake.kind = MistakeKind::id_switch;
            mistake.objects = {object};
            mistake.tracks = {*memory.track, track};
            mistake.first_frame = memory.matched_in;
            mistake.last_frame = place.frame;
            mistake.places.push_back(place);
            mistakes_.push_back(std::move(mistake));
        }
        if (!thesis_ && memory.track && !memory.tracked) begin(object, memory, memory.lost_at);
        memory.fragment.reset();
        memory.track = track;
        memory.tracked = true;
        memory.matched_in = place.frame;
        memory.box = place.box;
        memory.lost_at.frame = -1;
    }
    void missed(int object, const MistakePlace& place) {
        Memory& memory = memory_[object];
        if (memory.fragment) mistakes_[*memory.fragment].last_frame = place.frame;
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
        MistakePlace lost_at{.frame = -1, .box = {}, .truth = {}, .results = {}};
        std::optional<std::size_t> fragment;  ///< the one that goes on
    };
    void begin(int object, Memory& memory, const MistakePlace& place) {
        Mistake mistake;
        mistake.kind = MistakeKind::fragment;
        mistake.objects = {object};
        if (memory.track) mistake.tracks = {*memory.track};
        mistake.first_frame = mistake.last_frame = place.frame;
        mistake.places.push_back(place);
        memory.fragment = mistakes_.size();
        mistakes_.push_back(std::move(mistake));
    }

    bool thesis_;
    std::vector<Mistake>& mistakes_;
    std::map<int, Memory> memory_;
};

void findParts(const std::vector<BoxRecord>& truth, const std::vector<BoxRecord>& result, const EvaluationFrame& frame,
               const FrameMatch& match, bool upright, Grouping& splits, Grouping& merges) {
    const PartFinder finder(truth, result, frame, upright);
    for (const int object : frame.truth) {
        std::vector<int> parts = finder.partsOf(object);
        if (parts.size() < 2) continue;
        const BoxRecord& record = at(truth, object);
        Mistake& mistake = splits.add(record.id, {frame.frame, record.box, {object}, parts});
        addId(mistake.objects, record.id);
        for (const int part : parts) addId(mistake.tracks, at(result, part).id);
    }
    for (const int index : frame.results) {
        std::vector<int> objects = finder.objectsIn(index);
        if (objects.size() < 2) continue;
        const bool any_missed = std::any_of(objects.begin(), objects.end(), [&](int object) {
            return std::find(match.missed.begin(), match.missed.end(), object) != match.missed.end();
        });
        if (!any_missed) continue;
        const BoxRecord& record = at(result, index);
        Mistake& mistake = merges.add(record.id, {frame.frame, record.box, objects, {index}});
        addId(mistake.tracks, record.id);
        for (const int object : objects) addId(mistake.objects, at(truth, object).id);
    }
}

}  // namespace

const char* nameOf(MistakeKind kind) {
    switch (kind) {
        case MistakeKind::miss:
            return "miss";
        case MistakeKind::false_alarm:
            return "false alarm";
        case MistakeKind::id_switch:
            return "switch";
        case MistakeKind::fragment:
            return "fragment";
        case MistakeKind::split:
            return "split";
        case MistakeKind::merge:
            return "merge";
    }
    return "";
}

std::vector<Mistake> listMistakes(const BoxesByFrame& truth, const BoxesByFrame& result, const EvaluationInput& input,
                                  const std::vector<FrameMatch>& matches, const EvaluationOptions& options) {
    std::vector<Mistake> mistakes;
    Grouping misses(MistakeKind::miss, mistakes);
    Grouping alarms(MistakeKind::false_alarm, mistakes);
    Grouping splits(MistakeKind::split, mistakes);
    Grouping merges(MistakeKind::merge, mistakes);
    IdentityFinder identities(options.convention, mistakes);

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
            const MistakePlace place{frame.frame, object.box, {index}, {}};
            Mistake& mistake = misses.add(object.id, place);
            addId(mistake.objects, object.id);
            if (input.has_tracks) identities.missed(*object.id, place);
        }
        if (input.has_tracks) identities.endFrame(frame.frame, frame.truth.empty() || frame.results.empty());
        for (const int index : match.false_results) {
            const BoxRecord& record = at(results, index);
            Mistake& mistake = alarms.add(record.id, {frame.frame, record.box, {}, {index}});
            addId(mistake.tracks, record.id);
        }
        findParts(objects, results, frame, match, options.upright, splits, merges);
    }
    std::stable_sort(mistakes.begin(), mistakes.end(), [](const Mistake& a, const Mistake& b) {
        return a.first_frame != b.first_frame ? a.first_frame < b.first_frame : a.kind < b.kind;
    });
    return mistakes;
}

}  // namespace eyrie
