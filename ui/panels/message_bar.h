#pragma once

#include <QFrame>
#include <QList>
#include <functional>

class QLabel;
class QVBoxLayout;

namespace eyrie::ui {

enum class MessageKind { info, warning, error };

/// One message of a MessageBar.
class MessageStrip : public QFrame {
    Q_OBJECT
 public:
    MessageStrip(MessageKind kind, const QString& text, QWidget* parent);
    MessageKind kind() const { return kind_; }
    const QString& text() const { return text_; }
    /// Adds a button; the message goes when it is pressed.
    void setAction(const QString& text, std::function<void()> action);
    /// The same message came once more.
    void countUp();

 signals:
    void dismissed();

 protected:
    void changeEvent(QEvent* event) override;

 private:
    void applyColours();
    MessageKind kind_;
    QString text_;
    int count_ = 1;
    bool applying_ = false;
    QLabel* icon_;
    QLabel* label_;
};

/// Says what went wrong, where, and what to do, above the canvas and without blocking anything. Messages stay until
/// they are dismissed, mere notices for a while; the newest is on top; the same one twice is counted, not repeated.
class MessageBar : public QWidget {
    Q_OBJECT
 public:
    explicit MessageBar(QWidget* parent = nullptr);
    void showMessage(MessageKind kind, const QString& text, const QString& action_text = {},
                     std::function<void()> action = {});
    /// Takes away messages of one kind that no longer hold, or all.
    void dismiss(MessageKind kind);
    void dismissAll();
    /// Texts of what is shown, the newest first.
    QStringList texts() const;

 private:
    void remove(MessageStrip* strip);
    QVBoxLayout* layout_;
    QList<MessageStrip*> strips_;  ///< newest first
};

}  // namespace eyrie::ui
