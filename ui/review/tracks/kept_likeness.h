#pragma once

#include "review/tracks/track_filter.h"

namespace eyrie::ui {

/// What counted for likeness when a person ticked it last, from the person's settings; the usual where there is nothing
/// or what another version kept.
LikenessChoice keptLikenessChoice();
void keepLikenessChoice(const LikenessChoice& counts);

}  // namespace eyrie::ui
