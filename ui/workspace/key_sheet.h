#pragma once

#include <QDialog>

#include "workspace/window_actions.h"

namespace eyrie::ui {

/// The sheet that lists every command with its keys, and the mouse.
class KeySheet : public QDialog {
    Q_OBJECT

 public:
    KeySheet(const WindowActions& actions, QWidget* parent, const QList<ActionSection>& more = {});
};

}  // namespace eyrie::ui
