#pragma once

#include <QToolButton>

class QSlider;

namespace eyrie::ui {

class ProjectSession;
class WindowActions;

/// The button by which pictures are made easier to look at: brightness, contrast, local contrast.
class PictureButton : public QToolButton {
    Q_OBJECT

 public:
    /// Both must outlive it.
    PictureButton(ProjectSession& session, const WindowActions& actions, QWidget* parent = nullptr);

    QSlider* brightness() const { return brightness_; }
    QSlider* contrast() const { return contrast_; }
    /// As filmed.
    void reset();

 private:
    void buildMenu();
    void apply();

    ProjectSession& session_;
    const WindowActions& actions_;
    QSlider* brightness_;
    QSlider* contrast_;
};

}  // namespace eyrie::ui
