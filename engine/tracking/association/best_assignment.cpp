#include "tracking/association/best_assignment.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace eyrie {
namespace {

using Matrix = std::vector<std::vector<double>>;

/// Hungarian method with potentials for a cost matrix with rows ≤ columns; gives the column of each row.
std::vector<int> cheapestColumns(const Matrix& cost) {
    const std::size_t rows = cost.size();
    const std::size_t columns = cost.front().size();
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    // Index 0 is a sentinel in all of these.
    std::vector<double> row_potential(rows + 1, 0);
    std::vector<double> column_potential(columns + 1, 0);
    std::vector<std::size_t> row_of(columns + 1, 0);
    std::vector<std::size_t> before(columns + 1, 0);
    for (std::size_t row = 1; row <= rows; ++row) {
        row_of[0] = row;
        std::size_t column = 0;
        std::vector<double> slack(columns + 1, kInfinite);
        std::vector<char> reached(columns + 1, 0);
        do {
            reached[column] = 1;
            const std::size_t here = row_of[column];
            double step = kInfinite;
            std::size_t next = 0;
            for (std::size_t c = 1; c <= columns; ++c) {
                if (reached[c]) continue;
                const double reduced = cost[here - 1][c - 1] - row_potential[here] - column_potential[c];
                if (reduced < slack[c]) {
                    slack[c] = reduced;
                    before[c] = column;
                }
                if (slack[c] < step) {
                    step = slack[c];
                    next = c;
                }
            }
            for (std::size_t c = 0; c <= columns; ++c) {
                if (reached[c]) {
                    row_potential[row_of[c]] += step;
                    column_potential[c] -= step;
                } else {
                    slack[c] -= step;
                }
            }
            column = next;
        } while (row_of[column] != 0);
        while (column != 0) {
            row_of[column] = row_of[before[column]];
            column = before[column];
        }
    }
    std::vector<int> column_of(rows, -1);
    for (std::size_t c = 1; c <= columns; ++c) {
        if (row_of[c] != 0) column_of[row_of[c] - 1] = static_cast<int>(c) - 1;
    }
    return column_of;
}

/// Numbers the distinct values 0, 1, 2 … in ascending order.
std::map<int, std::size_t> numbered(std::vector<int> values) {
    std::sort(values.begin(), values.end());
    std::map<int, std::size_t> numbers;
    for (const int value : values) numbers.emplace(value, numbers.size());
    return numbers;
}

/// Best selection within one connected part, given as positions in `pairs`.
void assignPart(const std::vector<WeightedPair>& pairs, const std::vector<int>& part, std::vector<int>& chosen) {
    const auto pairAt = [&](int position) -> const WeightedPair& { return pairs[static_cast<std::size_t>(position)]; };
    if (part.size() == 1) {
        chosen.push_back(part.front());
        return;
    }
    std::vector<int> rows;
    std::vector<int> columns;
    for (const int position : part) {
        rows.push_back(pairAt(position).row);
        columns.push_back(pairAt(position).column);
    }
    const auto row_number = numbered(rows);
    const auto column_number = numbered(columns);
    // A row may stay alone: it takes one of the worthless columns at the end.
    Matrix cost(row_number.size(), std::vector<double>(column_number.size() + row_number.size(), 0));
    for (const int position : part) {
        const WeightedPair& pair = pairAt(position);
        cost[row_number.at(pair.row)][column_number.at(pair.column)] = -pair.weight;
    }
    const std::vector<int> column_of = cheapestColumns(cost);
    for (const int position : part) {
        const WeightedPair& pair = pairAt(position);
        const std::size_t row = row_number.at(pair.row);
        if (column_of[row] == static_cast<int>(column_number.at(pair.column))) chosen.push_back(position);
    }
}

}  // namespace

std::vector<int> bestAssignment(const std::vector<WeightedPair>& pairs) {
    // Connected parts by union-find over the pairs: those with a common row or column belong together.
    std::vector<int> parent(pairs.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto rootOf = [&parent](int node) {
        while (parent[static_cast<std::size_t>(node)] != node) node = parent[static_cast<std::size_t>(node)];
        return node;
    };
    std::map<int, int> first_of_row;
    std::map<int, int> first_of_column;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const int position = static_cast<int>(i);
        for (const int other : {first_of_row.emplace(pairs[i].row, position).first->second,
                                first_of_column.emplace(pairs[i].column, position).first->second}) {
            const int a = rootOf(other);
            const int b = rootOf(position);
            parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
        }
    }
    std::map<int, std::vector<int>> parts;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        parts[rootOf(static_cast<int>(i))].push_back(static_cast<int>(i));
    }
    std::vector<int> chosen;
    for (const auto& [root, part] : parts) assignPart(pairs, part, chosen);
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

}  // namespace eyrie
