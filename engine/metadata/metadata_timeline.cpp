#include "metadata/metadata_timeline.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>

namespace eyrie {
namespace {

/// Pictures about a set, in the file, among which its stamp is looked for: multiplexers put a set within some seconds.
constexpr std::ptrdiff_t kPicturesAbout = 240;
/// µs between a stamp and the nearest picture; more is another clock.
constexpr std::int64_t kFarthestPicture = 2'000'000;
/// µs by which two clocks may differ in pace between two sets; more is a jump.
constexpr std::int64_t kClockSlack = 500'000;

std::int64_t microsecondsOf(double seconds) {
    return static_cast<std::int64_t>(std::llround(seconds * 1e6));
}

/// The time of the moment that a stamp names, from the picture whose stamp is nearest.
std::optional<std::int64_t> timeOfStamp(const std::vector<PictureStamp>& pictures, const MetadataPacket& packet) {
    if (packet.stamp_us == kNoStamp) return std::nullopt;
    const auto count = std::ssize(pictures);
    const std::ptrdiff_t middle = std::clamp<std::ptrdiff_t>(packet.pictures_before, 0, count);
    const PictureStamp* nearest = nullptr;
    std::int64_t least = kFarthestPicture + 1;
    for (auto i = std::max<std::ptrdiff_t>(0, middle - kPicturesAbout); i < std::min(count, middle + kPicturesAbout);
         ++i) {
        const PictureStamp& picture = pictures[static_cast<std::size_t>(i)];
        if (picture.stamp_us == kNoStamp || picture.time_us == kNoStamp) continue;
        const double distance = std::abs(static_cast<double>(picture.stamp_us) - static_cast<double>(packet.stamp_us));
        if (distance >= static_cast<double>(least)) continue;
        least = static_cast<std::int64_t>(distance);
        nearest = &picture;
    }
    if (nearest == nullptr) return std::nullopt;
    return nearest->time_us + (packet.stamp_us - nearest->stamp_us);
}

/// The time of the picture that a set lies behind in the file; at the beginning of the next one.
std::optional<std::int64_t> timeOfNeighbour(const std::vector<PictureStamp>& pictures, const MetadataPacket& packet) {
    const auto count = std::ssize(pictures);
    const std::ptrdiff_t middle = std::clamp<std::ptrdiff_t>(packet.pictures_before, 0, count);
    for (std::ptrdiff_t i = middle - 1; i >= std::max<std::ptrdiff_t>(0, middle - kPicturesAbout); --i) {
        const std::int64_t time = pictures[static_cast<std::size_t>(i)].time_us;
        if (time != kNoStamp) return time;
    }
    for (std::ptrdiff_t i = middle; i < std::min(count, middle + kPicturesAbout); ++i) {
        const std::int64_t time = pictures[static_cast<std::size_t>(i)].time_us;
        if (time != kNoStamp) return time;
    }
    return std::nullopt;
}

/// A value of the sets before and after a moment.
struct Sides {
    std::optional<std::int64_t> before_us, after_us;
    double before = 0, after = 0;
};

double blended(const TagInfo* info, double before, double after, double share) {
    const Blend blend = info != nullptr ? info->blend : Blend::none;
    switch (blend) {
        case Blend::none:
            return before;
        case Blend::linear:
            return before + share * (after - before);
        case Blend::circle:
            break;
    }
    const double value = before + share * std::remainder(after - before, 360.0);
    const bool is_full_circle = info->low == 0 && info->high == 360;
    if (!is_full_circle) return value >= -180 && value <= 180 ? value : std::remainder(value, 360.0);
    return value < 0 ? value + 360 : value > 360 ? value - 360 : value;
}

std::optional<double> valueAt(const TagInfo* info, const Sides& sides, std::int64_t time_us,
                              const TimelineOptions& options) {
    const std::int64_t hold = microsecondsOf(options.longest_hold_s);
    const std::int64_t gap = microsecondsOf(options.longest_gap_s);
    if (sides.before_us && sides.after_us && *sides.after_us - *sides.before_us <= gap) {
        const auto whole = static_cast<double>(*sides.after_us - *sides.before_us);
        const double share = whole > 0 ? static_cast<double>(time_us - *sides.before_us) / whole : 0;
        return blended(info, sides.before, sides.after, share);
    }
    const bool before_counts = sides.before_us && time_us - *sides.before_us <= hold;
    const bool after_counts = sides.after_us && *sides.after_us - time_us <= hold;
    if (!before_counts && !after_counts) return std::nullopt;
    if (before_counts && after_counts)
        return time_us - *sides.before_us <= *sides.after_us - time_us ? sides.before : sides.after;
    return before_counts ? sides.before : sides.after;
}

}  // namespace

TimelineOptions timelineOptionsOf(const VideoInfo& video) {
    TimelineOptions options;
    for (const VideoPart& part : video.parts)
        if (part.first_frame > 0) options.breaks_us.push_back(part.first_time_us);
    return options;
}

std::optional<double> MetadataState::number(int wanted) const {
    const auto at = std::lower_bound(numbers.begin(), numbers.end(), wanted,
                                     [](const MetadataPacket::Number& one, int number) { return one.tag < number; });
    return at != numbers.end() && at->tag == wanted ? std::optional(at->value) : std::nullopt;
}

MetadataTimeline::MetadataTimeline(const MetadataStream& stream, const std::vector<PictureStamp>& pictures,
                                   const TimelineOptions& options)
    : stream_(stream), options_(options) {
    times_us_.assign(stream.packets.size(), kNoStamp);
    for (std::size_t i = 0; i < stream.packets.size(); ++i) {
        const auto by_stamp = timeOfStamp(pictures, stream.packets[i]);
        const auto time = by_stamp ? by_stamp : timeOfNeighbour(pictures, stream.packets[i]);
        if (!time) continue;
        ++(by_stamp ? by_stamp_ : by_file_);
        times_us_[i] = *time;
        places_.push_back({*time, i});
    }
    std::stable_sort(places_.begin(), places_.end(),
                     [](const Place& a, const Place& b) { return a.time_us < b.time_us; });
    for (const Place& place : places_) {
        for (const auto& [number, value] : stream.packets[place.packet].texts) {
            auto& changes = texts_[number];
            if (changes.empty() || changes.back().second != value) changes.emplace_back(place.time_us, value);
        }
    }
}

std::optional<std::int64_t> MetadataTimeline::timeOf(std::size_t index) const {
    const std::int64_t time = times_us_.at(index);
    return time == kNoStamp ? std::nullopt : std::optional(time);
}

std::vector<MetadataPacket::Text> MetadataTimeline::textsAt(std::int64_t time_us) const {
    std::vector<MetadataPacket::Text> texts;
    for (const auto& [number, changes] : texts_) {
        const auto next = std::upper_bound(changes.begin(), changes.end(), time_us,
                                           [](std::int64_t time, const auto& change) { return time < change.first; });
        texts.push_back({number, next == changes.begin() ? next->second : std::prev(next)->second});
    }
    return texts;
}

double MetadataTimeline::coveredShare(std::int64_t first_us, std::int64_t last_us) const {
    const std::int64_t hold = microsecondsOf(options_.longest_hold_s);
    const std::int64_t gap = microsecondsOf(options_.longest_gap_s);
    std::int64_t covered = 0;
    std::int64_t until = first_us;  // what lies before is counted
    const auto add = [&](std::int64_t from, std::int64_t to) {
        from = std::max(from, until);
        to = std::min(to, last_us);
        if (to <= from) return;
        covered += to - from;
        until = to;
    };
    bool touched = false;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const std::int64_t here = places_[i].time_us;
        const bool bridged = i + 1 < places_.size() && places_[i + 1].time_us - here <= gap;
        touched = touched || (here - hold <= last_us && here + hold >= first_us);
        add(here - hold, here);
        add(here, bridged ? places_[i + 1].time_us : here + hold);
    }
    if (last_us <= first_us) return touched ? 1 : 0;
    return static_cast<double>(covered) / static_cast<double>(last_us - first_us);
}

