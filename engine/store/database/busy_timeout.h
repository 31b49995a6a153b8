#pragma once

namespace eyrie {

/// How long a connection waits for another program's transaction before it gives up, ms.
inline constexpr int kBusyTimeoutMs = 5000;

}  // namespace eyrie
