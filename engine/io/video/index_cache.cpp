#include "io/video/index_cache.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iterator>
#include <sstream>

#include "core/error.h"
#include "io/atomic_file.h"

namespace eyrie {

namespace {

constexpr std::uint64_t kMagic = 0x3258444945525945ULL;  // EYREIDX2; a new layout gets a new number

std::uint64_t checksum(const std::string& bytes, std::size_t length) {
    std::uint64_t sum = 0xCBF29CE484222325ULL;
    for (std::size_t i = 0; i < length; ++i) sum = (sum ^ static_cast<unsigned char>(bytes[i])) * 0x100000001B3ULL;
    return sum;
}

class Packer {
 public:
    template <class Number>
    void number(Number value) {
        static_assert(std::is_arithmetic_v<Number>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void text(const std::string& text) {
        number<std::uint64_t>(text.size());
        bytes_ += text;
    }
    template <class Number>
    void numbers(const std::vector<Number>& values) {
        number<std::uint64_t>(values.size());
        for (const Number value : values) number(value);
    }
    std::string sealed() && {
        number(checksum(bytes_, bytes_.size()));
        return std::move(bytes_);
    }

 private:
    std::string bytes_;
};

/// Reads what Packer wrote; throws std::out_of_range where the bytes end too early.
class Unpacker {
 public:
    explicit Unpacker(const std::string& bytes) : bytes_(bytes) {}
    template <class Number>
    Number number() {
        Number value{};
        std::memcpy(&value, take(sizeof value), sizeof value);
        return value;
    }
    std::string text() {
        const std::size_t length = count(1);
        return {take(length), length};
    }
    template <class Number>
    std::vector<Number> numbers() {
        std::vector<Number> values(count(sizeof(Number)));
        for (Number& value : values) value = number<Number>();
        return values;
    }
    /// A number of elements of this size that can be there.
    std::size_t count(std::size_t element_size) {
        const auto claimed = number<std::uint64_t>();
        if (claimed > (bytes_.size() - position_) / element_size) throw std::out_of_range("count");
        return static_cast<std::size_t>(claimed);
    }

 private:
    const char* take(std::size_t length) {
        if (bytes_.size() - position_ < length) throw std::out_of_range("bytes");
        position_ += length;
        return bytes_.data() + position_ - length;
    }
    const std::string& bytes_;
    std::size_t position_ = 0;
};

std::string pack(const FileState& file, const VideoIndex& index) {
    Packer packer;
    packer.number(kMagic);
    packer.text(file.path);
    packer.number(file.size);
    packer.number(file.changed);
    packer.number(index.stream);
    packer.number(index.tick_numerator);
    packer.number(index.tick_denominator);
    packer.number<std::int32_t>(index.coded_size.width);
    packer.number<std::int32_t>(index.coded_size.height);
    packer.number(index.quarter_turns);
    packer.number(index.nominal_rate_hz);
    packer.text(index.codec);
    packer.text(index.container);
    packer.number<std::uint8_t>(index.created_utc_us.has_value());
    packer.number(index.created_utc_us.value_or(0));
    packer.number<std::uint64_t>(index.packets.size());
    for (const PacketRecord& packet : index.packets) {
        packer.number(packet.pts);
        packer.number(packet.dts);
        packer.number(packet.position);
        packer.number(packet.size);
        packer.number<std::uint8_t>(packet.key);
    }
    packer.numbers(index.shown);
    packer.numbers(index.shown_ticks);
    return std::move(packer).sealed();
}

/// Whether what is read with it stays within it, as with every index that was built.
bool isSound(const VideoIndex& index) {
    if (index.tick_numerator <= 0 || index.tick_denominator <= 0 || index.quarter_turns < 0 ||
        index.quarter_turns > 3 || index.shown.empty() || index.shown.size() != index.shown_ticks.size())
        return false;
    for (const std::int32_t packet : index.shown) {
        if (packet < 0 || static_cast<std::size_t>(packet) >= index.packets.size()) return false;
    }
    return std::adjacent_find(index.shown_ticks.begin(), index.shown_ticks.end(), std::greater_equal<>()) ==
           index.shown_ticks.end();
}

std::optional<VideoIndex> unpack(const std::string& bytes, const FileState& file) {
    const std::size_t seal = sizeof(std::uint64_t);
    if (bytes.size() < 2 * seal) return std::nullopt;
    std::uint64_t sum = 0;
    std::memcpy(&sum, bytes.data() + bytes.size() - seal, seal);
    if (sum != checksum(bytes, bytes.size() - seal)) return std::nullopt;

    Unpacker unpacker(bytes);
    if (unpacker.number<std::uint64_t>() != kMagic) return std::nullopt;
    FileState kept;
    kept.path = unpacker.text();
    kept.size = unpacker.number<std::uint64_t>();
    kept.changed = unpacker.number<std::int64_t>();
    if (kept != file) return std::nullopt;
    VideoIndex index;
    index.stream = unpacker.number<std::int32_t>();
    index.tick_numerator = unpacker.number<std::int64_t>();
    index.tick_denominator = unpacker.number<std::int64_t>();
    index.coded_size.width = unpacker.number<std::int32_t>();
    index.coded_size.height = unpacker.number<std::int32_t>();
    index.quarter_turns = unpacker.number<std::int32_t>();
    index.nominal_rate_hz = unpacker.number<double>();
    index.codec = unpacker.text();
    index.container = unpacker.text();
    const bool dated = unpacker.number<std::uint8_t>() != 0;
    const auto created_utc_us = unpacker.number<std::int64_t>();
    if (dated) index.created_utc_us = created_utc_us;
    constexpr std::size_t packet_size = 3 * sizeof(std::int64_t) + sizeof(std::int32_t) + 1;
    index.packets.resize(unpacker.count(packet_size));
    for (PacketRecord& packet : index.packets) {
        packet.pts = unpacker.number<std::int64_t>();
        packet.dts = unpacker.number<std::int64_t>();
        packet.position = unpacker.number<std::int64_t>();
        packet.size = unpacker.number<std::int32_t>();
        packet.key = unpacker.number<std::uint8_t>() != 0;
    }
    index.shown = unpacker.numbers<std::int32_t>();
    index.shown_ticks = unpacker.numbers<std::int64_t>();
    if (!isSound(index)) return std::nullopt;
    return index;
}

std::filesystem::path userCacheFolder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache != nullptr && *cache == '/') return std::filesystem::path(cache) / "eyrie";
    const char* home = std::getenv("HOME");
    if (home != nullptr && *home == '/') return std::filesystem::path(home) / ".cache" / "eyrie";
    return {};
}

}  // namespace

IndexCache::IndexCache(std::filesystem::path folder) : folder_(std::move(folder)) {
    if (folder_.empty()) folder_ = userCacheFolder();
}

std::filesystem::path IndexCache::recordOf(const std::filesystem::path& video) const {
    const std::string name = std::filesystem::absolute(video).lexically_normal().string();
    std::ostringstream file;
    file << std::hex << std::setw(16) << std::setfill('0') << checksum(name, name.size()) << ".index";
    return folder_ / file.str();
}

FileState stateOf(const std::filesystem::path& file) {
    FileState state{std::filesystem::absolute(file).lexically_normal().string()};
    std::error_code no_size, no_time;
    const auto size = std::filesystem::file_size(state.path, no_size);
    const auto changed = std::filesystem::last_write_time(state.path, no_time);
    if (!no_size && !no_time) {
        state.size = size;
        state.changed = changed.time_since_epoch().count();
    }
    return state;
}

std::optional<VideoIndex> IndexCache::load(const std::filesystem::path& video) const {
    if (folder_.empty()) return std::nullopt;
    try {
        std::ifstream file(recordOf(video), std::ios::binary);
        if (!file) return std::nullopt;
        const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        return unpack(bytes, stateOf(video));
    } catch (const std::exception&) {
        return std::nullopt;  // whatever is wrong with the record, indexing again puts it right
    }
}

void IndexCache::save(const FileState& video, const VideoIndex& index) const {
    if (folder_.empty()) return;
    try {
        std::filesystem::create_directories(folder_);
        writeFileAtomically(recordOf(video.path), pack(video, index));
    } catch (const std::exception&) {
        // Without a cache the video is indexed again next time.
    }
}

}  // namespace eyrie
