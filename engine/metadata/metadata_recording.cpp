#include "metadata/metadata_recording.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <numeric>

#include "core/error.h"
#include "io/atomic_file.h"
#include "metadata/vmti/vmti_set.h"

namespace eyrie {
namespace {

constexpr std::size_t kMostOtherSets = 1000;  ///< kinds that are told apart
constexpr const char* kFurtherSets = "others";

constexpr std::int64_t kLeap = 10'000'000;  ///< µs
constexpr std::size_t kChunk = 1U << 16;
constexpr std::array<std::uint8_t, 4> kKeyBegin{0x06, 0x0E, 0x2B, 0x34};
/// A key is looked for in so many bytes of tracks that do not say what they hold.
constexpr std::size_t kProbe = 64;

bool holdsKey(klv::Bytes bytes) {
    const klv::Bytes begin = bytes.first(std::min(bytes.size(), kProbe));
    return std::search(begin.begin(), begin.end(), kKeyBegin.begin(), kKeyBegin.end()) != begin.end();
}

std::string hexText(klv::Bytes bytes) {
    std::string text;
    char digits[3];
    for (const std::uint8_t byte : bytes) {
        std::snprintf(digits, sizeof digits, "%02x", byte);
        text += digits;
    }
    return text;
}

MetadataRecording readRaw(const std::filesystem::path& path, const IndexProgress& progress,
                          const std::stop_token& stop) {
    std::ifstream file(path, std::ios::binary);
    const double size = static_cast<double>(std::max<std::uintmax_t>(1, std::filesystem::file_size(path)));
    MetadataCollector collector(DataStream{-1, 0, "klv"});
    std::vector<char> chunk(kChunk);
    std::int64_t position = 0;
    while (file.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || file.gcount() > 0) {
        if (stop.stop_requested())
            throw Error(ErrorKind::input, path.string() + ": stopped while reading its metadata");
        const auto count = static_cast<std::size_t>(file.gcount());
        const std::vector<std::uint8_t> bytes(chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(count));
        collector.feedPiece({-1, kNoStamp, position, 0, bytes});
        position += file.gcount();
        if (progress) progress(static_cast<double>(position) / size);
    }
    MetadataRecording recording;
    recording.streams.push_back(collector.finish());
    return recording;
}

/// The data tracks of the files of a video, one file after the other.
class TrackReading {
 public:
    /// Of a video in one file the part is that file.
    void read(const VideoPart& part, const IndexProgress& progress, const std::stop_token& stop) {
        const auto found = readDataStreams(
            part.file,
            [&](DataPacket packet) {
                auto known = collectors_.find(packet.stream);
                if (known == collectors_.end() && holdsKey(packet.bytes))
                    known = collectors_.try_emplace(packet.stream, DataStream{packet.stream, 0, ""}, part_).first;
                if (known == collectors_.end()) return;
                packet.pictures_before += part.first_picture;
                packet.stamp_us = shiftedStamp(packet.stamp_us, part.stamp_shift_us);
                known->second.feed(packet);
            },
            progress, stop);
        for (auto& [number, collector] : collectors_) collector.endOfPart();
        ++part_;
        for (const DataStream& track : found) tracks_.try_emplace(track.number, track);
    }

    MetadataRecording finish() {
        MetadataRecording recording;
        for (const auto& [number, track] : tracks_) {
            const auto known = collectors_.find(number);
            if (known != collectors_.end()) {
                recording.streams.push_back(known->second.finish());
                recording.streams.back().track = track;
            } else if (track.codec == "klv") {
                recording.streams.emplace_back().track = track;
            } else {
                recording.foreign_tracks.push_back(track);
            }
        }
        return recording;
    }

