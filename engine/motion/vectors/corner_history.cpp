#include "motion/vectors/corner_history.h"

#include <algorithm>
#include <string>

#include "core/error.h"

namespace eyrie {

CornerHistory::CornerHistory(int depth) : depth_(std::max(depth, 1)), ring_(static_cast<std::size_t>(depth_) + 1) {}

void CornerHistory::clear() {
    entries_.clear();
    positions_.clear();
    free_slots_.clear();
    step_ = -1;
}

std::size_t CornerHistory::takeSlot() {
    if (!free_slots_.empty()) {
        const std::size_t slot = free_slots_.back();
        free_slots_.pop_back();
        return slot;
    }
    const std::size_t slot = positions_.size() / ring_;
    positions_.resize(positions_.size() + ring_);
    return slot;
}

cv::Point2f& CornerHistory::position(std::size_t slot, std::int64_t step) {
    return positions_[slot * ring_ + static_cast<std::size_t>(step) % ring_];
}

void CornerHistory::append(const std::vector<Corner>& corners) {
    ++step_;
    merged_.clear();
    merged_.reserve(corners.size());
    std::size_t old = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Corner& corner = corners[i];
        if (i > 0 && corner.id <= corners[i - 1].id) {
            throw Error(ErrorKind::internal, "corners are not sorted by id: " + std::to_string(corner.id) + " after " +
                                                 std::to_string(corners[i - 1].id));
        }
        while (old < entries_.size() && entries_[old].id < corner.id) free_slots_.push_back(entries_[old++].slot);
        const bool known = old < entries_.size() && entries_[old].id == corner.id;
        Entry entry{corner.id, 0, step_};
        if (known) {
            entry.slot = entries_[old].slot;
            if (corner.age > 0) entry.first_step = entries_[old].first_step;
            ++old;
        } else {
            entry.slot = takeSlot();
        }
        position(entry.slot, step_) = corner.current;
        merged_.push_back(entry);
    }
    while (old < entries_.size()) free_slots_.push_back(entries_[old++].slot);
    entries_.swap(merged_);
}

int CornerHistory::steps(std::size_t i) const {
    return static_cast<int>(std::min<std::int64_t>(step_ - entries_[i].first_step, depth_));
}

int CornerHistory::longest() const {
    int longest = 0;
    for (std::size_t i = 0; i < entries_.size(); ++i) longest = std::max(longest, steps(i));
    return longest;
}

cv::Point2f CornerHistory::past(std::size_t i, int n) const {
    return positions_[entries_[i].slot * ring_ + static_cast<std::size_t>(step_ - n) % ring_];
}

}  // namespace eyrie
