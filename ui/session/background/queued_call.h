#pragma once

#include <QMetaObject>
#include <QObject>
#include <utility>

namespace eyrie::ui {

/// Runs `call` on the thread of `receiver` as soon as its event loop turns. Calls to a receiver that has gone are
/// dropped.
template <class Call>
void queuedCall(QObject* receiver, Call&& call) {
    QMetaObject::invokeMethod(receiver, std::forward<Call>(call), Qt::QueuedConnection);
}

}  // namespace eyrie::ui
