#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace eyrie {

/// Values by the cells of an endless plane, kept in tiles: whoever passes a cell passes those beside it, which are
/// looked up and made together.
template <class Value>
class CellTiles {
 public:
    static constexpr int kBits = 3;  ///< a tile is 8 cells wide and high
    using Tile = std::array<Value, std::size_t{1} << 2 * kBits>;

    /// The value of a cell; a new one where there was none.
    Value& at(std::int32_t column, std::int32_t row) { return tiles_[keyOf(column, row)][placeOf(column, row)]; }
    /// Null where no cell of the tile has a value; cells beside one that has are there, too, as new ones.
    const Value* find(std::int32_t column, std::int32_t row) const {
        const auto tile = tiles_.find(keyOf(column, row));
        return tile == tiles_.end() ? nullptr : &tile->second[placeOf(column, row)];
    }
    /// By keys that mean the same in any other plane of cells.
    const std::unordered_map<std::uint64_t, Tile>& tiles() const { return tiles_; }
    Tile& tile(std::uint64_t key) { return tiles_[key]; }

 private:
    static std::uint64_t keyOf(std::int32_t column, std::int32_t row) {
        return std::uint64_t{static_cast<std::uint32_t>(column >> kBits)} << 32 |
               static_cast<std::uint32_t>(row >> kBits);
    }
    static std::size_t placeOf(std::int32_t column, std::int32_t row) {
        constexpr std::int32_t kLow = (1 << kBits) - 1;
        return static_cast<std::size_t>((row & kLow) << kBits | (column & kLow));
    }

    std::unordered_map<std::uint64_t, Tile> tiles_;
};

}  // namespace eyrie
