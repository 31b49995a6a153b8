#include "widgets/theme_colours.h"

#include <array>

namespace eyrie::ui {
namespace {

// Neighbours in the chain lie far apart in hue or lightness, also for eyes that confuse red and green.
constexpr std::array<QRgb, kStageCount> kStageColours{
    0xff8c8c8c,  // read
    0xff0072b2,  // corners
    0xff56b4e9,  // corner tracking
    0xff009e73,  // homography
    0xffe69f00,  // independent motion
    0xff9a6fb0,  // clustering
    0xffcc79a7,  // stacking
    0xffd55e00,  // detection
    0xffb8a800,  // duplicates and outliers
    0xff3fa34d,  // tracking
    0xff6b7fd7,  // store
};

}  // namespace

QColor blend(const QColor& ground, const QColor& over, double share) {
    const auto mix = [share](int a, int b) { return static_cast<int>(a + (b - a) * share + 0.5); };
    return {mix(ground.red(), over.red()), mix(ground.green(), over.green()), mix(ground.blue(), over.blue())};
}

bool isDark(const QPalette& palette) {
    return palette.color(QPalette::Window).lightness() < palette.color(QPalette::WindowText).lightness();
}

QColor quietText(const QPalette& palette) {
    return blend(palette.color(QPalette::Window), palette.color(QPalette::WindowText), 0.7);
}

QColor faultText(const QPalette& palette) {
    return isDark(palette) ? QColor(255, 128, 128) : QColor(176, 0, 32);
}

QColor signalColour(Signal signal) {
    switch (signal) {
        case Signal::good:
            return {0, 158, 115};
        case Signal::warning:
            return {230, 159, 0};
        case Signal::bad:
            break;
    }
    return {213, 45, 45};
}

QColor stageColour(Stage stage, const QPalette& palette) {
    const QColor colour = QColor::fromRgb(kStageColours[static_cast<std::size_t>(stage)]);
    return isDark(palette) ? colour.lighter(118) : colour;
}

}  // namespace eyrie::ui
