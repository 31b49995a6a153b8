#pragma once

#include <QDBusVariant>
#include <QObject>

class QApplication;

namespace eyrie::ui {

enum class ThemeChoice { system, light, dark };

/// Gives the program its style, palette and icons, and follows the desktop's light or dark setting while it changes.
class Theme : public QObject {
    Q_OBJECT

 public:
    /// Asks the desktop (the portal's appearance setting) without waiting; starts light.
    explicit Theme(QApplication& application, QObject* parent = nullptr);

    void choose(ThemeChoice choice);
    ThemeChoice choice() const { return choice_; }
    bool dark() const { return dark_; }

 private slots:
    void settingChanged(const QString& group, const QString& key, const QDBusVariant& value);

 private:
    void askDesktop();
    void desktopAnswered(uint colour_scheme);
    void apply();

    QApplication& application_;
    ThemeChoice choice_ = ThemeChoice::system;
    bool desktop_dark_ = false;
    bool dark_ = false;
    bool applied_ = false;
};

}  // namespace eyrie::ui
