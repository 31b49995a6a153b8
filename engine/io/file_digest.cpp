#include "io/file_digest.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <memory>
#include <vector>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/folder.h"
#include "io/video/image_sequence.h"
#include "io/video/parts/part_list.h"

extern "C" {
#include <libavutil/mem.h>
#include <libavutil/sha.h>
}

namespace eyrie {
namespace {

class Sha256 {
 public:
    Sha256() : state_(av_sha_alloc()) {
        if (!state_ || av_sha_init(state_.get(), 256) < 0) throw Error(ErrorKind::internal, "no SHA-256");
    }
    void add(const char* bytes, std::size_t count) {
        av_sha_update(state_.get(), reinterpret_cast<const std::uint8_t*>(bytes), count);
    }
    std::string digits() {
        std::array<std::uint8_t, 32> digest{};
        av_sha_final(state_.get(), digest.data());
        static constexpr const char* kDigits = "0123456789abcdef";
        std::string text;
        for (const std::uint8_t byte : digest) {
            text += kDigits[byte >> 4];
            text += kDigits[byte & 15];
        }
        return text;
    }

 private:
    struct Free {
        void operator()(AVSHA* state) const { av_free(state); }
    };
    std::unique_ptr<AVSHA, Free> state_;
};

constexpr std::uintmax_t kEdge = 1U << 16;  ///< bytes

/// What the digest of a path is made of, in order.
std::vector<std::filesystem::path> filesOf(const std::filesystem::path& path) {
    if (isFolder(path)) return imagesIn(path);
    if (!hasPartListName(path)) return {path};
    std::vector<std::filesystem::path> files;
    for (const ListedPart& part : readPartList(path)) files.push_back(part.file);
    return files;
}

/// In steps of two seconds: some disks know no finer ones, and a folder may be copied to one.
std::int64_t writtenAt(const std::filesystem::path& file) {
    constexpr std::int64_t kStep_s = 2;
    const auto written = std::filesystem::last_write_time(file).time_since_epoch();
    return std::chrono::duration_cast<std::chrono::seconds>(written).count() / kStep_s;
}

}  // namespace

std::string edgeDigestOf(const std::filesystem::path& path) {
    checkReadableFile(path);
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(path, failed);
    std::ifstream stream(path, std::ios::binary);
    Sha256 sum;
    std::vector<char> block(kEdge);
    const auto add = [&](std::uintmax_t from, std::uintmax_t to) {
        stream.seekg(static_cast<std::streamoff>(from));
        stream.read(block.data(), static_cast<std::streamsize>(to - from));
        sum.add(block.data(), static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    };
    add(0, std::min(size, kEdge));
    if (size > kEdge) add(std::max(kEdge, size - kEdge), size);
    if (failed || stream.fail()) throw Error(ErrorKind::input, path.string() + ": cannot be read to its end");
    return sum.digits();
}

std::string listingDigestOf(const std::filesystem::path& path) {
    try {
        if (!isFolder(path) && !isFile(path)) return {};
        std::vector<std::filesystem::path> files = filesOf(path);
        if (isFile(path) && hasPartListName(path)) files.push_back(path);
        Sha256 sum;
        for (const std::filesystem::path& file : files) {
            const std::string name = file.filename().string();
            const std::string state = std::to_string(std::filesystem::file_size(file)) + " " +
                                      (isFolder(path) ? std::to_string(writtenAt(file)) : edgeDigestOf(file));
            sum.add(name.c_str(), name.size() + 1);
            sum.add(state.c_str(), state.size() + 1);
        }
        return sum.digits();
    } catch (const std::filesystem::filesystem_error&) {
        return {};  // it went meanwhile
    } catch (const Error&) {
        return {};
    }
}

std::string sha256Of(const std::filesystem::path& path, const std::function<void(double)>& progress,
                     const std::stop_token& stop) {
    const bool several = isFolder(path) || hasPartListName(path);
    const std::vector<std::filesystem::path> files = filesOf(path);
    std::uintmax_t total = 0, done = 0;
    for (const std::filesystem::path& file : files) {
        checkReadableFile(file);
        total += std::filesystem::file_size(file);
    }
    Sha256 sum;
    std::vector<char> block(1 << 20);
    for (const std::filesystem::path& file : files) {
        const std::string name = file.filename().string();
        if (several) sum.add(name.c_str(), name.size() + 1);
        std::ifstream stream(file, std::ios::binary);
        while (stream) {
            if (stop.stop_requested()) return {};
            stream.read(block.data(), static_cast<std::streamsize>(block.size()));
            const auto count = static_cast<std::size_t>(stream.gcount());
            sum.add(block.data(), count);
            done += count;
            if (progress && total > 0) progress(std::min(1.0, static_cast<double>(done) / static_cast<double>(total)));
        }
        if (!stream.eof()) throw Error(ErrorKind::input, file.string() + ": cannot be read to its end");
    }
    return sum.digits();
}

}  // namespace eyrie
