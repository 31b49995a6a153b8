#include "io/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace eyrie::atomic_file_test {
namespace {

namespace fs = std::filesystem;

std::ptrdiff_t entriesIn(const fs::path& folder) {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(AtomicFile, WhatIsMadeBitByBitAppearsWhole) {
    const test::TemporaryFolder folder;
    const fs::path path = folder / "table.csv";
    writeFileAtomically(path, "old");
    std::string expected;
    AtomicFileWriter file(path);
    for (int i = 0; i < 30'000; ++i) {
        const std::string line = std::to_string(i) + '\n';
        file.write(line);
        expected += line;
    }
    const std::string much(200'000, 'x');
    file.write(much);
    expected += much;
    EXPECT_EQ(readWholeFile(path), "old");
    file.finish();
    EXPECT_EQ(readWholeFile(path), expected);
    EXPECT_EQ(entriesIn(folder.path()), 1);
}

TEST(AtomicFile, WhatIsNotFinishedLeavesNothing) {
    const test::TemporaryFolder folder;
    const fs::path path = folder / "table.csv";
    writeFileAtomically(path, "old");
    {
        AtomicFileWriter file(path);
        file.write(std::string(100'000, 'x'));
    }
    EXPECT_EQ(readWholeFile(path), "old");
    EXPECT_EQ(entriesIn(folder.path()), 1);
}

TEST(AtomicFile, AFullDeviceIsToldWhereverItIsNoticed) {
    AtomicFileWriter little("/dev/full");
    little.write("little");
    EXPECT_THROW(little.finish(), Error);
    AtomicFileWriter much("/dev/full");
    EXPECT_THROW(much.write(std::string(100'000, 'x')), Error);
}

}  // namespace
}  // namespace eyrie::atomic_file_test
