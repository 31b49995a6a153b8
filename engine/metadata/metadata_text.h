#pragma once

#include <string>

namespace eyrie {

/// A value of a tag as text: with as many decimals as its coding can tell apart, at most seven (a centimetre in a
/// latitude); moments as UTC.
std::string valueText(int tag, double value);
/// The unit that belongs to it as people write it, "°", "m/s"; empty where the value has none or says it itself.
std::string unitText(int tag);

}  // namespace eyrie