 private:
    std::map<int, MetadataCollector> collectors_;  ///< by number of the track
    std::map<int, DataStream> tracks_;
    int part_ = 0;
};

}  // namespace

int MetadataStream::damaged() const {
    return std::accumulate(faults.begin(), faults.end(), 0);
}

int MetadataStream::targetSets() const {
    const auto found = other_sets.find(hexText(vmti::kKey));
    return found == other_sets.end() ? 0 : found->second;
}

int MetadataStream::places() const {
    int places = 0;
    for (const int number : {tag::kCentreLatitude, tag::kCorners, tag::kCornerOffsets, tag::kSensorLatitude,
                             tag::kHorizontalView, tag::kTargetWidth, tag::kSlantRange}) {
        const auto found = tags.find(number);
        if (found != tags.end()) places += found->second.packets - found->second.unreadable;
    }
    return places;
}

int MetadataRecording::mostUseful() const {
    const auto best = std::max_element(streams.begin(), streams.end(), [](const auto& a, const auto& b) {
        return std::pair(a.places(), a.packets.size()) < std::pair(b.places(), b.packets.size());
    });
    return best == streams.end() || best->packets.empty() ? -1 : static_cast<int>(best - streams.begin());
}

void MetadataCollector::carry(const DataPacket& packet) {
    carriage_.stamp_us = packet.stamp_us;
    carriage_.position = packet.position;
    carriage_.pictures_before = packet.pictures_before;
}

void MetadataCollector::feed(const DataPacket& packet) {
    carry(packet);
    splitter_.feed(packet.bytes, [this](const klv::Set& set) { return take(set); });
    noteDamage();
}

void MetadataCollector::feedPiece(const DataPacket& piece) {
    carry(piece);
    splitter_.feedPiece(piece.bytes, [this](const klv::Set& set) { return take(set); });
    noteDamage();
}

std::optional<MetadataPlace> MetadataCollector::here() const {
    if (stream_.track.number < 0) return std::nullopt;
    return MetadataPlace{carriage_.pictures_before};
}

void MetadataCollector::noteDamage() {
    const klv::FaultCounts& faults = splitter_.faults();
    const bool any = std::any_of(faults.begin(), faults.end(), [](int count) { return count > 0; });
    if (any && !stream_.first_damage) stream_.first_damage = here();
}

std::optional<klv::Fault> MetadataCollector::take(const klv::Set& set) {
    if (kindOf(set.key) == SetKind::other) {
        const std::string key = hexText(set.key);
        const bool listed = stream_.other_sets.size() < kMostOtherSets || stream_.other_sets.contains(key);
        ++stream_.other_sets[listed ? key : std::string(kFurtherSets)];
        return std::nullopt;
    }
    MetadataPacket packet = carriage_;
    SetRemarks remarks;
    if (const auto fault = readSet(set, packet, remarks)) return fault;
    ++(packet.kind == SetKind::local ? stream_.local_sets : stream_.universal_sets);
    if (packet.kind == SetKind::local && !packet.has_checksum) ++stream_.without_checksum;
    if (packet.stamp_us == kNoStamp) ++stream_.without_stamp;
    if (packet.utc_us) {
        const bool back = last_utc_us_ && *packet.utc_us < *last_utc_us_;
        const bool leap = last_utc_us_ && *packet.utc_us > *last_utc_us_ + kLeap;
        stream_.steps_back += back ? 1 : 0;
        stream_.leaps += leap ? 1 : 0;
        if ((back || leap) && !stream_.first_jump) stream_.first_jump = here();
        last_utc_us_ = packet.utc_us;
    } else {
        ++stream_.without_time;
    }
    std::sort(remarks.tags.begin(), remarks.tags.end());
    remarks.tags.erase(std::unique(remarks.tags.begin(), remarks.tags.end()), remarks.tags.end());
    for (const int number : remarks.tags) ++stream_.tags[number].packets;
    for (const int number : remarks.unreadable) ++stream_.tags[number].unreadable;
    for (const auto& [number, value] : packet.numbers) {
        TagSummary& summary = stream_.tags[number];
        summary.least = summary.has_numbers ? std::min(summary.least, value) : value;
        summary.greatest = summary.has_numbers ? std::max(summary.greatest, value) : value;
        summary.has_numbers = true;
    }
    for (const auto& [number, text] : packet.texts) {
        TagSummary& summary = stream_.tags[number];
        if (summary.text.empty()) summary.text = text;
        summary.text_changes = summary.text_changes || summary.text != text;
    }
    stream_.packets.push_back(std::move(packet));
    return std::nullopt;
}

void MetadataCollector::endOfPart() {
    splitter_.finish([this](const klv::Set& set) { return take(set); });
    noteDamage();
    last_utc_us_.reset();
    ++carriage_.part;
}

MetadataStream MetadataCollector::finish() {
    endOfPart();
    stream_.faults = splitter_.faults();
    return std::move(stream_);
}

bool isRawKlv(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::array<char, kKeyBegin.size()> begin{};
    file.read(begin.data(), begin.size());
    return file.gcount() == static_cast<std::streamsize>(begin.size()) &&
           std::equal(begin.begin(), begin.end(), kKeyBegin.begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

MetadataRecording readMetadata(const std::filesystem::path& path, const IndexProgress& progress,
                               const std::stop_token& stop) {
    checkReadableFile(path);
    if (isRawKlv(path)) return readRaw(path, progress, stop);
    VideoPart whole;
    whole.file = path;
    TrackReading reading;
    reading.read(whole, progress, stop);
    return reading.finish();
}

MetadataRecording readMetadata(const VideoInfo& video, const IndexProgress& progress, const std::stop_token& stop) {
    if (video.parts.empty()) return readMetadata(video.path, progress, stop);
    TrackReading reading;
    for (std::size_t i = 0; i < video.parts.size(); ++i) {
        const auto share = [&](double of_part) {
            if (progress) progress((static_cast<double>(i) + of_part) / static_cast<double>(video.parts.size()));
        };
        reading.read(video.parts[i], share, stop);
    }
    return reading.finish();
}

}  // namespace eyrie
