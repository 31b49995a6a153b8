#include "store/labels/packed_labels.h"

#include <algorithm>

#include "store/labels/label_bytes.h"

namespace eyrie {
namespace {

constexpr std::uint8_t kFormat = 1;
// Bytes that the smallest object, mark and class take.
constexpr std::size_t kLeastChange = 5;
constexpr std::size_t kLeastMark = 21;
constexpr std::size_t kLeastClass = 25;

enum class Kind : std::uint8_t { added = 0, removed = 1, changed = 2 };

template <class Value>
Kind kindOf(const Change<Value>& change) {
    return !change.before ? Kind::added : !change.after ? Kind::removed : Kind::changed;
}

bool same(const Keyframe& a, const Keyframe& b) {
    return a.frame == b.frame && a.box.centre == b.box.centre && a.box.length == b.box.length &&
           a.box.width == b.box.width && a.box.heading == b.box.heading && a.heading_set == b.heading_set &&
           a.occlusion == b.occlusion && a.outside == b.outside && a.ignore == b.ignore && a.computed == b.computed;
}

void putKeyframes(LabelBytesOut& out, const std::vector<Keyframe>& keyframes, std::size_t first, std::size_t last) {
    out.count(last - first);
    for (std::size_t i = first; i < last; ++i) out.keyframe(keyframes[i]);
}

std::vector<Keyframe> takeKeyframes(LabelBytesIn& in) {
    std::vector<Keyframe> keyframes(in.count(kKeyframeBytes));
    for (Keyframe& keyframe : keyframes) keyframe = in.keyframe();
    return keyframes;
}

void putWhole(LabelBytesOut& out, const LabelledObject& object) {
    out.header(object);
    putKeyframes(out, object.keyframes, 0, object.keyframes.size());
}

LabelledObject takeWhole(LabelBytesIn& in) {
    LabelledObject object = in.header();
    object.keyframes = takeKeyframes(in);
    return object;
}

void putChanged(LabelBytesOut& out, const LabelledObject& before, const LabelledObject& after) {
    const auto& a = before.keyframes;
    const auto& b = after.keyframes;
    const std::size_t shorter = std::min(a.size(), b.size());
    std::size_t head = 0;
    while (head < shorter && same(a[head], b[head])) ++head;
    std::size_t tail = 0;
    while (tail < shorter - head && same(a[a.size() - 1 - tail], b[b.size() - 1 - tail])) ++tail;
    out.header(before);
    out.header(after);
    out.count(head);
    putKeyframes(out, a, head, a.size() - tail);
    putKeyframes(out, b, head, b.size() - tail);
}

/// `there` are the keyframes of one side with `part` at `head`; answers them with `other` in its place.
std::optional<std::vector<Keyframe>> replaced(const std::vector<Keyframe>& there, std::size_t head,
                                              const std::vector<Keyframe>& part, const std::vector<Keyframe>& other) {
    if (head > there.size() || part.size() > there.size() - head) return std::nullopt;
    const auto begin = there.begin() + static_cast<std::ptrdiff_t>(head);
    const auto end = begin + static_cast<std::ptrdiff_t>(part.size());
    if (!std::equal(begin, end, part.begin(), part.end(), same)) return std::nullopt;
    std::vector<Keyframe> result(there.begin(), begin);
    result.insert(result.end(), other.begin(), other.end());
    result.insert(result.end(), end, there.end());
    return result;
}

Change<LabelledObject> takeChanged(LabelBytesIn& in, const AnnotationSet& set, bool done) {
    LabelledObject before = in.header();
    LabelledObject after = in.header();
    const std::size_t head = in.number<std::uint32_t>();
    const std::vector<Keyframe> removed = takeKeyframes(in);
    const std::vector<Keyframe> added = takeKeyframes(in);
    const auto present = set.objects.find(after.id);
    if (in.broken() || before.id != after.id || present == set.objects.end()) {
        in.refuse();
        return {};
    }
    const auto& there = present->second.keyframes;
    const auto other = done ? replaced(there, head, added, removed) : replaced(there, head, removed, added);
    if (!other) {
        in.refuse();
        return {};
    }
    before.keyframes = done ? *other : there;
    after.keyframes = done ? there : *other;
    return {before, after};
}

void putMarks(LabelBytesOut& out, const std::vector<ReviewMark>& marks) {
    out.count(marks.size());
    for (const ReviewMark& mark : marks) out.mark(mark);
}

std::vector<ReviewMark> takeMarks(LabelBytesIn& in) {
    std::vector<ReviewMark> marks(in.count(kLeastMark));
    for (ReviewMark& mark : marks) mark = in.mark();
    return marks;
}

void putClasses(LabelBytesOut& out, const std::optional<std::vector<ObjectClass>>& classes) {
    out.count(classes ? classes->size() : 0);
    if (!classes) return;
    for (const ObjectClass& each : *classes) out.objectClass(each);
}

std::vector<ObjectClass> takeClasses(LabelBytesIn& in) {
    std::vector<ObjectClass> classes(in.count(kLeastClass));
    for (ObjectClass& each : classes) each = in.objectClass();
    return classes;
}

}  // namespace

Bytes packKeyframes(const std::vector<Keyframe>& keyframes) {
    LabelBytesOut out;
    out.number(kFormat);
    for (const Keyframe& keyframe : keyframes) out.keyframe(keyframe);
    return out.take();
}

std::optional<std::vector<Keyframe>> unpackKeyframes(ByteView bytes) {
    LabelBytesIn in(bytes);
    if (in.number<std::uint8_t>() != kFormat || in.left() == 0 || in.left() % kKeyframeBytes != 0) return std::nullopt;
    std::vector<Keyframe> keyframes(in.left() / kKeyframeBytes);
    FrameIndex before = -1;
    for (Keyframe& keyframe : keyframes) {
        keyframe = in.keyframe();
        if (in.broken() || keyframe.frame <= before || keyframe.box.length < 0 || keyframe.box.width < 0) {
            return std::nullopt;
        }
        before = keyframe.frame;
    }
    return keyframes;
}

Bytes packPolygon(const std::vector<cv::Point2d>& polygon) {
    LabelBytesOut out;
    out.number(kFormat);
    for (const cv::Point2d& corner : polygon) {
        out.number(corner.x);
        out.number(corner.y);
    }
    return out.take();
}

std::optional<std::vector<cv::Point2d>> unpackPolygon(ByteView bytes) {
    LabelBytesIn in(bytes);
    if (in.number<std::uint8_t>() != kFormat || in.left() % (2 * sizeof(double)) != 0) return std::nullopt;
    std::vector<cv::Point2d> polygon(in.left() / (2 * sizeof(double)));
    for (cv::Point2d& corner : polygon) {
        corner.x = in.number<double>();
        corner.y = in.number<double>();
    }
    return polygon;
}

Bytes packEdit(const AnnotationEdit& edit) {
    LabelBytesOut out;
    out.number(kFormat);
    out.count(edit.objects.size());
    for (const auto& change : edit.objects) {
        const Kind kind = kindOf(change);
        out.number(static_cast<std::uint8_t>(kind));
        if (kind == Kind::added) putWhole(out, *change.after);
        if (kind == Kind::removed) putWhole(out, *change.before);
        if (kind == Kind::changed) putChanged(out, *change.before, *change.after);
    }
    out.count(edit.regions.size());
    for (const auto& change : edit.regions) {
        out.number(static_cast<std::uint8_t>(kindOf(change)));
        if (change.before) out.region(*change.before);
        if (change.after) out.region(*change.after);
    }
    out.number(static_cast<std::uint8_t>(edit.reviews.has_value()));
    if (edit.reviews) {
        out.count(edit.reviews->kept);
        putMarks(out, edit.reviews->removed);
        putMarks(out, edit.reviews->added);
    }
    out.number(static_cast<std::uint8_t>(edit.classes.has_value()));
    if (edit.classes) {
        putClasses(out, edit.classes->before);
        putClasses(out, edit.classes->after);
    }
    return out.take();
}

std::optional<AnnotationEdit> unpackEdit(ByteView bytes, const AnnotationSet& set, bool done) {
    LabelBytesIn in(bytes);
    if (in.number<std::uint8_t>() != kFormat) return std::nullopt;
    AnnotationEdit edit;
    for (std::size_t left = in.count(kLeastChange); left > 0 && !in.broken(); --left) {
        switch (static_cast<Kind>(in.number<std::uint8_t>())) {
            case Kind::added:
                edit.objects.push_back({std::nullopt, takeWhole(in)});
                break;
            case Kind::removed:
                edit.objects.push_back({takeWhole(in), std::nullopt});
                break;
            case Kind::changed:
                edit.objects.push_back(takeChanged(in, set, done));
                break;
            default:
                in.refuse();
        }
    }
    for (std::size_t left = in.count(kLeastChange); left > 0 && !in.broken(); --left) {
        const auto kind = static_cast<Kind>(in.number<std::uint8_t>());
        if (kind > Kind::changed) in.refuse();
        Change<IgnoreRegion> change;
        if (kind != Kind::added) change.before = in.region();
        if (kind != Kind::removed) change.after = in.region();
        edit.regions.push_back(std::move(change));
    }
    if (in.number<std::uint8_t>() != 0) {
        TailChange<ReviewMark> reviews;
        reviews.kept = in.number<std::uint32_t>();
        reviews.removed = takeMarks(in);
        reviews.added = takeMarks(in);
        edit.reviews = std::move(reviews);
    }
    if (in.number<std::uint8_t>() != 0) {
        Change<std::vector<ObjectClass>> classes;
        classes.before = takeClasses(in);
        classes.after = takeClasses(in);
        edit.classes = std::move(classes);
    }
    if (!in.complete()) return std::nullopt;
    return edit;
}

}  // namespace eyrie
