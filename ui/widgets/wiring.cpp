#include "widgets/wiring.h"

namespace eyrie::ui {

void bindCommands(QObject* owner, const std::vector<Command>& commands) {
    for (const Command& command : commands) {
        if (command.action_ != nullptr)
            QObject::connect(command.action_, &QAction::triggered, owner, command.work_);
        else if (command.box_ != nullptr)
            QObject::connect(command.box_, &QComboBox::activated, owner, command.choose_);
        else
            QObject::connect(command.button_, &QAbstractButton::clicked, owner, command.work_);
    }
}

void bindSwitches(QObject* owner, const std::vector<Command>& switches) {
    for (const Command& command : switches) {
        if (command.action_ != nullptr)
            QObject::connect(command.action_, &QAction::toggled, owner, command.work_);
        else
            QObject::connect(command.button_, &QAbstractButton::toggled, owner, command.work_);
    }
}

}  // namespace eyrie::ui
