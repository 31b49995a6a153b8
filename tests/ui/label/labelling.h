#pragma once

#include <QSignalSpy>
#include <QTest>
#include <functional>
#include <memory>

#include "canvas/video_view.h"
#include "label/canvas/label_tool.h"
#include "label/label_actions.h"
#include "label/label_workspace.h"
#include "ui/support/ui_support.h"
#include "window/main_window.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::test {

/// Windows that label a small scene, and the hand that works in them. One user's home a test.
class Labelling {
 protected:
    void begin() { home_ = std::make_unique<OwnHome>(); }
    void end() { home_.reset(); }
    const OwnHome& home() const { return *home_; }

    static bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, kPatience_ms); }

    /// A window that labels a folder of images; without a run unless one is asked for.
    std::unique_ptr<MainWindow> labellingWindow(int frames, bool with_run = false) {
        const auto folder = home() / "images";
        if (!std::filesystem::exists(folder)) writeScene(folder, frames);
        auto window = std::make_unique<MainWindow>();
        window->show();
        if (with_run) {
            window->session().settings().options.view.oblique = false;
            QSignalSpy finished(&window->session(), &ProjectSession::runFinished);
            StartOptions options;
            options.input = folder;
            options.gsd_m_per_px = 0.25;
            window->start(options);
            if (!finished.wait(kPatience_ms)) return nullptr;
        } else {
            QSignalSpy ready(&window->session(), &ProjectSession::ready);
            window->session().settings().gsd_m_per_px = 0.25;
            window->session().open(folder);
            if (!ready.wait(kPatience_ms)) return nullptr;
            window->session().settings().gsd_m_per_px = 0.25;
        }
        window->actions().workspaceAction(WorkspaceKind::label)->trigger();
        if (!waitFor([&] { return window->labelling().labels().isOpen(); })) return nullptr;
        go(*window, 0);
        return window;
    }
    /// A large window that labels a clip after a run over it; null when that takes too long.
    static std::unique_ptr<MainWindow> clipWindow(const StartOptions& options) {
        auto window = std::make_unique<MainWindow>();
        window->resize(1600, 1000);
        window->show();
        QSignalSpy finished(&window->session(), &ProjectSession::runFinished);
        window->start(options);
        if (!finished.wait(10 * kPatience_ms)) return nullptr;
        window->actions().workspaceAction(WorkspaceKind::label)->trigger();
        const LabelSession& labels = window->labelling().labels();
        if (!waitFor([&] { return labels.isOpen() && !labels.camera().empty(); })) return nullptr;
        return window;
    }
    static void go(MainWindow& window, FrameIndex frame) {
        window.session().goToFrame(frame);
        waitFor([&] { return window.canvas().frame().index == frame && !window.canvas().frame().image.isNull(); });
    }
    static void key(MainWindow& window, Qt::Key key, Qt::KeyboardModifiers keys = {}) {
        window.canvas().setFocus();
        QTest::keyClick(&window.canvas(), key, keys);
    }
    static QPoint at(MainWindow& window, double x, double y) {
        return window.canvas().transform().viewFromImage({x, y}).toPoint();
    }
    static void click(MainWindow& window, double x, double y, Qt::KeyboardModifiers keys = {}) {
        QTest::mouseClick(&window.canvas(), Qt::LeftButton, keys, at(window, x, y));
    }
    /// Draws an object by two clicks and answers its id.
    static ObjectId draw(MainWindow& window, QPointF rear, QPointF front) {
        key(window, Qt::Key_B);
        click(window, rear.x(), rear.y());
        click(window, front.x(), front.y());
        return window.labelling().labels().selected().value_or(0);
    }
    static const LabelledObject& object(MainWindow& window, ObjectId id) {
        return window.labelling().labels().annotations().objects.at(id);
    }

 private:
    std::unique_ptr<OwnHome> home_;
};

}  // namespace eyrie::ui::test
