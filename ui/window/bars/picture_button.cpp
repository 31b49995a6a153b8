#include "window/bars/picture_button.h"

#include <QFormLayout>
#include <QMenu>
#include <QSlider>
#include <QWidgetAction>

#include "session/project_session.h"
#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

constexpr int kPictureSteps = 100;  ///< in either direction

QSlider* pictureSlider(const QString& name, QWidget* parent) {
    auto* slider = new QSlider(Qt::Horizontal, parent);
    slider->setRange(-kPictureSteps, kPictureSteps);
    slider->setPageStep(kPictureSteps / 5);
    slider->setMinimumWidth(160);
    slider->setAccessibleName(name);
    return slider;
}

}  // namespace

PictureButton::PictureButton(ProjectSession& session, const WindowActions& actions, QWidget* parent)
    : QToolButton(parent), session_(session), actions_(actions) {
    setText(tr("Picture"));
    setCheckable(true);
    setIcon(QIcon::fromTheme(QStringLiteral("contrast")));
    setToolTip(tr("Brightness and contrast of what is shown; results are not changed"));
    setPopupMode(QToolButton::InstantPopup);
    setFocusPolicy(Qt::NoFocus);
    buildMenu();
    onEdited(
        this, [this] { apply(); }, brightness_, contrast_);
    bindSwitches(this, {{actions_.even_picture, [this] { apply(); }}});
}

void PictureButton::buildMenu() {
    auto* menu = new QMenu(this);
    auto* form = new QWidget(menu);
    auto* layout = new QFormLayout(form);
    layout->setContentsMargins(12, 6, 12, 2);
    brightness_ = pictureSlider(tr("Brightness"), form);
    contrast_ = pictureSlider(tr("Contrast"), form);
    layout->addRow(tr("&Brightness"), brightness_);
    layout->addRow(tr("&Contrast"), contrast_);
    auto* sliders = new QWidgetAction(menu);
    sliders->setDefaultWidget(form);
    menu->addAction(sliders);
    menu->addAction(actions_.even_picture);
    menu->addSeparator();
    menu->addAction(tr("As filmed"), this, &PictureButton::reset);
    setMenu(menu);
}

void PictureButton::reset() {
    actions_.even_picture->setChecked(false);
    brightness_->setValue(0);
    contrast_->setValue(0);
}

void PictureButton::apply() {
    PictureLook look;
    look.brightness = brightness_->value() / static_cast<double>(kPictureSteps);
    look.contrast = contrast_->value() / static_cast<double>(kPictureSteps);
    look.even = actions_.even_picture->isChecked();
    session_.setPictureLook(look);
    // Whoever looks at an adjusted picture should know.
    setChecked(!look.plain());
}

}  // namespace eyrie::ui
