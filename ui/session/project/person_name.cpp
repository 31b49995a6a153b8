#include "session/project/person_name.h"

#include <QCoreApplication>

namespace eyrie::ui {

QString personName() {
    for (const char* variable : {"USER", "LOGNAME", "USERNAME"}) {
        const QString name = qEnvironmentVariable(variable);
        if (!name.isEmpty()) return name;
    }
    return QCoreApplication::translate("Person", "somebody");
}

}  // namespace eyrie::ui
