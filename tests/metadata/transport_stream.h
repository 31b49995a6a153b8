#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>

#include "support/klv_writer.h"

namespace eyrie::test {

/// A transport stream of one program that carries nothing but KLV, in one track or asynchronously in two, written byte
/// by byte after ISO/IEC 13818-1.
class TransportStreamWriter {
 public:
    enum class Carriage { asynchronous, synchronous };

    explicit TransportStreamWriter(Carriage carriage, int tracks = 1) : carriage_(carriage) {
        section(0x0000, bytesOfHex("00b00d0001c100000001e100"));
        // PMT: clock and stream on PID 0x101; descriptors say KLVA. A second track is on PID 0x102.
        if (tracks == 2) {
            section(0x0100, bytesOfHex("02b0230001c10000e101f00006e101f00605044b4c564106e102f00605044b4c5641"));
        } else if (carriage == Carriage::asynchronous) {
            section(0x0100, bytesOfHex("02b0180001c10000e101f00006e101f00605044b4c5641"));
        } else {
            section(0x0100, bytesOfHex("02b01d0001c10000e101f00015e101f00b26090100ff4b4c5641000f"));
        }
    }

    /// One set in one PES packet; a synchronous one gets the header of its cell.
    void set(const KlvBytes& klv, std::int64_t stamp_90khz, unsigned pid = 0x0101) {
        KlvBytes payload;
        if (carriage_ == Carriage::synchronous) {
            payload = {0x00, static_cast<std::uint8_t>(sequence_++), 0xDF};
            append(payload, bigEndian(klv.size(), 2));
        }
        append(payload, klv);
        KlvBytes pes = bytesOfHex(carriage_ == Carriage::synchronous ? "000001fc" : "000001bd");
        append(pes, bigEndian(payload.size() + 8, 2));
        append(pes, {0x84, 0x80, 0x05});
        const auto pts = static_cast<std::uint64_t>(stamp_90khz);
        append(pes, {static_cast<std::uint8_t>(0x21 | ((pts >> 29) & 0x0E))});
        append(pes, bigEndian((((pts >> 15) & 0x7FFF) << 1) | 1, 2));
        append(pes, bigEndian(((pts & 0x7FFF) << 1) | 1, 2));
        append(pes, payload);
        packets(pid, pes);
    }

    void save(const std::filesystem::path& path) const {
        std::ofstream file(path, std::ios::binary);
        for (const std::uint8_t byte : bytes_) file.put(static_cast<char>(byte));
    }

 private:
    void section(unsigned pid, KlvBytes table) {
        std::uint32_t crc = 0xFFFFFFFF;
        for (const std::uint8_t byte : table) {
            crc ^= static_cast<std::uint32_t>(byte) << 24;
            for (int bit = 0; bit < 8; ++bit) crc = (crc << 1) ^ ((crc & 0x80000000U) != 0 ? 0x04C11DB7U : 0U);
        }
        append(table, bigEndian(crc, 4));
        KlvBytes packet{0x47, static_cast<std::uint8_t>(0x40 | (pid >> 8)), static_cast<std::uint8_t>(pid), 0x10, 0x00};
        append(packet, table);
        packet.resize(188, 0xFF);
        append(bytes_, packet);
    }

    void packets(unsigned pid, const KlvBytes& pes) {
        for (std::size_t at = 0; at < pes.size();) {
            const std::size_t count = std::min<std::size_t>(184, pes.size() - at);
            KlvBytes packet{0x47, static_cast<std::uint8_t>((at == 0 ? 0x40 : 0x00) | (pid >> 8)),
                            static_cast<std::uint8_t>(pid)};
            const std::size_t stuffing = 184 - count;
            packet.push_back(static_cast<std::uint8_t>((stuffing > 0 ? 0x30 : 0x10) | (counters_[pid]++ & 0x0F)));
            if (stuffing > 0) packet.push_back(static_cast<std::uint8_t>(stuffing - 1));
            if (stuffing > 1) {
                packet.push_back(0x00);
                packet.resize(packet.size() + stuffing - 2, 0xFF);
            }
            packet.insert(packet.end(), pes.begin() + static_cast<std::ptrdiff_t>(at),
                          pes.begin() + static_cast<std::ptrdiff_t>(at + count));
            append(bytes_, packet);
            at += count;
        }
    }

    Carriage carriage_;
    KlvBytes bytes_;
    unsigned sequence_ = 0;
    std::map<unsigned, unsigned> counters_;  ///< of packets, by PID
};

}  // namespace eyrie::test
