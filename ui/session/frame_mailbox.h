#pragma once

#include "session/mailbox.h"
#include "view/view_frame.h"

namespace eyrie::ui {

/// Carries frames of a running run to the eye.
using FrameMailbox = Mailbox<ViewFrame>;

}  // namespace eyrie::ui
