#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "io/video/data_streams.h"
#include "metadata/metadata_packet.h"

namespace eyrie {

/// What a stream says of one tag.
struct TagSummary {
    int packets = 0;                 ///< sets that hold it
    int unreadable = 0;              ///< of these, sets that say "no value" or whose length is wrong
    double least = 0, greatest = 0;  ///< of the numbers, where `has_numbers`
    bool has_numbers = false;
    std::string text;  ///< the first, where it is text
    bool text_changes = false;
};

/// Where in a video something of its metadata is.
struct MetadataPlace {
    int pictures_before = 0;  ///< as of DataPacket: about the number of the frame that is shown then
};

/// One stream of metadata.
struct MetadataStream {
    DataStream track;                     ///< number -1 for a file that is nothing but metadata
    std::vector<MetadataPacket> packets;  ///< in file order
    std::map<int, TagSummary> tags;       ///< 0 stands for items that no standard knows
    klv::FaultCounts faults{};
    std::optional<MetadataPlace> first_damage;  ///< where it was noticed; nothing in files without pictures, too
    int local_sets = 0, universal_sets = 0;
    std::map<std::string, int> other_sets;  ///< key in hexadecimal digits, or "others": sets not read
    int without_checksum = 0;               ///< local sets that state none; they are believed
    int without_time = 0;
    int without_stamp = 0;                    ///< of the container: asynchronous carriage
    int steps_back = 0;                       ///< clock of the sets goes back
    int leaps = 0;                            ///< clock of the sets goes on by more than 10 s at once
    std::optional<MetadataPlace> first_jump;  ///< of the clock, back or ahead; as above

    int damaged() const;
    /// Sets of moving targets (VMTI) among the others.
    int targetSets() const;
    /// Sets that hold a place on the ground or what is needed to find one.
    int places() const;
};

/// The metadata of a file.
struct MetadataRecording {
    std::vector<MetadataStream> streams;     ///< those that hold KLV, or are said to
    std::vector<DataStream> foreign_tracks;  ///< data that is no KLV
    /// The stream to use where nobody chose: most places, then most packets; -1 where there is none.
    int mostUseful() const;
};

/// Takes the packets of one stream one by one.
class MetadataCollector {
 public:
    /// `part` is the number of the file that comes first, of a video in parts.
    explicit MetadataCollector(const DataStream& track, int part = 0) {
        stream_.track = track;
        carriage_.part = part;
    }
    void feed(const DataPacket& packet);
    /// The same of a file that is nothing but metadata, of which a piece may end anywhere.
    void feedPiece(const DataPacket& piece);
    /// What comes next is another file: no set goes on in it, and its clock is its own.
    void endOfPart();
    MetadataStream finish();

 private:
    void carry(const DataPacket& packet);
    std::optional<klv::Fault> take(const klv::Set& set);
    /// Takes down where the first damage is.
    void noteDamage();
    /// Where the packet came that is read.
    std::optional<MetadataPlace> here() const;

    MetadataStream stream_;
    klv::Splitter splitter_;
    MetadataPacket carriage_;  ///< where and when the packet came that is read
    std::optional<std::int64_t> last_utc_us_;
};

/// Reads all metadata of a video file or of a file that is nothing but KLV. What is damaged is skipped and counted; a
/// file without metadata has no streams. Throws Error(input) for what is neither, and when `stop` was requested.
MetadataRecording readMetadata(const std::filesystem::path& path, const IndexProgress& progress = {},
                               const std::stop_token& stop = {});

/// The same of a video; of one in parts (VideoInfo::parts) those of all its files, as if they were one: a track of the
/// same number is the same stream, stamps are on the clock of the whole (PictureStamp).
MetadataRecording readMetadata(const VideoInfo& video, const IndexProgress& progress = {},
                               const std::stop_token& stop = {});

/// Whether a file is KLV and nothing else.
bool isRawKlv(const std::filesystem::path& path);

}  // namespace eyrie
