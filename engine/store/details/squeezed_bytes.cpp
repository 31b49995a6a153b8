#include "store/details/squeezed_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "core/error.h"

namespace eyrie {
namespace {

constexpr std::byte kDeflated{1};
constexpr std::size_t kSqueezedHeader = 6;
constexpr int kQuick = 1;  ///< zlib's level: a run does this for every frame
constexpr std::size_t kBoxBytes = 7 * sizeof(double);
constexpr std::size_t kBareBoxBytes = 5 * sizeof(double);  ///< before decisions were known
constexpr std::size_t kBytesOfVector = 28;                 ///< as packMotionVectors() lays them

/// Byte i of every record behind byte i − 1 of every record; the other way round with `back`.
Bytes shuffled(ByteView bytes, std::size_t stride, bool back) {
    Bytes moved(bytes.size());
    const std::size_t records = bytes.size() / stride;
    std::size_t at = 0;
    for (std::size_t place = 0; place < stride; ++place) {
        for (std::size_t record = 0; record < records; ++record, ++at) {
            const std::size_t in_record = record * stride + place;
            moved[back ? in_record : at] = bytes[back ? at : in_record];
        }
    }
    return moved;
}

/// Whether these were squeezed as records of so many bytes.
bool haveStride(ByteView bytes, std::size_t stride) {
    return bytes.size() >= kSqueezedHeader && static_cast<std::size_t>(bytes[kSqueezedHeader - 1]) == stride;
}

const Bytef* asZlib(const std::byte* bytes) {
    return reinterpret_cast<const Bytef*>(bytes);
}

}  // namespace

Bytes squeezed(ByteView bytes, std::size_t stride) {
    const Bytes together = shuffled(bytes, stride, false);
    uLongf size = compressBound(static_cast<uLong>(together.size()));
    Bytes packed(kSqueezedHeader + size);
    packed[0] = kDeflated;
    const auto raw = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(packed.data() + 1, &raw, sizeof raw);
    packed[5] = static_cast<std::byte>(stride);
    const int done = compress2(reinterpret_cast<Bytef*>(packed.data() + kSqueezedHeader), &size,
                               asZlib(together.data()), static_cast<uLong>(together.size()), kQuick);
    if (done != Z_OK)
        throw Error(ErrorKind::internal, std::string("the details of a frame cannot be squeezed (") + zError(done) +
                                             "); the memory may be used up: close other programs");
    packed.resize(kSqueezedHeader + size);
    return packed;
}

std::optional<Bytes> unsqueezed(ByteView bytes, std::size_t most) {
    if (bytes.size() < kSqueezedHeader || bytes[0] != kDeflated) return std::nullopt;
    std::uint32_t raw = 0;
    std::memcpy(&raw, bytes.data() + 1, sizeof raw);
    const auto stride = static_cast<std::size_t>(bytes[5]);
    // Deflate shrinks by no more than a thousand and some.
    constexpr std::size_t kMostShrinking = 1100;
    if (stride == 0 || raw % stride != 0 || raw > most || raw > bytes.size() * kMostShrinking) return std::nullopt;
    Bytes together(raw);
    Bytef none = 0;
    uLongf size = raw;
    const int done =
        uncompress(raw > 0 ? reinterpret_cast<Bytef*>(together.data()) : &none, &size,
                   asZlib(bytes.data() + kSqueezedHeader), static_cast<uLong>(bytes.size() - kSqueezedHeader));
    if (done != Z_OK || size != raw) return std::nullopt;
    return shuffled(together, stride, true);
}

Bytes squeezeMotionVectors(std::span<const MotionVector> vectors) {
    return squeezed(packMotionVectors(vectors), kBytesOfVector);
}

std::optional<std::vector<MotionVector>> unsqueezeMotionVectors(ByteView bytes) {
    const auto raw = haveStride(bytes, kBytesOfVector) ? unsqueezed(bytes) : std::nullopt;
    return raw ? unpackMotionVectors(*raw) : std::nullopt;
}

Bytes squeezeBoxes(std::span<const ClassifiedBox> boxes) {
    std::vector<double> numbers;
    numbers.reserve(boxes.size() * 7);
    for (const auto& [box, whole, decision] : boxes) {
        numbers.insert(numbers.end(),
                       {box.centre.x, box.centre.y, box.length, box.width, box.heading, whole ? 1.0 : 0.0, decision});
    }
    return squeezed(std::as_bytes(std::span(numbers)), kBoxBytes);
}

std::optional<std::vector<ClassifiedBox>> unsqueezeBoxes(ByteView bytes) {
    const bool bare = haveStride(bytes, kBareBoxBytes);
    const auto raw = bare || haveStride(bytes, kBoxBytes) ? unsqueezed(bytes) : std::nullopt;
    if (!raw) return std::nullopt;
    std::vector<ClassifiedBox> boxes(raw->size() / (bare ? kBareBoxBytes : kBoxBytes));
    const std::byte* at = raw->data();
    const auto read = [&at](double& number) {
        std::memcpy(&number, at, sizeof number);
        at += sizeof number;
    };
    for (auto& [box, whole, decision] : boxes) {
        for (double* number : {&box.centre.x, &box.centre.y, &box.length, &box.width, &box.heading}) read(*number);
        double found_whole = 1;
        if (!bare) {
            read(found_whole);
            read(decision);
        }
        whole = found_whole != 0;
    }
    return boxes;
}

}  // namespace eyrie
