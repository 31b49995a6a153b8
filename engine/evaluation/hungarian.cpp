#include "evaluation/hungarian.h"

#include <limits>

#include "core/error.h"

namespace eyrie {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Assigns all rows of a cost matrix with no more rows than columns, one row after the other.
class Assignment {
 public:
    explicit Assignment(const Eigen::MatrixXd& cost)
        : cost_(cost),
          row_price_(static_cast<std::size_t>(cost.rows()), 0.0),
          column_price_(static_cast<std::size_t>(cost.cols()), 0.0),
          column_of_row_(static_cast<std::size_t>(cost.rows()), -1),
          row_of_column_(static_cast<std::size_t>(cost.cols()), -1),
          reached_from_(static_cast<std::size_t>(cost.cols()), -1),
          distance_(static_cast<std::size_t>(cost.cols()), kInfinity) {}

    std::vector<int> solve() {
        for (int row = 0; row < cost_.rows(); ++row) {
            const int free_column = search(row);
            raisePrices(row);
            augment(row, free_column);
        }
        return column_of_row_;
    }

 private:
    /// Grows a tree of cheapest alternating paths from `start` until it meets a free column, which is returned.
    int search(int start) {
        std::fill(distance_.begin(), distance_.end(), kInfinity);
        tree_rows_.clear();
        tree_columns_.clear();
        // Last column first, so that equal costs pair row i with column i.
        open_.clear();
        for (int column = static_cast<int>(cost_.cols()) - 1; column >= 0; --column) open_.push_back(column);
        double reached = 0;
        int row = start;
        for (;;) {
            tree_rows_.push_back(row);
            std::size_t best = 0;
            double lowest = kInfinity;
            for (std::size_t k = 0; k < open_.size(); ++k) {
                const auto column = static_cast<std::size_t>(open_[k]);
                const double through =
                    reached + cost_(row, open_[k]) - row_price_[static_cast<std::size_t>(row)] - column_price_[column];
                if (through < distance_[column]) {
                    distance_[column] = through;
                    reached_from_[column] = row;
                }
                // Among equals a free column ends the search at once.
                if (distance_[column] < lowest || (distance_[column] == lowest && row_of_column_[column] < 0)) {
                    lowest = distance_[column];
                    best = k;
                }
            }
            const int column = open_[best];
            open_[best] = open_.back();
            open_.pop_back();
            tree_columns_.push_back(column);
            reached = lowest;
            row = row_of_column_[static_cast<std::size_t>(column)];
            if (row < 0) {
                reached_ = reached;
                return column;
            }
        }
    }

    void raisePrices(int start) {
        for (const int row : tree_rows_) {
            const auto r = static_cast<std::size_t>(row);
            row_price_[r] +=
                row == start ? reached_ : reached_ - distance_[static_cast<std::size_t>(column_of_row_[r])];
        }
        for (const int column : tree_columns_) {
            const auto c = static_cast<std::size_t>(column);
            column_price_[c] -= reached_ - distance_[c];
        }
    }

    void augment(int start, int column) {
        for (;;) {
            const int row = reached_from_[static_cast<std::size_t>(column)];
            row_of_column_[static_cast<std::size_t>(column)] = row;
            std::swap(column, column_of_row_[static_cast<std::size_t>(row)]);
            if (row == start) return;
        }
    }

    const Eigen::MatrixXd& cost_;
    std::vector<double> row_price_;
    std::vector<double> column_price_;
    std::vector<int> column_of_row_;
    std::vector<int> row_of_column_;
    std::vector<int> reached_from_;
    std::vector<double> distance_;
    std::vector<int> tree_rows_;
    std::vector<int> tree_columns_;
    std::vector<int> open_;
    double reached_ = 0;
};

}  // namespace

std::vector<int> assignMaximum(const Eigen::MatrixXd& score) {
    if (!score.allFinite()) throw Error(ErrorKind::internal, "assignment: a score is not a finite number");
    if (score.rows() <= score.cols()) {
        const Eigen::MatrixXd cost = -score;
        return Assignment(cost).solve();
    }
    const Eigen::MatrixXd cost = -score.transpose();
    const std::vector<int> row_of_column = Assignment(cost).solve();
    std::vector<int> column_of_row(static_cast<std::size_t>(score.rows()), -1);
    for (std::size_t column = 0; column < row_of_column.size(); ++column) {
        column_of_row[static_cast<std::size_t>(row_of_column[column])] = static_cast<int>(column);
    }
    return column_of_row;
}

}  // namespace eyrie
