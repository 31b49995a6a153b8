#pragma once

#include <QPlainTextEdit>
#include <QString>
#include <string>
#include <vector>

#include "formats/label_formats.h"

/// What the dialogs for label files share.
namespace eyrie::ui {

/// Null for no format.
inline const LabelFormatInfo* formatNamed(const QString& name) {
    for (const LabelFormatInfo& format : labelFormats())
        if (QString::fromStdString(format.name) == name) return &format;
    return nullptr;
}

/// Where a dialog tells what it found or did.
inline QPlainTextEdit* reportField() {
    auto* text = new QPlainTextEdit;
    text->setReadOnly(true);
    text->setMinimumSize(460, 150);
    return text;
}

/// Notes as a list.
inline QString lines(const std::vector<std::string>& notes) {
    QString text;
    for (const std::string& note : notes) text += QStringLiteral("• %1\n").arg(QString::fromStdString(note));
    return text;
}

}  // namespace eyrie::ui
