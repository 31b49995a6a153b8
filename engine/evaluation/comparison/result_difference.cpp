#include "evaluation/comparison/result_difference.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace eyrie {
namespace {

struct Pair {
    std::size_t first = 0;
    std::size_t second = 0;
    double overlap = 0;
};

/// One-to-one pairs of the largest overlap first.
std::vector<Pair> pairsOf(const std::vector<BoxRecord>& first, const std::vector<BoxRecord>& second, double least) {
    std::vector<Pair> all;
    for (std::size_t i = 0; i < first.size(); ++i) {
        for (std::size_t k = 0; k < second.size(); ++k) {
            const double shared = overlap(first[i].box, second[k].box);
            if (shared >= least) all.push_back({i, k, shared});
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const Pair& a, const Pair& b) { return a.overlap > b.overlap; });
    std::vector<char> first_taken(first.size(), 0);
    std::vector<char> second_taken(second.size(), 0);
    std::vector<Pair> chosen;
    for (const Pair& pair : all) {
        if (first_taken[pair.first] || second_taken[pair.second]) continue;
        first_taken[pair.first] = second_taken[pair.second] = 1;
        chosen.push_back(pair);
    }
    return chosen;
}

/// Grows differences frame by frame.
class Collector {
 public:
    explicit Collector(const DifferenceLimits& limits) : limits_(limits) {}

    void add(DifferenceKind kind, FrameIndex frame, std::optional<int> first_id, std::optional<int> second_id,
             const OrientedBox& box, double size) {
        for (auto& open : open_) {
            ResultDifference& known = open.difference;
            if (known.kind != kind || known.first_id != first_id || known.second_id != second_id) continue;
            if (frame - known.last_frame > limits_.gap + 1 || known.last_frame == frame) continue;
            const bool anonymous = !first_id && !second_id;
            if (anonymous && overlap(open.last_box, box) < limits_.same_object) continue;
            known.last_frame = frame;
            known.size += size;
            open.last_box = box;
            if (size > open.worst) {
                open.worst = size;
                known.worst_frame = frame;
                known.box = box;
            }
            return;
        }
        open_.push_back({{kind, frame, frame, frame, first_id, second_id, box, size}, box, size});
    }

    void closeBefore(FrameIndex frame) {
        const auto over = std::partition(open_.begin(), open_.end(), [&](const Open& open) {
            return frame - open.difference.last_frame <= limits_.gap + 1;
        });
        for (auto open = over; open != open_.end(); ++open) closed_.push_back(open->difference);
        open_.erase(over, open_.end());
    }

    std::vector<ResultDifference> finish() {
        for (Open& open : open_) closed_.push_back(open.difference);
        std::stable_sort(closed_.begin(), closed_.end(), [](const ResultDifference& a, const ResultDifference& b) {
            return std::tuple(-a.size, a.first_frame, a.first_id, a.second_id) <
                   std::tuple(-b.size, b.first_frame, b.first_id, b.second_id);
        });
        return std::move(closed_);
    }

 private:
    struct Open {
        ResultDifference difference;
        OrientedBox last_box;
        double worst = 0;
    };
    DifferenceLimits limits_;
    std::vector<Open> open_;
    std::vector<ResultDifference> closed_;
};

}  // namespace

std::vector<ResultDifference> differencesOf(const BoxesByFrame& first, const BoxesByFrame& second,
                                            const DifferenceLimits& limits) {
    static const std::vector<BoxRecord> none;
    std::set<FrameIndex> frames;
    for (const auto& [frame, boxes] : first) frames.insert(frame);
    for (const auto& [frame, boxes] : second) frames.insert(frame);
    Collector collector(limits);
    std::map<int, int> partner_of_first;  // whom each object was last paired with
    std::map<int, int> partner_of_second;
    for (const FrameIndex frame : frames) {
        collector.closeBefore(frame);
        const auto in_first = first.find(frame);
        const auto in_second = second.find(frame);
        const auto& a = in_first == first.end() ? none : in_first->second;
        const auto& b = in_second == second.end() ? none : in_second->second;
        std::vector<char> a_paired(a.size(), 0);
        std::vector<char> b_paired(b.size(), 0);
        for (const Pair& pair : pairsOf(a, b, limits.same_object)) {
            a_paired[pair.first] = b_paired[pair.second] = 1;
            const BoxRecord& one = a[pair.first];
            const BoxRecord& other = b[pair.second];
            if (pair.overlap < limits.same_box)
                collector.add(DifferenceKind::box, frame, one.id, other.id, one.box, 1 - pair.overlap);
            if (!one.id || !other.id) continue;
            const auto before = partner_of_first.find(*one.id);
            const auto before_other = partner_of_second.find(*other.id);
            const bool changed = (before != partner_of_first.end() && before->second != *other.id) ||
                                 (before_other != partner_of_second.end() && before_other->second != *one.id);
            if (changed) collector.add(DifferenceKind::identity, frame, one.id, other.id, one.box, 1);
            partner_of_first[*one.id] = *other.id;
            partner_of_second[*other.id] = *one.id;
        }
        for (std::size_t i = 0; i < a.size(); ++i)
            if (!a_paired[i]) collector.add(DifferenceKind::only_first, frame, a[i].id, std::nullopt, a[i].box, 1);
        for (std::size_t i = 0; i < b.size(); ++i)
            if (!b_paired[i]) collector.add(DifferenceKind::only_second, frame, std::nullopt, b[i].id, b[i].box, 1);
    }
    return collector.finish();
}

}  // namespace eyrie
