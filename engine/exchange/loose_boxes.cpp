#include "exchange/loose_boxes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "formats/free_numbers.h"

namespace eyrie {
namespace {

constexpr double kLeastOverlap = 0.3;

/// An object while it is linked.
struct Chain {
    int id = 0;
    OrientedBox last;
    cv::Point2d step;  ///< from the box before the last
    std::string object_class;

    OrientedBox expected() const {
        OrientedBox box = last;
        box.centre += step;
        return box.upright();
    }
};

struct Pair {
    double overlap = 0;
    std::size_t chain = 0;
    std::size_t box = 0;
};

bool isLoose(const LabelBox& record) {
    return !record.id && !record.ignore;
}

std::vector<LabelBox*> looseBoxesOf(std::vector<LabelBox>& records) {
    std::vector<LabelBox*> loose;
    for (LabelBox& record : records)
        if (isLoose(record)) loose.push_back(&record);
    return loose;
}

/// Pairs that may be one object, best first.
std::vector<Pair> pairsOf(const std::vector<Chain>& chains, const std::vector<LabelBox*>& boxes) {
    std::vector<OrientedBox> upright;
    for (const LabelBox* record : boxes) upright.push_back(record->box.upright());
    std::vector<Pair> pairs;
    for (std::size_t c = 0; c < chains.size(); ++c) {
        const OrientedBox expected = chains[c].expected();
        for (std::size_t b = 0; b < boxes.size(); ++b) {
            if (boxes[b]->object_class != chains[c].object_class) continue;
            const cv::Point2d apart = upright[b].centre - expected.centre;
            if (2 * std::abs(apart.x) >= upright[b].length + expected.length ||
                2 * std::abs(apart.y) >= upright[b].width + expected.width)
                continue;
            const double shared = overlap(expected, upright[b]);
            if (shared >= kLeastOverlap) pairs.push_back({shared, c, b});
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.overlap > b.overlap; });
    return pairs;
}

/// Gives the frame's boxes ids, counts those that begin `objects`, and answers the objects that go on from here.
std::vector<Chain> linked(const std::vector<Chain>& chains, const std::vector<LabelBox*>& boxes, FreeNumbers& ids,
                          int& objects) {
    std::vector<bool> chain_used(chains.size(), false), box_used(boxes.size(), false);
    std::vector<Chain> going_on;
    for (const Pair& pair : pairsOf(chains, boxes)) {
        if (chain_used[pair.chain] || box_used[pair.box]) continue;
        chain_used[pair.chain] = box_used[pair.box] = true;
        const Chain& chain = chains[pair.chain];
        LabelBox& record = *boxes[pair.box];
        record.id = chain.id;
        going_on.push_back({chain.id, record.box, record.box.centre - chain.last.centre, chain.object_class});
    }
    for (std::size_t b = 0; b < boxes.size(); ++b) {
        if (box_used[b]) continue;
        boxes[b]->id = ids.next();
        ++objects;
        going_on.push_back({*boxes[b]->id, boxes[b]->box, {0, 0}, boxes[b]->object_class});
    }
    return going_on;
}

}  // namespace

LooseBoxCount gatherLooseBoxes(LabelFile& labels, LooseBoxes how) {
    LooseBoxCount count;
    FreeNumbers ids(labels.boxes);
    std::vector<Chain> chains;
    FrameIndex before = -2;
    for (auto& [frame, records] : labels.boxes) {
        const std::vector<LabelBox*> loose = looseBoxesOf(records);
        count.boxes += static_cast<int>(loose.size());
        if (how == LooseBoxes::single || before + 1 != frame) chains.clear();
        chains = linked(chains, loose, ids, count.objects);
        before = frame;
    }
    if (count.boxes > 0) labels.objects.clear();  // now the boxes make the objects
    return count;
}

}  // namespace eyrie
