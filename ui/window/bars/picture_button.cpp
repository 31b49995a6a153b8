#include "window/bars/picture_button.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QSlider>
#include <QWidgetAction>
#include <algorithm>

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
    setFocusPolicy(Qt::TabFocus);  // nothing else leads to the sliders
    buildMenu();
    onEdited(
        this, [this] { apply(); }, brightness_, contrast_);
    bindSwitches(this, {{actions_.even_picture, [this] { apply(); }}});
}

void PictureButton::buildMenu() {
    auto* menu = new QMenu(this);
    const QString names[] = {tr("Brightness"), tr("Contrast")};
    const int widest = std::max(fontMetrics().horizontalAdvance(names[0]), fontMetrics().horizontalAdvance(names[1]));
    // An entry of the menu each: Tab goes from one entry to the next, never within one.
    const auto add_slider = [&](const QString& name) {
        auto* line = new QWidget(menu);
        auto* parts = new QHBoxLayout(line);
        parts->setContentsMargins(12, 4, 12, 4);
        auto* label = new QLabel(name, line);
        label->setMinimumWidth(widest);
        QSlider* slider = pictureSlider(name, line);
        parts->addWidget(label);
        parts->addWidget(slider);
        line->setFocusPolicy(Qt::TabFocus);
        line->setFocusProxy(slider);
        auto* entry = new QWidgetAction(menu);
        entry->setDefaultWidget(line);
        menu->addAction(entry);
        return slider;
    };
    brightness_ = add_slider(names[0]);
    contrast_ = add_slider(names[1]);
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

#include "moc_picture_button.cpp"
