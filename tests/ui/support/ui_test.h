#pragma once

#include <QTest>
#include <functional>
#include <map>
#include <string>

namespace eyrie::ui::test {

/// The Qt Test classes of a program by the names of their files, each with what runs it in an application of its own.
using UiTests = std::map<std::string, std::function<int(int argc, char** argv)>>;
UiTests& uiTests();

/// Registers a class by being.
struct RegisteredUiTest {
    RegisteredUiTest(const char* file, UiTests::mapped_type run) { uiTests().emplace(file, std::move(run)); }
};

}  // namespace eyrie::ui::test

/// In place of QTEST_MAIN: the class in eyrie::ui::`file` is a test of its folder's program and is run by the name of
/// its file (`ui_window_test like_tracks_test`) in an `Application` (QApplication, or QCoreApplication where it must do
/// without a screen). What a folder's files share is compiled once and linked once.
#define EYRIE_UI_TEST(Application, file, Class)                                                         \
    static const eyrie::ui::test::RegisteredUiTest file##_registered(#file, [](int argc, char** argv) { \
        const Application application(argc, argv);                                                      \
        eyrie::ui::file::Class tests;                                                                   \
        return QTest::qExec(&tests, argc, argv);                                                        \
    });
