#pragma once

#include <algorithm>
#include <limits>
#include <set>

#include "formats/label_file.h"

namespace eyrie {

/// Ids for boxes that have none: above all that are in use, or, above the largest there is, the lowest that are free.
class FreeNumbers {
 public:
    FreeNumbers() = default;
    explicit FreeNumbers(const LabelBoxes& boxes) {
        for (const auto& [frame, records] : boxes) {
            for (const LabelBox& record : records)
                if (record.id) use(*record.id);
        }
    }
    /// Nobody may ask for the next one before all that are used are known.
    void use(int id) {
        used_.insert(id);
        highest_ = std::max(highest_, id);
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
