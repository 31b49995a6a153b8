#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <tuple>
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
        if (changes.empty()) return;
        Course course{std::move(changes), {}};
        double sum = 0;
        FrameIndex frame = 0;
        double zoom = 1;
        for (const Change& change : course.changes) {
            sum += zoom * (change.first - frame);
            course.sums.push_back(sum);
            std::tie(frame, zoom) = change;
        }
        course_ = std::make_shared<const Course>(std::move(course));
    }

    bool isSteady() const { return !course_; }
    /// 1 in frames of before the first change.
    double at(FrameIndex frame) const {
        if (isSteady()) return 1;
        const std::size_t begun = changesUpTo(frame);
        return begun == 0 ? 1 : course_->changes[begun - 1].second;
    }
    /// Mean over these frames, both included.
    double meanOf(FrameIndex first, FrameIndex last) const {
        if (isSteady() || last <= first) return at(first);
        return (sumBefore(last + 1) - sumBefore(first)) / (last + 1 - first);
    }

 private:
    struct Course {
        std::vector<Change> changes;
        std::vector<double> sums;  ///< of the zooms of all frames before each change
    };
    /// How many changes a frame has behind it, its own among them.
    std::size_t changesUpTo(FrameIndex frame) const {
        const std::vector<Change>& changes = course_->changes;
        const auto later =
            std::upper_bound(changes.begin(), changes.end(), frame,
                             [](FrameIndex wanted, const Change& change) { return wanted < change.first; });
        return static_cast<std::size_t>(later - changes.begin());
    }
    double sumBefore(FrameIndex frame) const {
        const std::size_t begun = changesUpTo(frame);
        if (begun == 0) return frame;
        const Change& change = course_->changes[begun - 1];
        return course_->sums[begun - 1] + change.second * (frame - change.first);
    }

    std::shared_ptr<const Course> course_;  ///< null: the camera never zooms
};

}  // namespace eyrie
