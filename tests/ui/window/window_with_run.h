#pragma once

#include <QTest>
#include <memory>

#include "ui/session/session_support.h"
#include "window/main_window.h"

namespace eyrie::ui::test {

/// A window over 60 frames of the scene under test and a run over them, which is made where there is none yet; null
/// where that takes too long.
inline std::unique_ptr<MainWindow> windowWithRun() {
    auto window = std::make_unique<MainWindow>();
    window->resize(1280, 720);
    window->show();
    if (!QTest::qWaitForWindowActive(window.get())) return nullptr;
    if (!openAndWait(window->session(), sceneUnderTest(60))) return nullptr;
    if (window->session().runs().empty() && !runAndWait(window->session())) return nullptr;
    return window;
}

}  // namespace eyrie::ui::test
