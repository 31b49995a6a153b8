#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

namespace eyrie {

/// Points and where they went, column by column for the vector units.
struct Correspondences {
    std::vector<float> from_x;
    std::vector<float> from_y;
    std::vector<float> to_x;
    std::vector<float> to_y;
    std::vector<float> weight;  ///< 0 … 1: how much each may say

    int size() const { return static_cast<int>(from_x.size()); }
    void clear() {
        for (auto* column : {&from_x, &from_y, &to_x, &to_y, &weight}) column->clear();
    }
    void reserve(std::size_t count) {
        for (auto* column : {&from_x, &from_y, &to_x, &to_y, &weight}) column->reserve(count);
    }
    void add(cv::Point2f from, cv::Point2f to, float its_weight = 1) {
        from_x.push_back(from.x);
        from_y.push_back(from.y);
        to_x.push_back(to.x);
        to_y.push_back(to.y);
        weight.push_back(its_weight);
    }
};

}  // namespace eyrie
