#pragma once

#include <QString>
#include <optional>

namespace eyrie::ui {

/// A number as a person types it, with point or comma and with any digits: "0.08", "0,08". Nothing for what is none.
std::optional<double> numberFromText(const QString& text);

/// The same as metres per pixel. An empty text is 0: not known. Nothing for what is no ground sampling distance, see
/// whyNotAGsd() (core/values/scene_scale.h).
std::optional<double> gsdFromText(const QString& text);

/// Why a text is no ground sampling distance, and the remedy, where gsdFromText() has none of it.
QString gsdFaultText(const QString& text);

/// What an empty field for it says.
QString unknownGsdText();

}  // namespace eyrie::ui
