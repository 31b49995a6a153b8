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
    /// What the message is about; empty: nothing that a later message could be about, too.
    const QString& topic() const { return topic_; }
    void setTopic(const QString& topic) { topic_ = topic; }
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
    QString topic_;
    int count_ = 1;
    bool applying_ = false;
    QLabel* icon_;
    QLabel* label_;
};

/// Says what went wrong, where, and what to do, over the top of the canvas and without blocking anything. Messages stay
/// until they are dismissed, mere notices for a while; the newest is on top; the same one twice is counted, not
/// repeated.
class MessageBar : public QWidget {
    Q_OBJECT
 public:
    explicit MessageBar(QWidget* parent = nullptr);
    void showMessage(MessageKind kind, const QString& text, const QString& action_text = {},
                     std::function<void()> action = {});
    /// The same about a topic, of which one message at most is shown: this one takes the place of the former.
    void showTopic(const QString& topic, MessageKind kind, const QString& text, const QString& action_text = {},
                   std::function<void()> action = {});
    /// What was said about the topic no longer holds.
    void dismissTopic(const QString& topic);
    /// Whether a message about the topic is shown.
    bool shows(const QString& topic) const;
    /// Takes away messages of one kind that no longer hold, or all.
    void dismiss(MessageKind kind);
    void dismissAll();
    /// Texts of what is shown, the newest first.
    QStringList texts() const;

 private:
    MessageStrip* add(MessageKind kind, const QString& text, const QString& action_text, std::function<void()> action);
    void remove(MessageStrip* strip);
    QVBoxLayout* layout_;
    QList<MessageStrip*> strips_;  ///< newest first
};

}  // namespace eyrie::ui