MetadataState MetadataTimeline::at(std::int64_t time_us) const {
    const std::int64_t reach = microsecondsOf(std::max(options_.longest_gap_s, options_.longest_hold_s));
    const auto next = std::upper_bound(places_.begin(), places_.end(), time_us,
                                       [](std::int64_t time, const Place& place) { return time < place.time_us; });
    const auto part = static_cast<int>(std::upper_bound(options_.breaks_us.begin(), options_.breaks_us.end(), time_us) -
                                       options_.breaks_us.begin());
    const auto isOther = [&](const MetadataPacket& packet) {
        return !options_.breaks_us.empty() && packet.part != part;
    };
    std::map<int, Sides> sides;
    std::optional<Place> utc_before, utc_after;
    for (auto at = next; at != places_.begin() && time_us - std::prev(at)->time_us <= reach; --at) {
        const Place& place = *std::prev(at);
        const MetadataPacket& packet = stream_.packets[place.packet];
        if (isOther(packet)) continue;
        if (packet.utc_us && !utc_before) utc_before = place;
        for (const auto& [number, value] : packet.numbers) {
            Sides& side = sides[number];
            if (side.before_us) continue;
            side.before_us = place.time_us;
            side.before = value;
        }
    }
    for (auto at = next; at != places_.end() && at->time_us - time_us <= reach; ++at) {
        const MetadataPacket& packet = stream_.packets[at->packet];
        if (isOther(packet)) continue;
        if (packet.utc_us && !utc_after) utc_after = *at;
        for (const auto& [number, value] : packet.numbers) {
            Sides& side = sides[number];
            if (side.after_us) continue;
            side.after_us = at->time_us;
            side.after = value;
        }
    }
    MetadataState state;
    for (const auto& [number, side] : sides) {
        const auto value = valueAt(infoOf(number), side, time_us, options_);
        if (value) state.numbers.push_back({number, *value});
    }
    const auto utcFrom = [&](const Place& place) {
        return *stream_.packets[place.packet].utc_us + (time_us - place.time_us);
    };
    const std::int64_t hold = microsecondsOf(options_.longest_hold_s);
    const bool agree = utc_before && utc_after && std::abs(utcFrom(*utc_before) - utcFrom(*utc_after)) <= kClockSlack;
    if (agree && utc_after->time_us - utc_before->time_us <= microsecondsOf(options_.longest_gap_s)) {
        const auto whole = static_cast<double>(utc_after->time_us - utc_before->time_us);
        const double share = whole > 0 ? static_cast<double>(time_us - utc_before->time_us) / whole : 0;
        const auto drift = static_cast<double>(utcFrom(*utc_after) - utcFrom(*utc_before));
        state.utc_us = utcFrom(*utc_before) + std::llround(share * drift);
        return state;
    }
    const std::int64_t since = utc_before ? time_us - utc_before->time_us : hold + 1;
    const std::int64_t until = utc_after ? utc_after->time_us - time_us : hold + 1;
    if (std::min(since, until) <= hold) state.utc_us = utcFrom(since <= until ? *utc_before : *utc_after);
    return state;
}

}  // namespace eyrie
