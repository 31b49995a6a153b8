#include "core/state_archive.h"

namespace eyrie {
namespace {

constexpr std::uint64_t kStart = 0xcbf29ce484222325ULL;

/// FNV-1a in steps of eight bytes.
std::uint64_t mixed(std::uint64_t hash, const char* bytes, std::size_t count) {
    constexpr std::uint64_t kPrime = 0x100000001b3ULL;
    const auto mix = [&](std::uint64_t word) {
        hash = (hash ^ word) * kPrime;
        hash ^= hash >> 32;
    };
    for (; count >= sizeof(std::uint64_t); bytes += sizeof(std::uint64_t), count -= sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes, sizeof word);
        mix(word);
    }
    std::uint64_t rest = count;
    for (std::size_t i = 0; i < count; ++i) rest = rest << 8 | static_cast<unsigned char>(bytes[i]);
    mix(rest);
    return hash;
}

}  // namespace

std::uint64_t checksumOf(std::string_view bytes) {
    return mixed(kStart, bytes.data(), bytes.size());
}

std::uint64_t checksumOf(const cv::Mat& gray) {
    std::uint64_t hash = kStart;
    for (int row = 0; row < gray.rows; ++row) hash = mixed(hash, gray.ptr<char>(row), std::size_t(gray.cols));
    return hash;
}

std::size_t StateWriter::count(std::size_t items, std::size_t /*item_bytes*/) {
    const auto number = static_cast<std::uint64_t>(items);
    numbers(&number, 1);
    return items;
}

cv::Mat StateWriter::picture(FrameIndex& frame, const cv::Mat& gray) {
    numbers(&frame, 1);
    pictures_.emplace(frame, gray);
    return gray;
}

std::string StateWriter::bytes() const {
    std::map<FrameIndex, std::uint64_t> sums;
    for (const auto& [frame, gray] : pictures_) sums[frame] = checksumOf(gray);
    StateWriter whole;
    whole(sums);
    whole.bytes_ += bytes_;
    return std::move(whole.bytes_);
}

StateReader::StateReader(std::string_view bytes, PictureSource pictures) : bytes_(bytes), source_(std::move(pictures)) {
    (*this)(known_);
}

std::size_t StateReader::count(std::size_t /*ignored*/, std::size_t item_bytes) {
    std::uint64_t items = 0;
    numbers(&items, 1);
    requireLeft(static_cast<std::size_t>(items), item_bytes);
    return static_cast<std::size_t>(items);
}

void StateReader::requireLeft(std::size_t items, std::size_t item_bytes) const {
    if (item_bytes > 0 && items > bytes_.size() / item_bytes) throw DamagedState{"it ends too early"};
}

void StateReader::readPictures() {
    // In the order of the video, which is read far faster than in any other.
    for (const auto& [frame, sum] : known_) {
        const cv::Mat gray = source_(frame);
        if (checksumOf(gray) != sum) throw ChangedPicture{frame};
        pictures_[frame] = gray;
    }
}

cv::Mat StateReader::picture(FrameIndex& frame, const cv::Mat& /*ignored*/) {
    numbers(&frame, 1);
    if (pictures_.empty()) readPictures();
    const auto found = pictures_.find(frame);
    require(found != pictures_.end(), "a picture that is not in the list");
    return found->second;
}

void StateReader::end() const {
    require(bytes_.empty(), "there is more than there should be");
}

}  // namespace eyrie
