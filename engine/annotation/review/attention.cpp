#include "annotation/review/attention.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "annotation/keyframes/interpolation.h"
#include "annotation/review/review_state.h"
#include "core/geometry/angle.h"

namespace eyrie {
namespace {

std::string inWords(const char* format, double a, double b) {
    char text[160];
    std::snprintf(text, sizeof text, format, a, b);
    return text;
}

/// Looks at one object.
class Observer {
 public:
    Observer(const LabelledObject& object, const CameraMotion& camera, const AttentionOptions& options,
             std::vector<AttentionItem>& items)
        : object_(object), camera_(camera), options_(options), items_(items) {}

    void lookAtEnds() {
        const FrameIndex first = firstFrameOf(object_);
        if (first > 0 && wellInside(first)) {
            add(first, AttentionKind::starts_inside, "begins in the middle of the image");
        }
        if (object_.last_frame + 1 < options_.frame_count && wellInside(object_.last_frame)) {
            add(object_.last_frame, AttentionKind::ends_inside, "ends in the middle of the image");
        }
    }

    void lookAtGaps() {
        for (std::size_t i = 1; i + 1 < object_.keyframes.size(); ++i) {
            const Keyframe& keyframe = object_.keyframes[i];
            if (!keyframe.outside || object_.keyframes[i - 1].outside || !wellInside(keyframe.frame - 1)) continue;
            const int frames = object_.keyframes[i + 1].frame - keyframe.frame;
            add(keyframe.frame, AttentionKind::gap,
                "outside for " + std::to_string(frames) + " frames although it was inside the image");
        }
    }

    void lookAtMovement() {
        std::optional<double> speed_before;
        for (std::size_t i = 0; i + 1 < object_.keyframes.size(); ++i) {
            const Keyframe& a = object_.keyframes[i];
            const Keyframe& b = object_.keyframes[i + 1];
            if (a.outside || b.frame > object_.last_frame) {
                speed_before.reset();
                continue;
            }
            const auto carried = carriedBox(a.box, a.frame, b.frame, camera_);
            const OrientedBox from = carried.value_or(a.box);
            const int frames = b.frame - a.frame;
            const cv::Point2d way = b.box.centre - from.centre;
            const double speed = std::hypot(way.x, way.y) / frames;
            if (speed_before) compareSpeeds(*speed_before, speed, a.frame);
            speed_before = speed;
            compareSizes(from, b);
            if (a.heading_set && b.heading_set) compareHeadings(from, b, frames);
        }
    }

 private:
    bool wellInside(FrameIndex frame) const {
        const LabelledBox box = boxAt(object_, frame, camera_);
        if (!box.exists() || options_.image.empty()) return false;
        const OrientedBox around = box.box.upright();
        const double border = options_.border_px;
        return around.centre.x - around.length / 2 > border && around.centre.y - around.width / 2 > border &&
               around.centre.x + around.length / 2 < options_.image.width - 1 - border &&
               around.centre.y + around.width / 2 < options_.image.height - 1 - border;
    }

    void compareSpeeds(double before, double after, FrameIndex frame) {
        const double slower = std::min(before, after);
        const double faster = std::max(before, after);
        if (faster - slower < options_.jump_px || faster < slower * options_.jump_factor) return;
        add(frame, AttentionKind::jump, inWords("%.1f px/frame, %.1f before", after, before));
    }

    void compareSizes(const OrientedBox& from, const Keyframe& to) {
        const auto ratio = [](double a, double b) { return std::max(a, b) / std::max(1e-6, std::min(a, b)); };
        if (std::max(ratio(from.length, to.box.length), ratio(from.width, to.box.width)) < options_.size_factor) return;
        add(to.frame, AttentionKind::size,
            inWords("%.0f px long, %.0f before", to.box.length, from.length) +
                inWords(", %.0f px wide, %.0f before", to.box.width, from.width));
    }

    void compareHeadings(const OrientedBox& from, const Keyframe& to, int frames) {
        const double turn = std::abs(turnBetween(from.heading, to.box.heading));
        if (turn / frames < options_.turn_per_frame) return;
        add(to.frame, AttentionKind::turn,
            inWords("turns by %.0f° in %.0f frames", turn * 180 / kPi, static_cast<double>(frames)));
    }

    void add(FrameIndex frame, AttentionKind kind, std::string text) {
        items_.push_back({object_.id, frame, kind, std::move(text)});
    }

    const LabelledObject& object_;
    const CameraMotion& camera_;
    const AttentionOptions& options_;
    std::vector<AttentionItem>& items_;
};

}  // namespace

const char* nameOf(AttentionKind kind) {
    switch (kind) {
        case AttentionKind::questionable:
            return "questionable";
        case AttentionKind::starts_inside:
            return "begins inside";
        case AttentionKind::ends_inside:
            return "ends inside";
        case AttentionKind::gap:
            return "gap";
        case AttentionKind::jump:
            return "jump";
        case AttentionKind::turn:
            return "turn";
        case AttentionKind::size:
            return "size";
    }
    return "";
}

std::vector<AttentionItem> attentionList(const AnnotationSet& set, const CameraMotion& camera,
                                         const AttentionOptions& options) {
    std::vector<AttentionItem> items;
    const ReviewIndex reviews(set);
    for (const auto& [id, object] : set.objects) {
        if (object.keyframes.empty()) continue;
        for (const ReviewSpan& span : reviews.spansOf(id)) {
            if (span.state != ReviewState::questionable) continue;
            items.push_back({id, span.first_frame, AttentionKind::questionable,
                             "questionable" + (span.person.empty() ? std::string() : " (" + span.person + ")")});
        }
        Observer observer(object, camera, options, items);
        observer.lookAtEnds();
        observer.lookAtGaps();
        observer.lookAtMovement();
    }
    std::stable_sort(items.begin(), items.end(), [](const AttentionItem& a, const AttentionItem& b) {
        return std::tie(a.frame, a.object) < std::tie(b.frame, b.object);
    });
    return items;
}

std::optional<AttentionItem> nextAttention(const std::vector<AttentionItem>& items, FrameIndex frame, ObjectId object) {
    if (items.empty()) return std::nullopt;
    const auto next = std::find_if(items.begin(), items.end(), [&](const AttentionItem& item) {
        return std::tie(item.frame, item.object) > std::tie(frame, object);
    });
    return next == items.end() ? items.front() : *next;
}

}  // namespace eyrie
