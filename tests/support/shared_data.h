#pragma once

#include <filesystem>
#include <string>

#include "support/places.h"

/// Real data for tests. It lies outside the project; a test that needs it skips, saying so, where it is absent:
///     EYRIE_NEED_SHARED_DATA("collage_day");
namespace eyrie::test {

inline std::filesystem::path sharedData(const std::string& name) {
    return sharedFolder() / name;
}

}  // namespace eyrie::test

#define EYRIE_NEED_SHARED_DATA(name)                             \
    if (!std::filesystem::exists(eyrie::test::sharedData(name))) \
    GTEST_SKIP() << "needs " << eyrie::test::sharedData(name).string() << ", which is not on this machine"
