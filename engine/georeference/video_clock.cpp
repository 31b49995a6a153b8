#include "georeference/video_clock.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <utility>

namespace eyrie {
namespace {

constexpr std::int64_t kAgreement_us = 500'000;

/// When the video began, as each stamp says; of one part or all.
std::vector<std::int64_t> startsBy(const VideoMetadata& metadata, std::optional<int> part) {
    std::vector<std::int64_t> starts;
    const std::vector<MetadataPacket>& packets = metadata.stream().packets;
    for (std::size_t i = 0; i < packets.size(); ++i) {
        const auto shown = metadata.timeline().timeOf(i);
        const auto& utc = packets[i].utc_us;
        const bool asked = !part || packets[i].part == *part;
        if (asked && shown && utc && *utc > 0) starts.push_back(*utc - *shown);
    }
    return starts;
}

}  // namespace

VideoClock VideoClock::startingAt(std::int64_t utc_us) {
    VideoClock clock;
    clock.source_ = Source::given;
    clock.stretches_ = {{0, utc_us}};
    return clock;
}

std::optional<VideoClock::Stretch> VideoClock::stretchBy(const VideoMetadata& metadata, std::int64_t from_us,
                                                         std::optional<int> part, int& odd_stamps) {
    std::vector<std::int64_t> starts = startsBy(metadata, part);
    if (starts.empty()) return std::nullopt;
    std::nth_element(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(starts.size() / 2), starts.end());
    const std::int64_t median = starts[starts.size() / 2];
    const auto odd = std::count_if(starts.begin(), starts.end(),
                                   [&](std::int64_t start) { return std::abs(start - median) > kAgreement_us; });
    if (odd * 10 > static_cast<std::ptrdiff_t>(starts.size())) return Stretch{from_us, std::nullopt};
    odd_stamps += static_cast<int>(odd);
    return Stretch{from_us, median};
}

VideoClock VideoClock::byMetadata(std::shared_ptr<const VideoMetadata> metadata) {
    VideoClock clock;
    if (!metadata) return clock;
    const auto stretch = stretchBy(*metadata, 0, std::nullopt, clock.odd_stamps_);
    if (!stretch) return clock;
    clock.source_ = Source::metadata;
    clock.stretches_ = {*stretch};
    if (!stretch->start_us) clock.metadata_ = std::move(metadata);
    return clock;
}

VideoClock VideoClock::ofParts(const std::vector<VideoPart>& parts, std::shared_ptr<const VideoMetadata> metadata,
                               std::optional<std::int64_t> given_us) {
    if (parts.empty()) return given_us ? startingAt(*given_us) : byMetadata(std::move(metadata));
    VideoClock clock;
    std::optional<std::int64_t> known;  // start of the stretch before
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::int64_t from_us = parts[i].first_time_us;
        std::optional<Stretch> stretch;
        if (parts[i].start_utc_us) {
            stretch = Stretch{from_us, *parts[i].start_utc_us - parts[i].first_time_us};
            ++clock.listed_parts_;
        } else if (metadata) {
            stretch = stretchBy(*metadata, from_us, static_cast<int>(i), clock.odd_stamps_);
            clock.stamped_parts_ += stretch ? 1 : 0;
        }
        if (!stretch) {
            ++clock.silent_parts_;
            if (!known) continue;
            stretch = Stretch{from_us, known};
        }
        if (stretch->start_us)
            known = stretch->start_us;
        else
            clock.metadata_ = metadata;
        clock.stretches_.push_back(*stretch);
    }
    if (given_us) return begunAt(std::move(clock), *given_us);
    if (clock.stretches_.empty()) return {};
    clock.source_ = clock.listed_parts_ > 0 ? Source::given : Source::metadata;
    return clock;
}

VideoClock VideoClock::begunAt(VideoClock clock, std::int64_t given_us) {
    const bool steady = !clock.metadata_ && !clock.stretches_.empty();
    if (!steady) return startingAt(given_us);
    const std::int64_t move = given_us - *clock.stretches_.front().start_us;
    for (Stretch& stretch : clock.stretches_) *stretch.start_us += move;
    clock.source_ = Source::given;
    clock.listed_parts_ = 0;
    return clock;
}

VideoClock VideoClock::byFiles(const FoundMetadata& found) {
    VideoClock clock;
    std::optional<std::int64_t> known = found.parts.empty() ? found.created_utc_us : std::nullopt;
    if (known) clock.stretches_.push_back({0, known});
    for (const VideoPart& part : found.parts) {
        // Files tell it to the second, and recorders that cut a flight into files give all of them one time.
        constexpr std::int64_t kGap_us = 1'000'000;
        if (part.created_utc_us && (!known || *part.created_utc_us > *known + part.first_time_us + kGap_us))
            known = *part.created_utc_us - part.first_time_us;
        clock.silent_parts_ += part.created_utc_us ? 0 : 1;
        if (known) clock.stretches_.push_back({part.first_time_us, known});
    }
    if (clock.stretches_.empty()) return {};
    clock.source_ = Source::file;
    return clock;
}

VideoClock VideoClock::of(const FoundMetadata& found, std::optional<std::int64_t> given_us) {
    if (given_us && found.parts.empty()) return startingAt(*given_us);
    VideoClock clock = ofParts(found.parts, found.metadata, std::nullopt);
    if (clock.source_ == Source::none) clock = byFiles(found);
    return given_us ? begunAt(std::move(clock), *given_us) : clock;
}

std::optional<std::int64_t> VideoClock::at(std::int64_t video_us) const {
    if (stretches_.empty()) return std::nullopt;
    const auto next = std::upper_bound(stretches_.begin(), stretches_.end(), video_us,
                                       [](std::int64_t time, const Stretch& one) { return time < one.from_us; });
    const Stretch& stretch = next == stretches_.begin() ? *next : *std::prev(next);
    if (stretch.start_us) return *stretch.start_us + video_us;
    return metadata_->timeline().at(video_us).utc_us;
}

std::string VideoClock::origin() const {
    std::string text;
    switch (source_) {
        case Source::given:
            text = listed_parts_ == 0 ? "the start time given" : "the start times in the list of parts";
            break;
        case Source::metadata:
            text = "the video's metadata";
            break;
        case Source::file:
            text = stretches_.size() > 1 ? "the files' creation times" : "the file's creation time";
            break;
        case Source::none:
            return "";
    }
    if (listed_parts_ > 0 && stamped_parts_ > 0) text += " and the video's metadata";
    if (metadata_)
        text += ", whose clock is not steady: times may jump";
    else if (odd_stamps_ > 0)
        text += ", without " + std::to_string(odd_stamps_) +
                (odd_stamps_ == 1 ? " stamp that disagrees" : " stamps that disagree");
    if (silent_parts_ > 0)
        text += "; " + std::to_string(silent_parts_) +
                (silent_parts_ == 1 ? " part with no known start follows" : " parts with no known start follow") +
                " without a gap";
    return text;
}

}  // namespace eyrie
