#include "workspace/key_bindings.h"

#include <QSet>
#include <QSettings>

namespace eyrie::ui {

namespace {

QString settingOf(const QString& group, const QString& text) {
    QString name = text;
    name.remove(QLatin1Char('&')).replace(QLatin1Char('/'), QLatin1Char('-'));
    return QStringLiteral("keys/") + (group.isEmpty() ? name : group + QLatin1Char('/') + name);
}

QStringList words(const QList<QKeySequence>& keys) {
    QStringList words;
    for (const QKeySequence& key : keys) words << key.toString(QKeySequence::PortableText);
    return words;
}

QList<QKeySequence> keysFrom(const QStringList& words) {
    QList<QKeySequence> keys;
    for (const QString& word : words)
        if (const QKeySequence key(word, QKeySequence::PortableText); !key.isEmpty()) keys << key;
    return keys;
}

void showTip(QAction& action) {
    action.setToolTip(withKey(action.whatsThis(), action));
}

}  // namespace

QString withKey(const QString& hint, const QAction& action) {
    const QKeySequence key = action.shortcut();
    return key.isEmpty() ? hint : QStringLiteral("%1 (%2)").arg(hint, key.toString(QKeySequence::NativeText));
}

void setTip(QAction& action, const QString& tip) {
    action.setWhatsThis(tip);
    showTip(action);
}

void setKeys(QAction& action, const QList<QKeySequence>& keys) {
    action.setShortcuts(keys);
    showTip(action);
}

void KeyBindings::add(const Group& group) {
    groups_.append(group);
    const QSettings settings;
    QSet<QKeySequence> chosen;
    QList<QAction*> as_made;
    for (const ActionSection& section : group.sections)
        for (QAction* action : section.actions) {
            Command& command = commands_[action];
            command.setting = settingOf(group.title, action->text());
            command.defaults = command.keys = action->shortcuts();
            if (!settings.contains(command.setting)) {
                as_made << action;
                continue;
            }
            command.keys = keysFrom(settings.value(command.setting).toStringList());
            for (const QKeySequence& key : command.keys) chosen.insert(key);
            setKeys(*action, command.keys);
        }
    // A later version may have given another command the key that a person chose.
    for (QAction* action : as_made) {
        QList<QKeySequence>& keys = commands_[action].keys;
        if (keys.removeIf([&](const QKeySequence& key) { return chosen.contains(key); }) > 0) setKeys(*action, keys);
    }
}

QAction* KeyBindings::owner(const QKeySequence& key, const QAction* but) const {
    for (const Group& group : groups_) {
        QAction* found = nullptr;
        bool same_group = false;
        for (const ActionSection& section : group.sections)
            for (QAction* action : section.actions) {
                if (action == but)
                    same_group = true;
                else if (keysOf(action).contains(key))
                    found = action;
            }
        if (same_group) return found;
    }
    return nullptr;
}

void KeyBindings::setKeysOf(QAction* action, const QList<QKeySequence>& keys) {
    Command& command = commands_[action];
    if (command.keys == keys) return;
    command.keys = keys;
    setKeys(*action, keys);
    QSettings settings;
    if (keys == command.defaults)
        settings.remove(command.setting);
    else
        settings.setValue(command.setting, words(keys));
    emit keysChanged();
}

void KeyBindings::resetAll() {
    for (const Group& group : groups_)
        for (const ActionSection& section : group.sections)
            for (QAction* action : section.actions) reset(action);
}

}  // namespace eyrie::ui

#include "moc_key_bindings.cpp"
