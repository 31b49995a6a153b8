#include "georeference/video_clock.h"

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

namespace eyrie {
namespace {

constexpr std::int64_t kAgreement_us = 500'000;

}  // namespace

VideoClock VideoClock::startingAt(std::int64_t utc_us) {
    VideoClock clock;
    clock.source_ = Source::given;
    clock.start_us_ = utc_us;
    return clock;
}

VideoClock VideoClock::byMetadata(std::shared_ptr<const VideoMetadata> metadata) {
    VideoClock clock;
    if (!metadata) return clock;
    // Stamps may be any 64 bits: differences are taken of what a calendar can hold.
    constexpr std::int64_t kFarthest_us = 253'402'300'800LL * 1'000'000;
    std::vector<std::int64_t> starts;
    const std::vector<MetadataPacket>& packets = metadata->stream().packets;
    for (std::size_t i = 0; i < packets.size(); ++i) {
        const auto shown = metadata->timeline().timeOf(i);
        const auto& utc = packets[i].utc_us;
        if (shown && utc && *utc > 0 && *utc < kFarthest_us) starts.push_back(*utc - *shown);
    }
    if (starts.empty()) return clock;
    clock.source_ = Source::metadata;
    std::nth_element(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(starts.size() / 2), starts.end());
    const std::int64_t median = starts[starts.size() / 2];
    const auto odd = std::count_if(starts.begin(), starts.end(),
                                   [&](std::int64_t start) { return std::abs(start - median) > kAgreement_us; });
    if (odd * 10 <= static_cast<std::ptrdiff_t>(starts.size())) {
        clock.start_us_ = median;
        clock.odd_stamps_ = static_cast<int>(odd);
    } else {
        clock.metadata_ = std::move(metadata);
    }
    return clock;
}

std::optional<std::int64_t> VideoClock::at(std::int64_t video_us) const {
    if (start_us_) return *start_us_ + video_us;
    if (metadata_) return metadata_->timeline().at(video_us).utc_us;
    return std::nullopt;
}

std::string VideoClock::origin() const {
    switch (source_) {
        case Source::given:
            return "the start time given";
        case Source::metadata:
            if (metadata_) return "the video's metadata, whose clock is not steady: times may jump";
            if (odd_stamps_ > 0)
                return "the video's metadata, without " + std::to_string(odd_stamps_) +
                       (odd_stamps_ == 1 ? " stamp that disagrees" : " stamps that disagree");
            return "the video's metadata";
        case Source::none:
            break;
    }
    return "";
}

}  // namespace eyrie
