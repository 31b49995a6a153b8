#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <random>

#include "core/error.h"
#include "store/runs/result_writer.h"
#include "store/samples.h"
#include "support/child.h"
#include "support/temporary_folder.h"

namespace eyrie::damage_test {
namespace {

std::string readBytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Reads all of a file that holds `bytes`; an Error(project) is an accepted answer, anything else is not.
void expectReadOrRefused(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    try {
        test::readEverything(path);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::project) << error.what();
        EXPECT_THAT(error.what(), testing::HasSubstr(path.string()));
    }
}

TEST(DamagedProject, OverwrittenBytesAreReadOrRefused) {
    const test::TemporaryFolder folder;
    const auto path = folder / "clip.eyrie";
    test::writeSampleProject(path, 6);
    const std::string whole = readBytes(path);
    std::mt19937 dice(7);
    for (int trial = 0; trial < 150; ++trial) {
        std::string damaged = whole;
        const std::size_t length = std::size_t{1} << (dice() % 12);
        const std::size_t at = dice() % (damaged.size() - length);
        for (std::size_t i = 0; i < length; ++i) damaged[at + i] = static_cast<char>(dice());
        expectReadOrRefused(path, damaged);
    }
}

TEST(DamagedProject, AnOverwrittenMiddleIsNoticed) {
    const test::TemporaryFolder folder;
    const auto path = folder / "clip.eyrie";
    test::writeSampleProject(path, 6);
    std::string bytes = readBytes(path);
    std::fill(bytes.begin() + 8192, bytes.end(), '\x5a');
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    EXPECT_THROW(test::readEverything(path), Error);
}

TEST(DamagedProject, ATruncatedFileIsRefused) {
    const test::TemporaryFolder folder;
    const auto path = folder / "clip.eyrie";
    test::writeSampleProject(path, 6);
    const auto size = std::filesystem::file_size(path);
    for (const auto left : {size - 1, size - 8192, size / 2, std::uintmax_t{8192}, std::uintmax_t{150}}) {
        std::filesystem::resize_file(path, left);
        try {
            ProjectFile::open(path);
            FAIL() << "expected an error with " << left << " bytes";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::project);
            EXPECT_THAT(error.what(), testing::HasSubstr("cut off"));
        }
    }
    std::filesystem::resize_file(path, 50);
    EXPECT_THROW(ProjectFile::open(path), Error);
}

TEST(FullDisk, IsAnErrorAndWhatWasStoredStays) {
    const test::TemporaryFolder folder;
    const auto path = folder / "clip.eyrie";
    ProjectFile::create(path);
    const test::SampleSize large{20000, 3000, 20, 20, 20, {768, 576}};
    // A limit on the size of files stands for the full disk. Exit code: frames written before the error.
    const int written = test::inChild([&] {
        std::signal(SIGXFSZ, SIG_IGN);
        ResultWriter writer(path, test::sampleRun(), {});
        const rlimit limit{3'000'000, 3'000'000};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 98;
        for (int frame = 0; frame < 90; ++frame) {
            try {
                writer.write(test::sampleFrame(frame, large));
            } catch (const Error& error) {
                return error.kind() == ErrorKind::output ? frame : 97;
            }
        }
        return 96;
    });
    ASSERT_GT(written, 0);
    ASSERT_LT(written, 90) << "no error of the expected kind";
    ProjectFile project = ProjectFile::open(path);
    const RunStore store(project);
    ASSERT_EQ(store.run(1)->frames_done, written);
    for (int frame = 0; frame < written; frame += 5) {
        test::expectSame(*store.frameResult(1, frame), test::sampleFrame(frame, large));
    }
}

}  // namespace
}  // namespace eyrie::damage_test
