#pragma once

#include <QString>

#include "core/geometry/oriented_box.h"

namespace eyrie::ui {

/// What the evaluation says about a box, in the order of the legend.
enum class VerdictKind {
    found,        ///< true positive: the result's box
    missed,       ///< false negative: the object's box
    false_alarm,  ///< false positive: the result's box
    switched,     ///< found, under another id than before
    fragment,     ///< missed from here on after it was followed
    ignored       ///< counts neither way
};
inline constexpr int kVerdictKinds = 6;

/// A box with its verdict.
struct VerdictMark {
    VerdictKind kind = VerdictKind::found;
    OrientedBox box;
    QString text;           ///< beside the box, may be empty
    bool selected = false;  ///< the error that is looked at
};

}  // namespace eyrie::ui
