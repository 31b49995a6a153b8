#include "store/database/new_file.h"

#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <thread>

#include "core/error.h"
#include "store/full_project.h"
#include "support/temporary_folder.h"

namespace eyrie::new_file_test {

TEST(NewFile, OfThoseWhoMakeItAtOnceOneDoes) {
    constexpr int kMakers = 4;
    const test::TemporaryFolder folder;
    for (int round = 0; round < 20; ++round) {
        const std::filesystem::path path = folder / std::to_string(round);
        std::barrier start(kMakers);
        std::atomic<int> made = 0;
        std::atomic<int> maker = -1;
        {
            std::vector<std::jthread> makers;
            for (int i = 0; i < kMakers; ++i)
                makers.emplace_back([&, i] {
                    start.arrive_and_wait();
                    if (!makeNewFile(path, std::string(1000, static_cast<char>('a' + i)))) return;
                    ++made;
                    maker = i;
                });
        }
        ASSERT_EQ(made, 1) << round;
        EXPECT_EQ(test::bytesOf(path), std::string(1000, static_cast<char>('a' + maker)));
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 20) << "nothing else is left";
}

TEST(NewFile, NeverReplacesWhatIsThere) {
    const test::TemporaryFolder folder;
    test::writeBytes(folder / "there", "mine");
    std::filesystem::create_symlink("nowhere", folder / "link");
    EXPECT_FALSE(makeNewFile(folder / "there", "yours"));
    EXPECT_FALSE(makeNewFile(folder / "link", "yours"));
    EXPECT_EQ(test::bytesOf(folder / "there"), "mine");
    EXPECT_THROW(makeNewFile(folder / "no folder" / "new", "yours"), Error);
}

}  // namespace eyrie::new_file_test
