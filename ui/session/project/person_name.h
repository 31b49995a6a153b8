#pragma once

#include <QString>

namespace eyrie::ui {

/// Who works at this window: the user's name on this machine, as it is kept with what she judges and checks.
QString personName();

}  // namespace eyrie::ui
