#include "session/project_location.h"

#include <QCryptographicHash>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QString>

namespace eyrie::ui {

namespace fs = std::filesystem;

fs::path defaultProjectPath(const std::string& media_name, const std::string& media_identity) {
    const fs::path data = QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation).toStdString();
    const QByteArray hash =
        QCryptographicHash::hash(QByteArray::fromStdString(media_identity), QCryptographicHash::Sha256).toHex().left(8);
    QString name = QString::fromStdString(fs::path(media_name).stem().string());
    // Nothing in the name may upset a file system or a shell.
    name.replace(QRegularExpression(QStringLiteral("[^\\w.-]+"), QRegularExpression::UseUnicodePropertiesOption),
                 QStringLiteral("_"));
    name = name.left(60);
    if (name.isEmpty()) name = QStringLiteral("video");
    return data / "eyrie" / "projects" / (name.toStdString() + "-" + hash.toStdString() + ".eyrie");
}

}  // namespace eyrie::ui
