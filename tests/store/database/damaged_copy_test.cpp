#include "store/health/damaged_copy.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <fstream>

#include "store/project/schema.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

/// The bytes of the copies from which damaged projects are read, by the layout that SQLite documents.
namespace eyrie::damaged_copy_test {
namespace {

using testing::HasSubstr;

constexpr std::size_t kPage = 8192;

std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::uint32_t numberAt(const std::string& bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value * 256 + static_cast<unsigned char>(bytes[at + i]);
    return value;
}

class DamagedCopyTest : public testing::Test {
 protected:
    /// A project as this version makes it.
    std::string wholeProject() const {
        const auto path = folder_ / "whole.eyrie";
        test::writeSampleProject(path, 6);
        return bytesOf(path);
    }
    /// The page on which a table of it begins, from 1.
    std::size_t rootOf(const std::string& table) const {
        SQLite::Database database((folder_ / "whole.eyrie").string());
        return database.execAndGet("SELECT rootpage FROM sqlite_schema WHERE name = '" + table + "'").getUInt();
    }
    DamagedCopy copyOf(const std::string& bytes) {
        const auto path = folder_ / "damaged.eyrie";
        std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
        const auto folder = folder_ / ("copy" + std::to_string(++copies_));
        std::filesystem::create_directory(folder);
        const DamagedCopy copy = copyDamaged(path, folder, {});
        EXPECT_EQ(bytesOf(path), bytes) << "the project itself is only read";
        return copy;
    }
    /// What every rebuilt header says; of `page_size` bytes a page.
    static void expectRebuilt(const DamagedCopy& copy, std::size_t page_size, const std::string& what) {
        ASSERT_EQ(copy.notes.size(), 1U) << what;
        EXPECT_THAT(copy.notes[0], HasSubstr("(header) was damaged and was rebuilt")) << what;
        const std::string header = bytesOf(copy.path);
        EXPECT_EQ(header.substr(0, 16), std::string("SQLite format 3", 16)) << what;
        EXPECT_EQ(numberAt(header, 16, 2), page_size) << what;
        EXPECT_EQ(numberAt(header, 18, 2), 0x0101U) << what << ": without a log";
        EXPECT_EQ(numberAt(header, 20, 4), 0x00402020U) << what;
        EXPECT_EQ(numberAt(header, 24, 4), 0U) << what;
        EXPECT_EQ(numberAt(header, 28, 4), header.size() / page_size) << what;
        EXPECT_EQ(numberAt(header, 32, 4), 0U) << what;
        EXPECT_EQ(numberAt(header, 36, 4), 0U) << what;
        EXPECT_EQ(numberAt(header, 44, 4), 4U) << what;
        EXPECT_EQ(numberAt(header, 48, 4), 0U) << what;
        EXPECT_EQ(numberAt(header, 52, 4), 0U) << what;
        EXPECT_EQ(numberAt(header, 56, 4), 1U) << what << ": UTF-8";
        EXPECT_EQ(numberAt(header, 60, 4), static_cast<std::uint32_t>(schema::currentNumber())) << what;
        EXPECT_EQ(numberAt(header, 64, 4), 0U) << what;
        EXPECT_EQ(numberAt(header, 68, 4), static_cast<std::uint32_t>(schema::kApplicationId)) << what;
        EXPECT_EQ(numberAt(header, 92, 4), 0U) << what;
    }

