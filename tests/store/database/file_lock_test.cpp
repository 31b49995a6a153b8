#include "store/database/file_lock.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/temporary_folder.h"

namespace eyrie::file_lock_test {

TEST(FileLock, WhoHoldsItIsToldByTheBeginningOfAFileHoweverLong) {
    const test::TemporaryFolder folder;
    const FileLock::Attempt held = FileLock::tryTake(folder / "a.lock");
    ASSERT_EQ(held.outcome, FileLock::Outcome::taken);
    std::string text;
    while (text.size() < 3000)
        text += "another program on another machine, number " + std::to_string(text.size()) + "; ";
    std::ofstream(folder / "a.lock") << text;
    const std::string told = FileLock::holderOf(folder / "a.lock").value_or("nobody");
    EXPECT_EQ(told, text.substr(0, told.size()));
    EXPECT_GT(told.size(), 100U);
    EXPECT_LE(told.size(), 512U);
    EXPECT_EQ(FileLock::tryTake(folder / "a.lock").words, told);
}

TEST(FileLock, AnEmptyFileIsThatOfAnotherProgram) {
    const test::TemporaryFolder folder;
    const FileLock::Attempt held = FileLock::tryTake(folder / "a.lock");
    std::ofstream(folder / "a.lock").flush();
    EXPECT_EQ(FileLock::holderOf(folder / "a.lock"), "another program");
}

TEST(FileLock, IsTakenByOneAtATimeAndItsFileGoesWithIt) {
    const test::TemporaryFolder folder;
    FileLock::Attempt first = FileLock::tryTake(folder / "a.lock");
    ASSERT_EQ(first.outcome, FileLock::Outcome::taken);
    EXPECT_EQ(FileLock::tryTake(folder / "a.lock").outcome, FileLock::Outcome::held);
    first.lock.reset();
    EXPECT_FALSE(std::filesystem::exists(folder / "a.lock"));
    EXPECT_FALSE(FileLock::holderOf(folder / "a.lock").has_value());
    EXPECT_EQ(FileLock::tryTake(folder / "a.lock").outcome, FileLock::Outcome::taken);
}

}  // namespace eyrie::file_lock_test
