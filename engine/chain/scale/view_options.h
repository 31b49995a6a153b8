#pragma once

#include "core/parameter.h"

namespace eyrie {

/// What is looked for in the view before a run begins.
struct ViewOptions {
    bool oblique = true;

    /// The thesis looks straight down.
    static ViewOptions thesis();
    void describe(ParameterVisitor& visitor);
};

}  // namespace eyrie
