#include "motion/vectors/corner_history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "core/error.h"

namespace eyrie::corner_history_test {
namespace {

Corner corner(CornerId id, float x, int age) {
    Corner made;
    made.id = id;
    made.current = {x, -x};
    made.age = age;
    return made;
}

TEST(CornerHistory, RemembersItsDepth) {
    CornerHistory history(3);
    for (int t = 0; t < 10; ++t) {
        history.append({corner(5, static_cast<float>(t), t)});
        EXPECT_EQ(history.steps(0), std::min(t, 3));
        for (int n = 0; n <= history.steps(0); ++n) EXPECT_EQ(history.past(0, n).x, static_cast<float>(t - n));
    }
}

TEST(CornerHistory, ForgetsTheLostAndStartsTheReborn) {
    CornerHistory history(5);
    history.append({corner(1, 1, 0), corner(2, 2, 0), corner(3, 3, 0)});
    history.append({corner(1, 1, 1), corner(3, 3, 1), corner(4, 4, 0)});
    EXPECT_EQ(history.steps(1), 1);
    EXPECT_EQ(history.steps(2), 0);
    history.append({corner(1, 1, 2), corner(2, 2, 0), corner(3, 3, 0)});
    EXPECT_EQ(history.steps(0), 2);
    EXPECT_EQ(history.steps(1), 0) << "it was missing in between";
    EXPECT_EQ(history.steps(2), 0) << "age 0 starts anew";
    history.clear();
    history.append({corner(1, 1, 9)});
    EXPECT_EQ(history.steps(0), 0);
}

TEST(CornerHistory, EqualsAPlainMapOfLists) {
    std::mt19937 random(9);
    CornerHistory history(4);
    std::map<CornerId, std::vector<float>> slow;
    CornerId next_id = 1;
    for (int t = 0; t < 60; ++t) {
        std::map<CornerId, std::vector<float>> alive;
        for (auto& [id, xs] : slow) {
            if (random() % 5 != 0) alive[id] = xs;
        }
        for (unsigned n = random() % 8; n > 0; --n) alive[next_id++] = {};
        std::vector<Corner> corners;
        for (auto& [id, xs] : alive) {
            xs.push_back(static_cast<float>(random() % 1000));
            corners.push_back(corner(id, xs.back(), static_cast<int>(xs.size()) - 1));
        }
        slow = alive;
        history.append(corners);
        std::size_t i = 0;
        for (const auto& [id, xs] : slow) {
            const int known = std::min(4, static_cast<int>(xs.size()) - 1);
            ASSERT_EQ(history.steps(i), known);
            for (int n = 0; n <= known; ++n)
                ASSERT_EQ(history.past(i, n).x, xs[xs.size() - 1 - static_cast<std::size_t>(n)]);
            ++i;
        }
    }
}

TEST(CornerHistory, RefusesUnsortedCorners) {
    CornerHistory history(2);
    EXPECT_THROW(history.append({corner(2, 0, 0), corner(1, 0, 0)}), Error);
    CornerHistory other(2);
    EXPECT_THROW(other.append({corner(2, 0, 0), corner(2, 0, 0)}), Error);
}

}  // namespace
}  // namespace eyrie::corner_history_test
