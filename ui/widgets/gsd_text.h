#pragma once

#include <QString>
#include <optional>

namespace eyrie::ui {

/// The smallest and the largest ground sampling distance that are taken for one, metres per pixel.
inline constexpr double kSmallestGsd = 0.001;
inline constexpr double kLargestGsd = 100;

/// Metres per pixel as a person types them, with point or comma and with any digits: "0.08", "0,08". An empty text is
/// 0: not known. Nothing for what is no number from kSmallestGsd to kLargestGsd.
std::optional<double> gsdFromText(const QString& text);

}  // namespace eyrie::ui
