#include <QAbstractItemView>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QFocusEvent>
#include <QLineEdit>
#include <QMap>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QSet>
#include <QSettings>
#include <QSlider>
#include <QTest>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <cmath>

#include "canvas/layers/stages/cluster_layer.h"
#include "canvas/layers/stages/corner_layer.h"
#include "canvas/layers/stages/detection_layer.h"
#include "canvas/layers/track_layer.h"
#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "label/label_actions.h"
#include "label/label_workspace.h"
#include "label/lists/object_inspector.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "ui/window/shown_window.h"
#include "window/main_window.h"
#include "workspace/key_sheet.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::window_keys_test {

using test::kPatience_ms;
using test::openWorkspace;
using test::shownWindow;
using test::windowWithVideo;

/// The keys of all workspaces: each means one thing, and can be changed and searched.
class WindowKeysTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void gGoesToAFrameEverywhere() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        for (const Qt::Key key : {Qt::Key_1, Qt::Key_2, Qt::Key_3}) {
            openWorkspace(*window, key);
            QVERIFY(window->actions().go_to_frame->shortcuts().contains(QKeySequence(Qt::Key_G)));
            window->canvas().setFocus();
            QTest::keyClick(window.get(), Qt::Key_G);
            QVERIFY(!window->canvas().hasFocus());
        }
    }

    void aKeyCanBeChangedAndStaysSo() {
        {
            const auto window = shownWindow();
            QVERIFY(window);
            KeySheet sheet(window->keys(), {}, window.get());
            QAction* corners = window->actions().overlay.at(CornerLayer::kKind);
            sheet.choose(corners);
            sheet.setKey(QKeySequence(QStringLiteral("Alt+T")));
            QVERIFY2(sheet.answer().contains(QStringLiteral("Tracks")), qPrintable(sheet.answer()));
            QCOMPARE(corners->shortcut(), QKeySequence(QStringLiteral("Alt+C")));
            sheet.setKey(QKeySequence(Qt::Key_7));
            QCOMPARE(corners->shortcut(), QKeySequence(Qt::Key_7));
            QVERIFY(corners->toolTip().endsWith(QStringLiteral("(7)")));
            QTest::keyClick(window.get(), Qt::Key_7);
            QVERIFY(window->overlays().isVisible(CornerLayer::kKind));
        }
        const auto next = shownWindow();
        QVERIFY(next);
        QAction* corners = next->actions().overlay.at(CornerLayer::kKind);
        QCOMPARE(corners->shortcut(), QKeySequence(Qt::Key_7));
        next->keys().resetAll();
        QCOMPARE(corners->shortcut(), QKeySequence(QStringLiteral("Alt+C")));
    }

    /// A person may give a command of the window a key that labelling has: there it is labelling's.
    void aKeyThatLabellingTakesComesBack() {
        const auto window = shownWindow();
        QVERIFY(window);
        QAction* detections = window->actions().overlay.at(DetectionLayer::kKind);
        window->keys().setKeysOf(detections, {QKeySequence(Qt::Key_D)});
        openWorkspace(*window, Qt::Key_2);
        QVERIFY(detections->shortcuts().isEmpty());  // D is the next frame here
        window->keys().setKeysOf(window->labelling().actions().next_frame, {QKeySequence(Qt::Key_F4)});
        QCOMPARE(detections->shortcut(), QKeySequence(Qt::Key_D));
        window->keys().setKeysOf(detections, {QKeySequence(Qt::Key_F4)});
        QVERIFY(detections->shortcuts().isEmpty());
        openWorkspace(*window, Qt::Key_1);
        QCOMPARE(detections->shortcut(), QKeySequence(Qt::Key_F4));
    }

    void aKeyThatAPersonChoseIsNoOtherCommandsDefault() {
        QSettings().setValue(QStringLiteral("keys/Motion clusters"), QStringList{QStringLiteral("Alt+C")});
        const auto window = shownWindow();
        QVERIFY(window);
        QVERIFY(window->actions().overlay.at(CornerLayer::kKind)->shortcuts().isEmpty());
        QTest::keyClick(window.get(), Qt::Key_C, Qt::AltModifier);
        QVERIFY(window->overlays().isVisible(ClusterLayer::kKind));
        window->keys().resetAll();
        QTest::keyClick(window.get(), Qt::Key_C, Qt::AltModifier);
        QVERIFY(window->overlays().isVisible(CornerLayer::kKind));
    }

    void noKeyMeansTwoThings() {
        // On the canvas arrows move what is selected: a box by pixels, the event of the queue, and where nothing is,
        // the frame. Escape leaves what was begun and clears the selection. Backspace rejects what is selected.
        const QStringList alike{QStringLiteral("Left"),        QStringLiteral("Right"),    QStringLiteral("Shift+Left"),
                                QStringLiteral("Shift+Right"), QStringLiteral("Ctrl+Up"),  QStringLiteral("Ctrl+Down"),
                                QStringLiteral("Esc"),         QStringLiteral("Backspace")};
        const auto window = shownWindow();
        QVERIFY(window);
        const auto plain = [](const QAction* action) { return action->text().remove(QLatin1Char('&')); };
        QMap<QString, QString> meanings;
        QStringList twice;
        for (const KeyBindings::Group& group : window->keys().groups())
            for (const ActionSection& section : group.sections)
                for (const QAction* action : section.actions)
                    for (const QKeySequence& key : window->keys().keysOf(action)) {
                        const QString name = key.toString(QKeySequence::PortableText);
                        const QString before = meanings.value(name, plain(action));
                        meanings[name] = plain(action);
                        if (before != plain(action)) twice << name;
                    }
        for (const QString& name : twice)
            QVERIFY2(alike.contains(name), qPrintable(name + QLatin1Char(' ') + meanings[name]));
        for (const QString& name : alike) QVERIFY2(twice.contains(name), qPrintable(name));
    }

    void noMenuHasTheKeyOfACommand() {
        const auto window = shownWindow();
        QVERIFY(window);
        QSet<QKeySequence> menus;
        for (const QAction* menu : window->menuBar()->actions()) {
            const QKeySequence key = QKeySequence::mnemonic(menu->text());
            QVERIFY2(!key.isEmpty() && !menus.contains(key), qPrintable(menu->text()));
            menus.insert(key);
        }
        for (const KeyBindings::Group& group : window->keys().groups())
            for (const ActionSection& section : group.sections)
                for (const QAction* action : section.actions)
                    for (const QKeySequence& key : window->keys().keysOf(action))
                        QVERIFY2(!menus.contains(key), qPrintable(action->text()));
    }

    /// What the hand learned in one workspace does no harm in another.
    void keysOfTheWindowWorkWhereOneLabels() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        openWorkspace(*window, Qt::Key_2);
        window->canvas().setFocus();
        QTest::keyClick(&window->canvas(), Qt::Key_T, Qt::AltModifier);
        QVERIFY(window->overlays().isVisible(TrackLayer::kKind));
        QTest::keyClick(&window->canvas(), Qt::Key_Period);
        QVERIFY(QTest::qWaitFor([&] { return window->canvas().frame().index == 1; }, kPatience_ms));
        QTest::keyClick(&window->canvas(), Qt::Key_Comma);
        QVERIFY(QTest::qWaitFor([&] { return window->canvas().frame().index == 0; }, kPatience_ms));
        QTest::keyClick(&window->canvas(), Qt::Key_L);
        QVERIFY(window->session().playback().playing());
        QTest::keyClick(&window->canvas(), Qt::Key_K);
        QVERIFY(!window->session().playback().playing());
        const double speed = window->session().playback().speed();
        QTest::keyClick(&window->canvas(), Qt::Key_Greater);
        QVERIFY(window->session().playback().speed() > speed);
        QTest::keyClick(&window->canvas(), Qt::Key_Less);
        QCOMPARE(window->session().playback().speed(), speed);
        QTest::keyClick(&window->canvas(), Qt::Key_Space, Qt::ShiftModifier);
        QVERIFY(window->actions().loop->isChecked());
    }

    void keysMoveThePictureAndZoomTheTimeline() {
        const auto window = shownWindow();
        QVERIFY(window);
        ProjectSession& session = window->session();
        session.openMedia(test::sceneUnderTest(2000));
        VideoView& canvas = window->canvas();
        const auto is_open = [&] {
            return !session.project().empty() && !session.opening() && !canvas.frame().image.isNull();
        };
        QVERIFY(QTest::qWaitFor(is_open, kPatience_ms));
        canvas.setFocus();
        for (int i = 0; i < 4; ++i) QTest::keyClick(&canvas, Qt::Key_Plus);
        const auto middle = [&] {
            return canvas.transform().imageFromView({canvas.width() / 2.0, canvas.height() / 2.0});
        };
        const QPointF before = middle();
        QTest::keyClick(&canvas, Qt::Key_Right, Qt::AltModifier);
        QVERIFY(middle().x() > before.x() + 1 && std::abs(middle().y() - before.y()) < 0.01);
        QTest::keyClick(&canvas, Qt::Key_Left, Qt::AltModifier);
        QTest::keyClick(&canvas, Qt::Key_Down, Qt::AltModifier);
        QVERIFY(middle().y() > before.y() + 1 && std::abs(middle().x() - before.x()) < 0.01);
        QTest::keyClick(&canvas, Qt::Key_Up, Qt::AltModifier);
        QVERIFY(std::abs(middle().y() - before.y()) < 0.01);
        QCOMPARE(session.currentFrame(), 0);

        const TimelineAxis& axis = window->timeline().axis();
        QVERIFY(axis.showsAll());
        session.goToFrame(1000);
        QTest::keyClick(&canvas, Qt::Key_Plus, Qt::ControlModifier);
        QVERIFY(!axis.showsAll());
        QVERIFY(axis.firstVisible() < 1000 && axis.lastVisible() > 1000);
        QTest::keyClick(&canvas, Qt::Key_Minus, Qt::ControlModifier);
        QVERIFY(axis.showsAll());
        // They stand on the sheet of keys; menus are for who has a mouse.
        for (const ActionSection& section : window->actions().sections()) {
            QMenu menu;
            window->actions().fill(menu, section);
            QVERIFY(!menu.actions().contains(window->actions().look_left));
        }
    }

    /// Space plays, arrows step and Alt with an arrow moves the picture, but not from a button, a slider or a box of
    /// choices that keys have led to.
    void whatHasTheFocusHasItsKeys() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        auto* dock = new QDockWidget(window.get());
        auto* content = new QWidget(dock);
        auto* button = new QPushButton(QStringLiteral("button"), content);
        button->setCheckable(true);
        auto* tool = new QToolButton(content);
        tool->setText(QStringLiteral("tool"));
        tool->setCheckable(true);
        auto* box = new QCheckBox(QStringLiteral("switch"), content);
        auto* slider = new QSlider(Qt::Horizontal, content);
        auto* choices = new QComboBox(content);
        choices->addItems({QStringLiteral("one"), QStringLiteral("two"), QStringLiteral("three")});
        auto* rows = new QVBoxLayout(content);
        for (QWidget* widget : std::initializer_list<QWidget*>{button, tool, box, slider, choices})
            rows->addWidget(widget);
        dock->setWidget(content);
        window->addDockWidget(Qt::RightDockWidgetArea, dock);
        dock->show();
        QVERIFY(QTest::qWaitFor([&] { return choices->isVisible() && !window->canvas().frame().image.isNull(); },
                                kPatience_ms));
        ProjectSession& session = window->session();
        for (QAbstractButton* one : std::initializer_list<QAbstractButton*>{button, tool, box}) {
            one->setFocus(Qt::TabFocusReason);
            QTest::keyClick(one, Qt::Key_Space);
            QVERIFY2(one->isChecked() && !session.playback().playing(), qPrintable(one->text()));
        }
        QTest::keyClick(box, Qt::Key_Space, Qt::ShiftModifier);
        QVERIFY2(box->isChecked() && window->actions().loop->isChecked(), "other keys are the window's");
        slider->setFocus(Qt::TabFocusReason);
        QTest::keyClick(slider, Qt::Key_Right);
        QCOMPARE(slider->value(), 1);
        QCOMPARE(session.currentFrame(), 0);

        choices->setFocus(Qt::TabFocusReason);
        QTest::keyClick(choices, Qt::Key_Down);
        QCOMPARE(choices->currentIndex(), 1);
        const QPointF middle = window->canvas().transform().imageFromView({0, 0});
        for (const Qt::KeyboardModifier modifier : {Qt::AltModifier, Qt::NoModifier}) {
            QTest::keyClick(choices, modifier == Qt::AltModifier ? Qt::Key_Down : Qt::Key_Space, modifier);
            QVERIFY(choices->view()->isVisible());
            choices->hidePopup();
        }
        QCOMPARE(window->canvas().transform().imageFromView({0, 0}), middle);
        QCOMPARE(session.currentFrame(), 0);
        QVERIFY(!session.playback().playing());
    }

    void whoClicksAButtonGoesOnPlayingWithSpace() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        auto* dock = new QDockWidget(window.get());
        auto* button = new QPushButton(QStringLiteral("button"), dock);
        button->setCheckable(true);
        button->setFocusPolicy(Qt::StrongFocus);
        dock->setWidget(button);
        window->addDockWidget(Qt::RightDockWidgetArea, dock);
        dock->show();
        QVERIFY(QTest::qWaitFor([&] { return button->isVisible() && !window->canvas().frame().image.isNull(); },
                                kPatience_ms));
        window->canvas().setFocus();
        QTest::mouseClick(button, Qt::LeftButton);
        QVERIFY(button->isChecked() && button->hasFocus());
        QTest::keyClick(button, Qt::Key_Space);
        QVERIFY(button->isChecked() && window->session().playback().playing());
        // Where the focus goes in a dialog does not matter here, nor that it comes back from the menu bar.
        QDialog dialog(window.get());
        QFocusEvent into(QEvent::FocusIn, Qt::TabFocusReason);
        QApplication::sendEvent(&dialog, &into);
        QFocusEvent back(QEvent::FocusIn, Qt::MenuBarFocusReason);
        QApplication::sendEvent(button, &back);
        QTest::keyClick(button, Qt::Key_Space);
        QVERIFY(button->isChecked() && !window->session().playback().playing());
    }

    void whatKeysHaveLedToIsClickedStill() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        auto* dock = new QDockWidget(window.get());
        auto* button = new QPushButton(QStringLiteral("button"), dock);
        button->setCheckable(true);
        dock->setWidget(button);
        window->addDockWidget(Qt::RightDockWidgetArea, dock);
        dock->show();
        QVERIFY(QTest::qWaitFor([&] { return button->isVisible() && !window->canvas().frame().image.isNull(); },
                                kPatience_ms));
        button->setFocus(Qt::TabFocusReason);
        QVERIFY(button->hasFocus());
        QTest::mouseClick(button, Qt::LeftButton);
        QVERIFY(button->isChecked());
        QTest::keyClick(button, Qt::Key_Space);
        QVERIFY(button->isChecked() && window->session().playback().playing());
        window->session().playback().pause();
    }

    void hintsNameTheKeysThatWorkNow() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        QAction* checked = window->labelling().actions().checked;
        const auto hint = [&] {
            for (const auto* button : window->labelling().inspector().findChildren<QToolButton*>())
                if (button->text() == QStringLiteral("Checked")) return button->toolTip();
            return QString();
        };
        QVERIFY2(hint().endsWith(QStringLiteral("(V)")), qPrintable(hint()));
        window->keys().setKeysOf(checked, {QKeySequence(Qt::Key_F4)});
        QVERIFY2(hint().endsWith(QStringLiteral("(F4)")), qPrintable(hint()));
        window->keys().setKeysOf(checked, {});
        QVERIFY2(!hint().contains(QLatin1Char('(')) && !hint().isEmpty(), qPrintable(hint()));
    }

    void theSheetOfKeysIsSearchedByCommandAndKey() {
        const auto window = shownWindow();
        QVERIFY(window);
        KeySheet sheet(window->keys(), {}, window.get());
        const auto visible = [&] {
            QStringList texts;
            for (QTreeWidgetItemIterator item(&sheet.list()); *item != nullptr; ++item)
                if ((*item)->parent() != nullptr && !(*item)->isHidden()) texts << (*item)->text(0);
            return texts;
        };
        const auto all = visible().size();
        sheet.search().setText(QStringLiteral("go to frame"));
        QCOMPARE(visible(), QStringList(QStringLiteral("Go to frame")));
        sheet.search().setText(QStringLiteral("ctrl+r"));
        QVERIFY(visible().contains(QStringLiteral("Run")));
        sheet.search().clear();
        QCOMPARE(visible().size(), all);
    }
};

}  // namespace eyrie::ui::window_keys_test

EYRIE_UI_TEST(QApplication, window_keys_test, WindowKeysTest)
#include "window_keys_test.moc"
