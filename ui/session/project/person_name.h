#pragma once

#include <QString>

namespace eyrie::ui {

/// Who works at this window, as it is kept with what she judges and checks: the name that was given with
/// setPersonName(), otherwise that of her account on this machine, otherwise "somebody".
QString personName();

/// Gives the name, in the settings of the program: without blanks at its ends, and at most kLongestPersonName
/// characters of it. Empty, or the name of the account: the latter from now on, whatever it becomes.
void setPersonName(const QString& name);
inline constexpr int kLongestPersonName = 100;

}  // namespace eyrie::ui
