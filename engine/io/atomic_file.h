#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace eyrie {

/// Whether a written file must survive a power cut (waits for the disk), or may be left to the system: one of many
/// small files that are made anew together.
enum class Durability { synchronised, left_to_system };

/// Replaces a file in one step: readers see the old bytes or the new ones, never a part. A link stays one, its target
/// is replaced. Devices and pipes are written to as they are; /dev/stdout and the like go where the process writes, in
/// turn with what it prints. Throws Error(output) naming the file and the reason; the old file is untouched then.
void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes,
                         Durability durability = Durability::synchronised);

/// The same for a file that is made bit by bit, so that it need not be held whole. What was there stays until finish();
/// without that nothing has happened. Devices and pipes get each bit as it comes.
class AtomicFileWriter {
 public:
    explicit AtomicFileWriter(std::filesystem::path path, Durability durability = Durability::synchronised);
    ~AtomicFileWriter();
    AtomicFileWriter(const AtomicFileWriter&) = delete;
    AtomicFileWriter& operator=(const AtomicFileWriter&) = delete;

    void write(std::string_view bytes);
    void finish();

 private:
    void put(std::string_view bytes);
    [[noreturn]] void fail(int reason);

    std::filesystem::path path_;
    std::filesystem::path target_;
    std::filesystem::path aside_;  ///< empty: written in place
    Durability durability_;
    int file_ = -1;
    std::string waiting_;
};

/// Whether a name stands for a stream that this process has open: /dev/stdout, /dev/fd/3 and the like.
bool isOwnStream(const std::filesystem::path& path);

/// A new name beside `path` for what will take its place when it is complete; short enough where the name of `path` is
/// as long as names may be.
std::filesystem::path temporaryBeside(const std::filesystem::path& path);

/// Removes what processes that were killed left of earlier attempts at `path`. Looks through the whole folder: for
/// files that take long to write.
void removeAbandonedParts(const std::filesystem::path& path);

/// Where a rename must lead so that a link stays a link: its target, or the path itself.
std::filesystem::path throughLinks(const std::filesystem::path& path);

/// Throws Error(input) when a file is missing, a folder, a pipe or device (which would be waited for), or may not be
/// read.
void checkReadableFile(const std::filesystem::path& path);

/// All bytes of a file. Throws Error(input) as checkReadableFile does.
std::string readWholeFile(const std::filesystem::path& path);

}  // namespace eyrie
