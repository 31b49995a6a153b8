#pragma once

#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "core/values/corner.h"

namespace eyrie {

/// Where every living corner was in the last pictures. Positions lie in one ring per corner; corners come sorted by id,
/// so that a picture is added by one linear merge.
class CornerHistory {
 public:
    /// Remembers `depth` ≥ 1 pictures before the newest.
    explicit CornerHistory(int depth);

    void clear();
    /// Adds a picture. Corners that are missing in it are forgotten; a corner with age 0 starts anew. Throws
    /// Error(internal) unless ids ascend strictly.
    void append(const std::vector<Corner>& corners);

    int depth() const { return depth_; }
    /// How many pictures back corner `i` of the last `append` is known, 0 … depth.
    int steps(std::size_t i) const;
    /// The most steps of any corner.
    int longest() const;
    /// Its position `n` pictures back, 0 ≤ n ≤ steps(i).
    cv::Point2f past(std::size_t i, int n) const;

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    struct Entry {
        CornerId id = 0;
        std::size_t slot = 0;         ///< ring in `positions_`
        std::int64_t first_step = 0;  ///< picture it was first seen in
    };
    std::size_t takeSlot();
    cv::Point2f& position(std::size_t slot, std::int64_t step);

    int depth_;
    std::size_t ring_;  ///< positions per corner
    std::int64_t step_ = -1;
    std::vector<Entry> entries_;  ///< parallel to the corners of the last append
    std::vector<Entry> merged_;
    std::vector<cv::Point2f> positions_;
    std::vector<std::size_t> free_slots_;
};

}  // namespace eyrie
