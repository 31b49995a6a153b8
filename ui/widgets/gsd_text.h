#pragma once

#include <QString>
#include <optional>

namespace eyrie::ui {

/// Metres per pixel as a person types them, with point or comma and with any digits: "0.08", "0,08". An empty text is
/// 0: not known. Nothing for what is no number from kSmallestGsd to kLargestGsd (core/values/scene_scale.h).
std::optional<double> gsdFromText(const QString& text);

}  // namespace eyrie::ui
