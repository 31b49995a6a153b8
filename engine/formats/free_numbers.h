#pragma once

#include <algorithm>
#include <limits>
#include <set>

#include "formats/label_file.h"

namespace eyrie {

/// Ids for boxes that have none: above all that are in use, or, above the largest there is, the lowest that are free.
class FreeNumbers {
 public:
    explicit FreeNumbers(const LabelBoxes& boxes) {
        for (const auto& [frame, records] : boxes) {
            for (const LabelBox& record : records)
                if (record.id) used_.insert(*record.id);
        }
        highest_ = used_.empty() ? 0 : std::max(0, *used_.rbegin());
    }
    int next() {
        if (highest_ < std::numeric_limits<int>::max()) return ++highest_;
        while (used_.count(lowest_) > 0) ++lowest_;
        return lowest_++;
    }

 private:
    std::set<int> used_;
    int highest_ = 0;
    int lowest_ = 1;
};

}  // namespace eyrie
