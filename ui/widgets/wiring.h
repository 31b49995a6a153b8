#pragma once

#include <QAbstractButton>
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QSlider>
#include <QSpinBox>
#include <algorithm>
#include <functional>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <vector>

namespace eyrie::ui {

/// What an action, a button or a box of choices does. What can be switched on may ask for whether it is; a box for
/// which of its choices.
class Command {
 public:
    template <typename Work>
    Command(QAction* action, Work work) : action_(action), work_(withState<bool>(std::move(work))) {}
    template <typename Work>
    Command(QAbstractButton* button, Work work) : button_(button), work_(withState<bool>(std::move(work))) {}
    template <typename Work>
    Command(QComboBox* box, Work work) : box_(box), choose_(withState<int>(std::move(work))) {}

 private:
    template <typename State, typename Work>
    static std::function<void(State)> withState(Work work) {
        if constexpr (std::is_invocable_v<Work, State>)
            return work;
        else
            return [work = std::move(work)](State) { work(); };
    }
    friend void bindCommands(QObject* owner, const std::vector<Command>& commands);
    friend void bindSwitches(QObject* owner, const std::vector<Command>& switches);

    QAction* action_ = nullptr;
    QAbstractButton* button_ = nullptr;
    QComboBox* box_ = nullptr;
    std::function<void(bool)> work_;
    std::function<void(int)> choose_;
};

/// A list of what each command does when a person uses it. Holds as long as `owner`.
void bindCommands(QObject* owner, const std::vector<Command>& commands);
/// The same for actions and buttons that can be on and off; follows that also where the program switches them.
void bindSwitches(QObject* owner, const std::vector<Command>& switches);

/// Lets `react`, a member of the receiver or a function, follow each of these signals, whatever they carry.
template <typename Sender, typename Receiver, typename React, typename... Signals>
void whenAny(Sender* sender, Receiver* receiver, React react, Signals... told) {
    if constexpr (std::is_invocable_v<React>)
        (QObject::connect(sender, told, receiver, [react] { react(); }), ...);
    else
        (QObject::connect(sender, told, receiver, [receiver, react] { (receiver->*react)(); }), ...);
}

/// What to do when something is another than it was, for every kind of change that one signal tells of. A list of
/// changes and what they ask for; several may ask for the same, and one for several things, which are done in this
/// order.
template <typename Change>
class Reactions {
 public:
    struct Reaction {
        Reaction(Change to, std::function<void()> work) : changes{to}, react(std::move(work)) {}
        Reaction(std::initializer_list<Change> to, std::function<void()> work) : changes(to), react(std::move(work)) {}
        std::vector<Change> changes;
        std::function<void()> react;
    };
    Reactions(std::initializer_list<Reaction> reactions) : reactions_(reactions) {}

    void operator()(Change change) const {
        for (const Reaction& reaction : reactions_)
            if (std::find(reaction.changes.begin(), reaction.changes.end(), change) != reaction.changes.end())
                reaction.react();
    }

 private:
    std::vector<Reaction> reactions_;
};

/// What the signal `changed` of a class tells.
template <class Sender, class Change>
Change changeTold(void (Sender::*)(Change));
template <class Sender>
using ChangeOf = decltype(changeTold(&Sender::changed));

/// Lets the reactions follow the changes that `sender` tells of, as long as `receiver` lives.
template <class Sender>
void whenChanged(const Sender& sender, QObject* receiver, Reactions<ChangeOf<Sender>> reactions,
                 Qt::ConnectionType when = Qt::AutoConnection) {
    QObject::connect(&sender, &Sender::changed, receiver, std::move(reactions), when);
}

/// What a field sends when its value becomes another, by a person or by the program.
inline auto editedSignal(const QComboBox*) {
    return &QComboBox::currentIndexChanged;
}
inline auto editedSignal(const QSpinBox*) {
    return &QSpinBox::valueChanged;
}
inline auto editedSignal(const QDoubleSpinBox*) {
    return &QDoubleSpinBox::valueChanged;
}
inline auto editedSignal(const QSlider*) {
    return &QSlider::valueChanged;
}
inline auto editedSignal(const QAbstractButton*) {
    return &QAbstractButton::toggled;
}
inline auto editedSignal(const QLineEdit*) {
    return &QLineEdit::textChanged;
}

/// Lets `react` follow every change in the fields of a form.
template <typename Receiver, typename React, typename... Fields>
void onEdited(Receiver* receiver, React react, Fields*... fields) {
    (whenAny(fields, receiver, react, editedSignal(fields)), ...);
}

/// Lets `react` follow when a person has finished with one of these fields: by Return, or by leaving it.
template <typename Receiver, typename React, typename... Fields>
void onFinished(Receiver* receiver, React react, Fields*... fields) {
    (whenAny(fields, receiver, react, &Fields::editingFinished), ...);
}

}  // namespace eyrie::ui
