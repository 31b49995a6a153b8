#pragma once

#include "canvas/view_frame.h"
#include "session/background/mailbox.h"

namespace eyrie::ui {

/// Carries frames of a running run to the eye.
using FrameMailbox = Mailbox<ViewFrame>;

}  // namespace eyrie::ui
