#include "store/labels/label_bytes.h"

#include <bit>
#include <cmath>

static_assert(std::endian::native == std::endian::little, "labels are written as they lie in memory");

namespace eyrie {
namespace {

constexpr unsigned kHeadingSet = 1;
constexpr unsigned kOutside = 2;
constexpr unsigned kIgnore = 4;
constexpr unsigned kOcclusionShift = 3;  // two bits
constexpr unsigned kComputed = 32;

}  // namespace

void LabelBytesOut::text(const std::string& value) {
    count(value.size());
    const std::size_t at = bytes_.size();
    bytes_.resize(at + value.size());
    if (!value.empty()) std::memcpy(bytes_.data() + at, value.data(), value.size());
}

void LabelBytesOut::keyframe(const Keyframe& value) {
    number<std::int32_t>(value.frame);
    for (const double part :
         {value.box.centre.x, value.box.centre.y, value.box.length, value.box.width, value.box.heading}) {
        number(part);
    }
    number(static_cast<std::uint8_t>((value.heading_set ? kHeadingSet : 0) | (value.outside ? kOutside : 0) |
                                     (value.ignore ? kIgnore : 0) | (value.computed ? kComputed : 0) |
                                     (static_cast<unsigned>(value.occlusion) << kOcclusionShift)));
}

void LabelBytesOut::header(const LabelledObject& value) {
    number<std::int32_t>(value.id);
    text(value.object_class);
    number<std::uint32_t>(value.colour);
    text(value.notes);
    number(static_cast<std::uint8_t>(value.origin));
    number<std::int32_t>(value.last_frame);
}

void LabelBytesOut::region(const IgnoreRegion& value) {
    number<std::int32_t>(value.id);
    count(value.polygon.size());
    for (const cv::Point2d& corner : value.polygon) {
        number(corner.x);
        number(corner.y);
    }
    number(static_cast<std::uint8_t>(value.anchor));
    number<std::int32_t>(value.reference_frame);
    number<std::int32_t>(value.first_frame);
    number<std::int32_t>(value.last_frame);
    text(value.notes);
}

void LabelBytesOut::mark(const ReviewMark& value) {
    number<std::int32_t>(value.object);
    number<std::int32_t>(value.first_frame);
    number<std::int32_t>(value.last_frame);
    number(static_cast<std::uint8_t>(value.state));
    text(value.person);
    text(value.when_utc);
}

void LabelBytesOut::objectClass(const ObjectClass& value) {
    text(value.name);
    number(static_cast<std::uint8_t>(value.vehicle));
    number<std::uint32_t>(value.colour);
    number(value.length_m);
    number(value.width_m);
}

double LabelBytesIn::finite() {
    const auto value = number<double>();
    if (!std::isfinite(value)) broken_ = true;
    return broken_ ? 0 : value;
}

std::size_t LabelBytesIn::count(std::size_t least_bytes) {
    const auto value = number<std::uint32_t>();
    if (broken_ || value > left() / least_bytes) {
        broken_ = true;
        return 0;
    }
    return value;
}

std::string LabelBytesIn::text() {
    const std::size_t size = count(1);
    std::string value(size, '\0');
    if (size > 0) std::memcpy(value.data(), bytes_.data() + at_, size);
    at_ += size;
    return value;
}

Keyframe LabelBytesIn::keyframe() {
    Keyframe value;
    value.frame = number<std::int32_t>();
    value.box.centre.x = finite();
    value.box.centre.y = finite();
    value.box.length = finite();
    value.box.width = finite();
    value.box.heading = finite();
    const unsigned all_flags = number<std::uint8_t>();
    const unsigned flags = all_flags & ~kComputed;
    if (flags >> kOcclusionShift > 2) broken_ = true;
    if (broken_) return {};
    value.heading_set = (flags & kHeadingSet) != 0;
    value.outside = (flags & kOutside) != 0;
    value.ignore = (flags & kIgnore) != 0;
    value.occlusion = static_cast<Occlusion>(flags >> kOcclusionShift);
    value.computed = (all_flags & kComputed) != 0;
    return value;
}

LabelledObject LabelBytesIn::header() {
    LabelledObject value;
    value.id = number<std::int32_t>();
    value.object_class = text();
    value.colour = number<std::uint32_t>();
    value.notes = text();
    value.origin = word<ObjectOrigin>(static_cast<int>(ObjectOrigin::imported));
    value.last_frame = number<std::int32_t>();
    return value;
}

IgnoreRegion LabelBytesIn::region() {
    IgnoreRegion value;
    value.id = number<std::int32_t>();
    value.polygon.resize(count(2 * sizeof(double)));
    for (cv::Point2d& corner : value.polygon) {
        corner.x = finite();
        corner.y = finite();
    }
    value.anchor = word<RegionAnchor>(static_cast<int>(RegionAnchor::ground));
    value.reference_frame = number<std::int32_t>();
    value.first_frame = number<std::int32_t>();
    value.last_frame = number<std::int32_t>();
    value.notes = text();
    return value;
}

ReviewMark LabelBytesIn::mark() {
    ReviewMark value;
    value.object = number<std::int32_t>();
    value.first_frame = number<std::int32_t>();
    value.last_frame = number<std::int32_t>();
    value.state = word<ReviewState>(static_cast<int>(ReviewState::questionable));
    value.person = text();
    value.when_utc = text();
    return value;
}

ObjectClass LabelBytesIn::objectClass() {
    ObjectClass value;
    value.name = text();
    value.vehicle = number<std::uint8_t>() != 0;
    value.colour = number<std::uint32_t>();
    value.length_m = finite();
    value.width_m = finite();
    return value;
}

}  // namespace eyrie
