#include "evaluation/hungarian.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "core/error.h"

namespace eyrie::hungarian_test {
namespace {

double totalOf(const Eigen::MatrixXd& score, const std::vector<int>& column_of_row) {
    double total = 0;
    for (std::size_t i = 0; i < column_of_row.size(); ++i) {
        if (column_of_row[i] >= 0) total += score(static_cast<Eigen::Index>(i), column_of_row[i]);
    }
    return total;
}

/// The best total over every way to assign; rows ≤ columns.
double bestByTrying(const Eigen::MatrixXd& score) {
    std::vector<int> columns(static_cast<std::size_t>(score.cols()));
    std::iota(columns.begin(), columns.end(), 0);
    double best = std::numeric_limits<double>::lowest();
    do {
        double total = 0;
        for (Eigen::Index i = 0; i < score.rows(); ++i) total += score(i, columns[static_cast<std::size_t>(i)]);
        best = std::max(best, total);
    } while (std::next_permutation(columns.begin(), columns.end()));
    return best;
}

void expectOneToOne(const std::vector<int>& column_of_row, Eigen::Index columns, std::size_t pairs) {
    std::vector<int> used;
    for (const int column : column_of_row) {
        if (column >= 0) used.push_back(column);
    }
    EXPECT_EQ(used.size(), pairs);
    std::sort(used.begin(), used.end());
    EXPECT_EQ(std::adjacent_find(used.begin(), used.end()), used.end());
    for (const int column : used) EXPECT_LT(column, columns);
}

TEST(Hungarian, FindsTheBestOfAllAssignments) {
    std::mt19937 random(5);
    std::uniform_int_distribution<int> size(1, 6);
    std::uniform_int_distribution<int> value(-4, 9);  // small range: many ties
    for (int trial = 0; trial < 300; ++trial) {
        Eigen::MatrixXd score(size(random), size(random));
        for (Eigen::Index k = 0; k < score.size(); ++k) score.data()[k] = value(random);
        const Eigen::MatrixXd turned = score.transpose();
        const bool wide = score.rows() <= score.cols();
        const std::vector<int> found = assignMaximum(score);
        ASSERT_EQ(found.size(), static_cast<std::size_t>(score.rows()));
        expectOneToOne(found, score.cols(), static_cast<std::size_t>(std::min(score.rows(), score.cols())));
        EXPECT_DOUBLE_EQ(totalOf(score, found), bestByTrying(wide ? score : turned));
    }
}

TEST(Hungarian, GreedyChoiceIsNotEnough) {
    Eigen::MatrixXd score(2, 2);
    score << 0.9, 0.8, 0.85, 0.1;
    EXPECT_EQ(assignMaximum(score), (std::vector<int>{1, 0}));
}

TEST(Hungarian, EqualScoresPairInOrder) {
    EXPECT_EQ(assignMaximum(Eigen::MatrixXd::Constant(3, 3, 0.5)), (std::vector<int>{0, 1, 2}));
}

TEST(Hungarian, EmptySides) {
    EXPECT_TRUE(assignMaximum(Eigen::MatrixXd(0, 0)).empty());
    EXPECT_TRUE(assignMaximum(Eigen::MatrixXd(0, 4)).empty());
    EXPECT_EQ(assignMaximum(Eigen::MatrixXd(2, 0)), (std::vector<int>{-1, -1}));
}

TEST(Hungarian, RefusesWhatIsNoNumber) {
    Eigen::MatrixXd score = Eigen::MatrixXd::Zero(2, 2);
    score(1, 0) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(assignMaximum(score), Error);
}

}  // namespace
}  // namespace eyrie::hungarian_test
