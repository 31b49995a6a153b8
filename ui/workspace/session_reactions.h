#pragma once

#include "session/project_session.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

/// What an object does when something of the session is another than it was; holds as long as `receiver`.
inline void followSession(ProjectSession& session, QObject* receiver, Reactions<SessionChange> reactions) {
    QObject::connect(&session, &ProjectSession::changed, receiver, std::move(reactions));
}

}  // namespace eyrie::ui
