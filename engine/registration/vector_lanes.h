#pragma once

#include <cstddef>

namespace eyrie {

/// Floats that are summed beside each other: as many as AVX2 has room for, on machines with wider vectors, too, so that
/// sums are rounded alike on all that have AVX2. What a chain finds depends on its last bits.
inline constexpr std::size_t kVectorLanes = 8;

}  // namespace eyrie
