#pragma once

#include <optional>

namespace eyrie {

/// A value before and after; empty before: it is added; empty after: it is removed.
template <class Value>
struct Change {
    std::optional<Value> before;
    std::optional<Value> after;
};

}  // namespace eyrie
