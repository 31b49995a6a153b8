#include "window/theme.h"

#include <QApplication>
#include <QDBusConnection>
#include <QDBusMessage>
#include <QDBusPendingCallWatcher>
#include <QDBusPendingReply>
#include <QDBusVariant>
#include <QIcon>
#include <QPalette>
#include <QProxyStyle>
#include <QStyle>
#include <QStyleFactory>
#include <QToolTip>

namespace eyrie::ui {

namespace {

const QString kPortalService = QStringLiteral("org.freedesktop.portal.Desktop");
const QString kPortalPath = QStringLiteral("/org/freedesktop/portal/desktop");
const QString kPortalSettings = QStringLiteral("org.freedesktop.portal.Settings");
const QString kAppearance = QStringLiteral("org.freedesktop.appearance");
const QString kColourScheme = QStringLiteral("color-scheme");
constexpr uint kPreferDark = 1;

QPalette lightPalette() {
    QPalette palette(QColor(239, 240, 241));
    const QColor text(35, 38, 41);
    palette.setColor(QPalette::Window, QColor(239, 240, 241));
    palette.setColor(QPalette::WindowText, text);
    palette.setColor(QPalette::Base, QColor(252, 252, 252));
    palette.setColor(QPalette::AlternateBase, QColor(244, 245, 246));
    palette.setColor(QPalette::Text, text);
    palette.setColor(QPalette::Button, QColor(239, 240, 241));
    palette.setColor(QPalette::ButtonText, text);
    palette.setColor(QPalette::ToolTipBase, QColor(247, 247, 247));
    palette.setColor(QPalette::ToolTipText, text);
    palette.setColor(QPalette::PlaceholderText, QColor(100, 106, 112));
    palette.setColor(QPalette::Highlight, QColor(30, 120, 190));
    palette.setColor(QPalette::HighlightedText, Qt::white);
    palette.setColor(QPalette::Link, QColor(20, 100, 170));
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::PlaceholderText})
        palette.setColor(QPalette::Disabled, role, QColor(150, 155, 160));
    return palette;
}

QPalette darkPalette() {
    QPalette palette(QColor(49, 54, 59));
    const QColor text(236, 238, 240);
    palette.setColor(QPalette::Window, QColor(49, 54, 59));
    palette.setColor(QPalette::WindowText, text);
    palette.setColor(QPalette::Base, QColor(29, 32, 35));
    palette.setColor(QPalette::AlternateBase, QColor(36, 40, 43));
    palette.setColor(QPalette::Text, text);
    palette.setColor(QPalette::Button, QColor(62, 68, 75));
    palette.setColor(QPalette::ButtonText, text);
    palette.setColor(QPalette::BrightText, Qt::white);
    palette.setColor(QPalette::ToolTipBase, QColor(54, 60, 66));
    palette.setColor(QPalette::ToolTipText, text);
    palette.setColor(QPalette::PlaceholderText, QColor(160, 168, 176));
    palette.setColor(QPalette::Light, QColor(72, 80, 88));
    palette.setColor(QPalette::Midlight, QColor(62, 68, 75));
    palette.setColor(QPalette::Mid, QColor(84, 92, 100));
    palette.setColor(QPalette::Dark, QColor(28, 31, 34));
    palette.setColor(QPalette::Shadow, QColor(18, 20, 22));
    palette.setColor(QPalette::Highlight, QColor(61, 150, 220));
    palette.setColor(QPalette::HighlightedText, QColor(16, 18, 20));
    palette.setColor(QPalette::Link, QColor(100, 180, 240));
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::PlaceholderText})
        palette.setColor(QPalette::Disabled, role, QColor(120, 127, 134));
    return palette;
}

/// Tabs of docks stand close enough to each other that all of a workspace are seen.
class CloseTabs : public QProxyStyle {
 public:
    using QProxyStyle::QProxyStyle;
    int pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const override {
        return metric == PM_TabBarTabHSpace ? kTabSpace_px : QProxyStyle::pixelMetric(metric, option, widget);
    }

 private:
    static constexpr int kTabSpace_px = 12;
};

}  // namespace

Theme::Theme(QApplication& application, QObject* parent) : QObject(parent), application_(application) {
    if (QStyle* fusion = QStyleFactory::create(QStringLiteral("Fusion"))) QApplication::setStyle(new CloseTabs(fusion));
    QIcon::setThemeSearchPaths(QIcon::themeSearchPaths() << QStringLiteral("/usr/share/icons"));
    QIcon::setFallbackThemeName(QStringLiteral("breeze"));
    apply();
    askDesktop();
}

void Theme::askDesktop() {
    QDBusConnection bus = QDBusConnection::sessionBus();
    if (!bus.isConnected()) return;
    bus.connect(kPortalService, kPortalPath, kPortalSettings, QStringLiteral("SettingChanged"), this,
                SLOT(settingChanged(QString, QString, QDBusVariant)));
    QDBusMessage question =
        QDBusMessage::createMethodCall(kPortalService, kPortalPath, kPortalSettings, QStringLiteral("Read"));
    question << kAppearance << kColourScheme;
    auto* answer = new QDBusPendingCallWatcher(bus.asyncCall(question), this);
    connect(answer, &QDBusPendingCallWatcher::finished, this, [this](QDBusPendingCallWatcher* watcher) {
        const QDBusPendingReply<QDBusVariant> reply = *watcher;
        watcher->deleteLater();
        if (!reply.isValid()) return;
        // The portal wraps the number once more.
        QVariant value = reply.value().variant();
        if (value.canConvert<QDBusVariant>()) value = value.value<QDBusVariant>().variant();
        desktopAnswered(value.toUInt());
    });
}

void Theme::settingChanged(const QString& group, const QString& key, const QDBusVariant& value) {
    if (group == kAppearance && key == kColourScheme) desktopAnswered(value.variant().toUInt());
}

void Theme::desktopAnswered(uint colour_scheme) {
    desktop_dark_ = colour_scheme == kPreferDark;
    apply();
}

void Theme::choose(ThemeChoice choice) {
    choice_ = choice;
    apply();
}

void Theme::apply() {
    const bool dark = choice_ == ThemeChoice::dark || (choice_ == ThemeChoice::system && desktop_dark_);
    if (applied_ && dark == dark_) return;
    applied_ = true;
    dark_ = dark;
    QIcon::setThemeName(dark ? QStringLiteral("breeze-dark") : QStringLiteral("breeze"));
    const QPalette palette = dark ? darkPalette() : lightPalette();
    application_.setPalette(palette);
    QToolTip::setPalette(palette);
}

}  // namespace eyrie::ui

#include "moc_theme.cpp"
