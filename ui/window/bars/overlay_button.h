#pragma once

#include <QToolButton>

class QDoubleSpinBox;

namespace eyrie::ui {

class OverlaySettings;
class WindowActions;

/// The button with the menu of overlays, which is the legend, too: each switch has the colour of what it shows.
class OverlayButton : public QToolButton {
    Q_OBJECT

 public:
    /// Both must outlive the button.
    OverlayButton(OverlaySettings& overlays, const WindowActions& actions, QWidget* parent = nullptr);

 private:
    void buildMenu();
    void refresh();

    OverlaySettings& overlays_;
    const WindowActions& actions_;
    QDoubleSpinBox* length_;
};

}  // namespace eyrie::ui
