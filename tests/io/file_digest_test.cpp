#include "io/file_digest.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <utility>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace eyrie::file_digest_test {
namespace {

void write(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

TEST(FileDigest, isThatOfTheStandard) {
    const test::TemporaryFolder folder;
    write(folder / "abc", "abc");  // FIPS 180-4, example B.1
    EXPECT_EQ(sha256Of(folder / "abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    write(folder / "none", "");
    EXPECT_EQ(sha256Of(folder / "none"), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    write(folder / "million", std::string(1'000'000, 'a'));  // and B.3
    double told = 0;
    EXPECT_EQ(sha256Of(folder / "million", [&](double share) { told = share; }),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    EXPECT_EQ(told, 1);
}

TEST(FileDigest, ofAFolderIsThatOfItsImagesAndTheirNames) {
    const test::TemporaryFolder folder;
    write(folder / "frame10.png", "b");
    write(folder / "frame2.png", "a");
    const std::string before = sha256Of(folder.path());
    write(folder / "notes.txt", "of no account");
    EXPECT_EQ(sha256Of(folder.path()), before);
    write(folder / "all", std::string("frame2.png\0aframe10.png\0b", 25));
    EXPECT_EQ(sha256Of(folder / "all"), before);
    std::filesystem::rename(folder / "frame2.png", folder / "frame3.png");
    EXPECT_NE(sha256Of(folder.path()), before);
}

TEST(FileDigest, ofAListingTellsWhatIsThereAndFromWhen) {
    const test::TemporaryFolder folder;
    std::filesystem::create_directories(folder / "day");
    write(folder / "day/a.png", "1");
    write(folder / "day/B.png", "2");
    std::string before = listingDigestOf(folder / "day");
    EXPECT_EQ(before.size(), 64U);
    const auto differs = [&] {
        const std::string now = listingDigestOf(folder / "day");
        return std::exchange(before, now) != now;
    };
    write(folder / "day/notes.txt", "of no account");
    EXPECT_FALSE(differs());
    write(folder / "day/c.png", "3");
    EXPECT_TRUE(differs());
    std::filesystem::remove(folder / "day/a.png");
    EXPECT_TRUE(differs());
    std::filesystem::rename(folder / "day/c.png", folder / "day/A.png");
    EXPECT_TRUE(differs());
    const auto written = std::filesystem::last_write_time(folder / "day/A.png");
    write(folder / "day/A.png", "long");
    std::filesystem::last_write_time(folder / "day/A.png", written);
    EXPECT_TRUE(differs());
    std::filesystem::last_write_time(folder / "day/A.png", written - std::chrono::hours(1));
    EXPECT_TRUE(differs());
    // On a video no time of writing is relied on: copied back it is the same, and an older one is another.
    const std::string video = listingDigestOf(folder / "day/A.png");
    std::filesystem::last_write_time(folder / "day/A.png", written);
    EXPECT_EQ(listingDigestOf(folder / "day/A.png"), video);
    write(folder / "day/A.png", "else");
    EXPECT_NE(listingDigestOf(folder / "day/A.png"), video);
    EXPECT_EQ(listingDigestOf(folder / "absent"), "");
    EXPECT_EQ(listingDigestOf("scene:stops"), "");
}

TEST(FileDigest, ofAListingOfPartsIsThatOfTheListAndItsParts) {
    const test::TemporaryFolder folder;
    for (const char* name : {"a.mp4", "b.mp4"}) write(folder / name, "video");
    write(folder / "whole.parts", "file\na.mp4\n");
    const std::string one = listingDigestOf(folder / "whole.parts");
    write(folder / "whole.parts", "file\na.mp4\nb.mp4\n");
    const std::string two = listingDigestOf(folder / "whole.parts");
    EXPECT_NE(two, one);
    write(folder / "b.mp4", "another");
    EXPECT_NE(listingDigestOf(folder / "whole.parts"), two);
}

TEST(FileDigest, ofTheEdgesAre64KilobytesAtEitherEnd) {
    const test::TemporaryFolder folder;
    const auto edges = [&](const std::string& bytes) {
        write(folder / "edges", bytes);
        return edgeDigestOf(folder / "edges");
    };
    // Up to twice as much they meet, and every byte counts once.
    for (const std::size_t size : {0, 3, 65'536, 65'537, 100'000, 131'072}) {
        std::string bytes(size, 'a');
        for (std::size_t i = 0; i < size; i += 7) bytes[i] = static_cast<char>(i / 7 % 251);
        const std::string digest = edges(bytes);
        EXPECT_EQ(digest, sha256Of(folder / "edges")) << size;
    }
    const std::string longer(131'074, 'a');
    const std::string digest = edges(longer);
    const auto differsAt = [&](std::size_t at) {
        std::string changed = longer;
        changed[at] = 'b';
        return edges(changed) != digest;
    };
    EXPECT_TRUE(differsAt(65'535));
    EXPECT_FALSE(differsAt(65'536)) << "two bytes in the middle do not count";
    EXPECT_FALSE(differsAt(65'537));
    EXPECT_TRUE(differsAt(65'538));
    EXPECT_TRUE(differsAt(131'073));
}

TEST(FileDigest, whatCannotBeReadIsRefused) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(sha256Of(folder / "absent"), Error);
    write(folder / "a", "abc");
    std::stop_source stop;
    stop.request_stop();
    EXPECT_EQ(sha256Of(folder / "a", {}, stop.get_token()), "");
}

}  // namespace eyrie::file_digest_test