    test::TemporaryFolder folder_;
    int copies_ = 0;
};

/// A table leaf on each page but the first six, as SQLite itself lays them.
std::string smallPages(const std::filesystem::path& path, int page_size, int rows) {
    {
        SQLite::Database database(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        database.exec("PRAGMA page_size = " + std::to_string(page_size));
        for (const char* table : {"run", "frame", "sequence", "track_state", "detection"})
            database.exec("CREATE TABLE " + std::string(table) + " (text)");
        database.exec("WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT " + std::to_string(rows) +
                      ") INSERT INTO detection SELECT printf('%.400c', 'x') FROM n");
    }
    return bytesOf(path);
}

}  // namespace

TEST_F(DamagedCopyTest, OfAWholeProjectItIsTheSameBytes) {
    const std::string whole = wholeProject();
    const DamagedCopy copy = copyOf(whole);
    EXPECT_TRUE(copy.notes.empty());
    EXPECT_FALSE(copy.stopped);
    EXPECT_EQ(bytesOf(copy.path).substr(100), whole.substr(100));
}

TEST_F(DamagedCopyTest, AHeaderThatCannotBeIsThatOfEveryProject) {
    const std::string whole = wholeProject();
    for (const auto& [at, value] :
         {std::pair<std::size_t, int>{0, 'X'}, {15, 1}, {16, 0x30}, {19, 3}, {21, 1}, {22, 0}, {23, 1}, {47, 9}}) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(value);
        const DamagedCopy copy = copyOf(damaged);
        expectRebuilt(copy, kPage, "byte " + std::to_string(at));
        EXPECT_EQ(bytesOf(copy.path).substr(100), whole.substr(100)) << at;
    }
}

TEST_F(DamagedCopyTest, OnlyAHeaderThatCannotBeIsReplaced) {
    std::string damaged = wholeProject();
    damaged[kPage * (rootOf("frame") - 1)] = 'Z';  // no page at all
    ASSERT_NE(numberAt(damaged, 52, 4), 0U) << "space goes back to the disk by maps of who points to a page";
    damaged[35] = 7;  // the first free page, and how many there are: neither is true
    damaged[39] = 9;
    damaged[95] = static_cast<char>(damaged[27] + 1);
    const DamagedCopy sound = copyOf(damaged);
    EXPECT_TRUE(sound.notes.empty());
    const std::string header = bytesOf(sound.path);
    EXPECT_EQ(header.substr(0, 24), damaged.substr(0, 24));
    EXPECT_EQ(numberAt(header, 28, 4), damaged.size() / kPage);
    EXPECT_EQ(numberAt(header, 32, 4), 0U);
    EXPECT_EQ(numberAt(header, 36, 4), 0U);
    EXPECT_EQ(header.substr(40, 12), damaged.substr(40, 12));
    EXPECT_EQ(numberAt(header, 52, 4), 0U);
    EXPECT_EQ(header.substr(56, 8), damaged.substr(56, 8));
    EXPECT_EQ(numberAt(header, 64, 4), 0U);
    EXPECT_EQ(header.substr(68, 24), damaged.substr(68, 24));
    EXPECT_EQ(header.substr(92, 4), header.substr(24, 4));
    for (const auto& [at, value] : {std::pair<std::size_t, int>{18, 0}, {18, 3}, {19, 0}, {20, 1}, {47, 3}, {59, 2}}) {
        std::string more = damaged;
        more[at] = static_cast<char>(value);
        expectRebuilt(copyOf(more), kPage, "byte " + std::to_string(at));
    }
}

TEST_F(DamagedCopyTest, FilesOfMoreThanOneBlockAreCopiedToTheLastByte) {
    std::string damaged = wholeProject();
    damaged[0] = 0;
    for (int i = 0; i < 1'500'007; ++i) damaged += static_cast<char>('a' + i % 23);
    const DamagedCopy copy = copyOf(damaged);
    expectRebuilt(copy, kPage, "large");
    EXPECT_EQ(bytesOf(copy.path).substr(100), damaged.substr(100));
}

TEST_F(DamagedCopyTest, PagesOfAnotherSizeAreToldByWhereTreesBegin) {
    for (const int page_size : {1024, 2048, 4096}) {
        const int a_page = page_size / 410;
        std::string damaged = smallPages(folder_ / (std::to_string(page_size) + ".eyrie"), page_size, 50 * a_page);
        std::fill(damaged.begin(), damaged.begin() + 100, '\0');
        expectRebuilt(copyOf(damaged), static_cast<std::size_t>(page_size), std::to_string(page_size));
    }
    // Of what is left of a header the size counts where it can be one.
    std::string damaged = smallPages(folder_ / "stated.eyrie", 1024, 100);
    damaged[0] = 0;
    expectRebuilt(copyOf(damaged), 1024, "stated");
}

TEST_F(DamagedCopyTest, WithoutItsListOfTablesItIsOneOfThisVersion) {
    std::string damaged = wholeProject();
    std::fill(damaged.begin(), damaged.begin() + kPage, '\0');
    const DamagedCopy copy = copyOf(damaged);
    ASSERT_EQ(copy.notes.size(), 2U);
    EXPECT_THAT(copy.notes[1], HasSubstr("the list of tables was lost"));
    const std::string bytes = bytesOf(copy.path);
    ASSERT_EQ(bytes.size(), damaged.size());
    EXPECT_EQ(numberAt(bytes, 16, 2), kPage);
    EXPECT_EQ(numberAt(bytes, 28, 4), damaged.size() / kPage) << "not as many as the sample has";
    EXPECT_EQ(numberAt(bytes, 32, 4), 0U);
    EXPECT_EQ(numberAt(bytes, 36, 4), 0U);
    EXPECT_EQ(bytes.substr(bytes.size() - kPage), damaged.substr(damaged.size() - kPage));
    SQLite::Database database(copy.path.string());
    EXPECT_TRUE(database.tableExists("track_state"));
}

TEST_F(DamagedCopyTest, CanBeStopped) {
    const auto path = folder_ / "whole.eyrie";
    test::writeSampleProject(path, 2);
    std::stop_source stop;
    stop.request_stop();
    CopyWatch watch;
    watch.stop = stop.get_token();
    EXPECT_TRUE(copyDamaged(path, folder_.path(), watch).stopped);
}

}  // namespace eyrie::damaged_copy_test
