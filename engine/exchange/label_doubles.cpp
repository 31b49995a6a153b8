#include "exchange/label_doubles.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "annotation/keyframes/interpolation.h"

namespace eyrie {
namespace {

constexpr std::size_t kLooks = 40;
constexpr double kSameShare = 0.8;

bool sameCorners(const OrientedBox& a, const OrientedBox& b, double tolerance_px) {
    const auto p = a.corners();
    const auto q = b.corners();
    for (std::size_t i = 0; i < p.size(); ++i)
        if (std::hypot(p[i].x - q[i].x, p[i].y - q[i].y) > tolerance_px) return false;
    return true;
}

/// Whether an object shows enough of the boxes. Gives up as soon as it cannot any more.
bool showsThem(const LabelledObject& object, const std::vector<const LabelBox*>& boxes, const CameraMotion& camera,
               double tolerance_px) {
    if (boxes.back()->frame < firstFrameOf(object) || boxes.front()->frame > object.last_frame) return false;
    const std::size_t looks = std::min(kLooks, boxes.size());
    const auto may_miss = static_cast<std::size_t>(static_cast<double>(looks) * (1 - kSameShare) + 1e-9);
    std::size_t missed = 0;
    for (std::size_t i = 0; i < looks; ++i) {
        const LabelBox& box = *boxes[i * boxes.size() / looks];
        const LabelledBox shown = boxAt(object, box.frame, camera);
        if (shown.visible() && sameCorners(shown.box, box.box, tolerance_px)) continue;
        if (++missed > may_miss) return false;
    }
    return true;
}

/// Objects by the frames they live in. Those of one frame can be many, such as imported detections, and are found by
/// it.
class Present {
 public:
    explicit Present(const AnnotationSet& set) {
        for (const auto& [id, object] : set.objects) {
            if (firstFrameOf(object) < object.last_frame)
                longer_.push_back(&object);
            else
                of_one_frame_.emplace(object.last_frame, &object);
        }
    }
    /// The first object that may live in these frames and fulfils `fits`; null for none.
    template <class Fits>
    const LabelledObject* find(FrameIndex first, FrameIndex last, const Fits& fits) const {
        for (const LabelledObject* object : longer_)
            if (fits(*object)) return object;
        const auto end = of_one_frame_.upper_bound(last);
        for (auto entry = of_one_frame_.lower_bound(first); entry != end; ++entry)
            if (fits(*entry->second)) return entry->second;
        return nullptr;
    }

 private:
    std::vector<const LabelledObject*> longer_;
    std::multimap<FrameIndex, const LabelledObject*> of_one_frame_;
};

}  // namespace

std::map<int, ObjectId> alreadyLabelled(const LabelFile& labels, const AnnotationSet& present,
                                        const CameraMotion& camera, double tolerance_px) {
    std::map<int, ObjectId> doubles;
    if (present.objects.empty()) return doubles;
    std::map<int, std::vector<const LabelBox*>> tracks;
    for (const auto& [frame, records] : labels.boxes) {
        for (const LabelBox& record : records)
            if (record.id) tracks[*record.id].push_back(&record);
    }
    const Present lookup(present);
    for (const auto& entry : tracks) {
        const std::vector<const LabelBox*>& boxes = entry.second;
        const LabelledObject* same =
            lookup.find(boxes.front()->frame, boxes.back()->frame,
                        [&](const LabelledObject& object) { return showsThem(object, boxes, camera, tolerance_px); });
        if (same != nullptr) doubles[entry.first] = same->id;
    }
    return doubles;
}

bool hasRegion(const AnnotationSet& present, const IgnoreRegion& region, double tolerance_px) {
    return std::any_of(present.regions.begin(), present.regions.end(), [&](const auto& entry) {
        const IgnoreRegion& other = entry.second;
        if (other.first_frame != region.first_frame || other.last_frame != region.last_frame ||
            other.reference_frame != region.reference_frame || other.anchor != region.anchor ||
            other.polygon.size() != region.polygon.size())
            return false;
        return std::equal(region.polygon.begin(), region.polygon.end(), other.polygon.begin(),
                          [&](const cv::Point2d& a, const cv::Point2d& b) {
                              return std::hypot(a.x - b.x, a.y - b.y) <= tolerance_px;
                          });
    });
}

}  // namespace eyrie
