#pragma once

#include <QAction>
#include <QHash>
#include <QKeySequence>
#include <QList>
#include <QObject>

namespace eyrie::ui {

/// Commands that belong together, for menus and the sheet of keys.
struct ActionSection {
    QString title;  ///< of the menu: the letter after & is the one that opens it with Alt
    QList<QAction*> actions;
};

/// A hint with the first key of the command that does the same, if it has any: "Checked (V)".
QString withKey(const QString& hint, const QAction& action);
/// What a command does, in words. Its tooltip is that with its first key.
void setTip(QAction& action, const QString& tip);
/// The keys that work now, with the tooltip.
void setKeys(QAction& action, const QList<QKeySequence>& keys);

/// The keys of all commands as a person wants them: those that the commands were made with, or others, which are kept
/// in the program's settings.
class KeyBindings : public QObject {
    Q_OBJECT

 public:
    /// Commands that are there at the same time, so that no two may have one key.
    struct Group {
        QString title;  ///< empty: the window's own
        QList<ActionSection> sections;
    };

    using QObject::QObject;

    /// The keys that the commands have now are their defaults. Sets those that were chosen before; what is the default
    /// of another command of the group stays with the one it was chosen for.
    void add(const Group& group);
    const QList<Group>& groups() const { return groups_; }

    QList<QKeySequence> keysOf(const QAction* action) const { return commands_[action].keys; }
    bool changed(const QAction* action) const { return keysOf(action) != commands_[action].defaults; }
    /// The other command of the same group that has this key; null: it is free.
    QAction* owner(const QKeySequence& key, const QAction* but) const;
    void setKeysOf(QAction* action, const QList<QKeySequence>& keys);
    void reset(QAction* action) { setKeysOf(action, commands_[action].defaults); }
    void resetAll();

 signals:
    /// A command has other keys: whoever lends keys for a while has to do so anew.
    void keysChanged();

 private:
    struct Command {
        QString setting;
        QList<QKeySequence> defaults;
        QList<QKeySequence> keys;
    };
    QList<Group> groups_;
    QHash<const QAction*, Command> commands_;
};

}  // namespace eyrie::ui
