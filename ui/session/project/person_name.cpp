#include "session/project/person_name.h"

#include <QCoreApplication>
#include <QSettings>

namespace eyrie::ui {

namespace {

constexpr auto kNameSetting = "person/name";

QString accountName() {
    for (const char* variable : {"USER", "LOGNAME", "USERNAME"}) {
        const QString name = qEnvironmentVariable(variable);
        if (!name.isEmpty()) return name;
    }
    return QCoreApplication::translate("Person", "somebody");
}

}  // namespace

QString personName() {
    const QString given = QSettings().value(QLatin1String(kNameSetting)).toString();
    return given.isEmpty() ? accountName() : given;
}

void setPersonName(const QString& name) {
    const QString given = name.simplified().left(kLongestPersonName).trimmed();
    QSettings settings;
    if (given.isEmpty() || given == accountName())
        settings.remove(QLatin1String(kNameSetting));
    else
        settings.setValue(QLatin1String(kNameSetting), given);
}

}  // namespace eyrie::ui
