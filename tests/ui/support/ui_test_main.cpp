#include "ui/support/ui_test.h"

#include <cstdio>

namespace eyrie::ui::test {

UiTests& uiTests() {
    static UiTests tests;
    return tests;
}

}  // namespace eyrie::ui::test

/// `ui_FOLDER_test FILE [arguments of Qt Test]`
int main(int argc, char** argv) {
    const auto& tests = eyrie::ui::test::uiTests();
    const auto found = argc > 1 ? tests.find(argv[1]) : tests.end();
    if (found == tests.end()) {
        std::fputs("Name a file of tests, and what else Qt Test is to be told:\n", stderr);
        for (const auto& test : tests) std::fprintf(stderr, "  %s\n", test.first.c_str());
        return 2;
    }
    argv[1] = argv[0];
    return found->second(argc - 1, argv + 1);
}
