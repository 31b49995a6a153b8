#pragma once

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "core/values/ids.h"

namespace eyrie {

/// How a camera zoomed over the frames of a run. Cheap to copy; never changes.
class ZoomCourse {
 public:
    /// From a frame on pixels per metre are those of the first frame times this.
    using Change = std::pair<FrameIndex, double>;

    /// The camera never zooms.
    ZoomCourse() = default;
    /// `changes` ascend by frame; before the first of them the camera has not zoomed.
    explicit ZoomCourse(std::vector<Change> changes) {
        if (!changes.empty()) changes_ = std::make_shared<const std::vector<Change>>(std::move(changes));
    }

    bool isSteady() const { return !changes_; }
    /// 1 in frames of before the first change.
    double at(FrameIndex frame) const {
        if (isSteady()) return 1;
        const auto later =
            std::upper_bound(changes_->begin(), changes_->end(), frame,
                             [](FrameIndex wanted, const Change& change) { return wanted < change.first; });
        return later == changes_->begin() ? 1 : std::prev(later)->second;
    }

    /// Mean over these frames, both included.
    double meanOf(FrameIndex first, FrameIndex last) const {
        if (isSteady() || last < first) return at(first);
        double sum = 0;
        for (FrameIndex frame = first; frame <= last; ++frame) sum += at(frame);
        return sum / (last - first + 1);
    }

 private:
    std::shared_ptr<const std::vector<Change>> changes_;  ///< null: none
};

}  // namespace eyrie
