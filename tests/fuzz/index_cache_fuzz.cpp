#include <vector>

#include "fuzz/input_file.h"
#include "io/video/index_cache.h"

/// Bytes as the record of a video's index, with a right checksum, so that what lies behind it is reached.
namespace {

struct Reader {
    eyrie::fuzz::MemoryFolder folder;
    std::filesystem::path video = folder / "clip.mp4";
    eyrie::IndexCache cache{folder / "cache"};
    std::filesystem::path record;

    Reader() {
        eyrie::fuzz::writeBytes(video, "video", 5);
        std::filesystem::create_directories(folder / "cache");
        eyrie::VideoIndex index;
        index.packets.resize(3);
        index.shown = {0, 1, 2};
        index.shown_ticks = {0, 1, 2};
        index.codec = "h264";
        cache.save(eyrie::stateOf(video), index);
        record = cache.recordOf(video);
        if (!std::filesystem::exists(record)) std::abort();
    }
    static Reader& only() {
        static Reader reader;
        return reader;
    }
};

/// FNV-1a, as the records have it.
std::uint64_t checksum(const std::uint8_t* data, std::size_t size) {
    std::uint64_t sum = 0xCBF29CE484222325ULL;
    for (std::size_t i = 0; i < size; ++i) sum = (sum ^ data[i]) * 0x100000001B3ULL;
    return sum;
}

/// The bytes behind what names the video, which a fuzzer would not guess: those are kept as they were.
std::vector<std::uint8_t> withHead(const Reader& reader, const std::uint8_t* data, std::size_t size) {
    static const std::string whole = [&] {
        std::string bytes(std::filesystem::file_size(reader.record), '\0');
        const int file = open(reader.record.c_str(), O_RDONLY | O_CLOEXEC);
        if (file < 0 || read(file, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) std::abort();
        close(file);
        return bytes;
    }();
    // Magic number, path with its length, size and time of change.
    const std::size_t head = 8 + 8 + reader.video.string().size() + 8 + 8;
    std::vector<std::uint8_t> record(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(head));
    record.insert(record.end(), data, data + size);
    const std::uint64_t sum = checksum(record.data(), record.size());
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&sum);
    record.insert(record.end(), bytes, bytes + sizeof sum);
    return record;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Reader& reader = Reader::only();
    const std::vector<std::uint8_t> record = withHead(reader, data, size);
    eyrie::fuzz::writeBytes(reader.record, record.data(), record.size());
    eyrie::fuzz::expectAnswer([&] {
        const auto index = reader.cache.load(reader.video);
        if (!index) return;
        index->firstStart();
        index->framesOfPackets();
    });
    return 0;
}
