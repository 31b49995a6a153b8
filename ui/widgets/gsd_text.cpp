#include "widgets/gsd_text.h"

#include <QLocale>
#include <QObject>
#include <cmath>

#include "core/values/scene_scale.h"

namespace eyrie::ui {

std::optional<double> numberFromText(const QString& text) {
    QString plain;
    for (const QChar c : text.trimmed()) {
        if (c.isDigit())
            plain += QString::number(c.digitValue());
        else
            // Nobody groups the thousands of such a number: a comma is a decimal one, also the Arabic.
            plain += c == QLatin1Char(',') || c == QChar(0x066B) ? QLatin1Char('.') : c;
    }
    bool understood = false;
    const double value = QLocale::c().toDouble(plain, &understood);
    if (!understood || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::optional<double> gsdFromText(const QString& text) {
    if (text.trimmed().isEmpty()) return 0;
    const auto value = numberFromText(text);
    if (!value || !whyNotAGsd(*value).empty()) return std::nullopt;
    return value;
}

QString gsdFaultText(const QString& text) {
    return QObject::tr("GSD “%1”: %2. Leave the field empty if it is not known.")
        .arg(text.trimmed(), QString::fromStdString(whyNotAGsd(numberFromText(text).value_or(0))));
}

QString unknownGsdText() {
    return QObject::tr("unknown: speeds in px/frame");
}

}  // namespace eyrie::ui
