#pragma once

#include <QCoreApplication>
#include <QTest>
#include <memory>

#include "canvas/video_view.h"
#include "ui/support/ui_support.h"
#include "window/main_window.h"

namespace eyrie::ui::test {

inline constexpr QSize kSmallWindow{1280, 720};

/// The window, shown and active; null where it did not become so.
inline std::unique_ptr<MainWindow> shownWindow(QSize size = kSmallWindow) {
    auto made = std::make_unique<MainWindow>();
    made->resize(size);
    made->show();
    return QTest::qWaitForWindowActive(made.get()) ? std::move(made) : nullptr;
}

/// The same with a short video open.
inline std::unique_ptr<MainWindow> windowWithVideo(QSize size = kSmallWindow) {
    auto made = shownWindow(size);
    if (!made) return nullptr;
    made->session().openMedia(sceneUnderTest(5));
    return QTest::qWaitFor([&] { return made->canvas().isVisible(); }, kPatience_ms) ? std::move(made) : nullptr;
}

/// Opens a workspace by its key.
inline void openWorkspace(MainWindow& window, Qt::Key key) {
    QTest::keyClick(&window, key, Qt::ControlModifier);
    QCoreApplication::processEvents();
}

}  // namespace eyrie::ui::test
