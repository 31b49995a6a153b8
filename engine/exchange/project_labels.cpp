#include "exchange/project_labels.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "annotation/edits/ignore_regions.h"
#include "annotation/keyframes/interpolation.h"
#include "correction/corrected_run.h"

namespace eyrie {
namespace {

/// A region as ignored boxes: one where it is a rectangle, otherwise rows that cover it.
std::vector<OrientedBox> boxesOf(const std::vector<cv::Point2d>& polygon) {
    if (polygon.size() == 4) {
        const CornerBox fitted = boxFromCorners({polygon[1], polygon[2], polygon[3], polygon[0]});
        if (fitted.departure < 0.5) return {fitted.box};
    }
    return coveringBoxes(polygon);
}

/// What holds in some frames, both included.
template <class Value>
struct Span {
    FrameIndex first = 0;
    FrameIndex last = 0;
    int id = 0;
    const Value* value = nullptr;
};

/// Those of many spans that hold in a frame, for ascending frames.
template <class Value>
class SpansInFrame {
 public:
    void add(Span<Value> span) {
        if (span.first <= span.last) later_.push_back(span);
    }
    void sort() {
        std::stable_sort(later_.begin(), later_.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    }
    /// By ascending id.
    const std::map<int, Span<Value>>& in(FrameIndex frame) {
        std::erase_if(present_, [&](const auto& entry) { return entry.second.last < frame; });
        for (; !later_.empty() && later_.back().first <= frame; later_.pop_back()) {
            if (later_.back().last >= frame) present_.emplace(later_.back().id, later_.back());
        }
        return present_;
    }
    /// The first frame from `frame` on in which any holds; none: no more. `in(frame - 1)` was asked before.
    std::optional<FrameIndex> nextFrom(FrameIndex frame) const {
        std::optional<FrameIndex> next;
        for (const auto& [id, span] : present_) {
            if (span.last >= frame) return frame;
        }
        if (!later_.empty()) next = std::max(frame, later_.back().first);
        return next;
    }

 private:
    std::vector<Span<Value>> later_;  // the next one last
    std::map<int, Span<Value>> present_;
};

/// Labels frame by frame.
class LabelledFrames {
 public:
    LabelledFrames(const AnnotationSet& annotations, const CameraMotion& camera, FrameIndex last)
        : annotations_(annotations), camera_(camera) {
        for (const auto& [id, object] : annotations.objects)
            objects_.add({firstFrameOf(object), std::min(object.last_frame, last), id, &object});
        for (const auto& [id, region] : annotations.regions)
            regions_.add({region.first_frame, std::min(region.last_frame, last), id, &region});
        objects_.sort();
        regions_.sort();
    }
    std::optional<FrameIndex> first() const { return from(std::numeric_limits<FrameIndex>::min()); }
    std::optional<FrameIndex> after(FrameIndex frame) const { return from(frame + 1); }
    void take(FrameIndex frame, std::vector<LabelBox>& boxes) {
        for (const auto& [id, span] : objects_.in(frame)) {
            const LabelledBox found = boxAt(*span.value, frame, camera_);
            if (!found.visible()) continue;
            LabelBox& box = boxes.emplace_back();
            box.frame = frame;
            box.id = id;
            box.box = found.box;
            box.object_class = span.value->object_class;
            box.ignore = found.ignore;
            box.occlusion = found.occlusion;
        }
        if (regions_.in(frame).empty()) return;
        for (const RegionInFrame& region : regionsAt(annotations_, frame, camera_)) {
            for (const OrientedBox& box : boxesOf(region.polygon)) {
                LabelBox& area = boxes.emplace_back();
                area.frame = frame;
                area.ignore = true;
                area.box = box;
            }
        }
    }

 private:
    std::optional<FrameIndex> from(FrameIndex frame) const {
        const auto object = objects_.nextFrom(frame), region = regions_.nextFrom(frame);
        return object && region ? std::min(object, region) : object ? object : region;
    }

    const AnnotationSet& annotations_;
    const CameraMotion& camera_;
    SpansInFrame<LabelledObject> objects_;
    SpansInFrame<IgnoreRegion> regions_;
};

}  // namespace

std::optional<RunRecord> lastRunOver(const RunStore& store, int sequence_id) {
    std::optional<RunRecord> last;
    for (const RunRecord& run : store.runs()) {
        if (run.sequence.id == sequence_id && run.frames_done > 1) last = run;
    }
    return last;
}

CameraMotion cameraMotionOf(const RunStore& store, int sequence_id) {
    const std::optional<RunRecord> run = lastRunOver(store, sequence_id);
    if (!run) return {};
    return CameraMotion::fromRegistrations(store.registrations(run->id));
}

LabelStream labelStreamOf(const AnnotationSet& annotations, const SequenceRecord& sequence,
                          const CameraMotion& camera) {
    LabelStream labels;
    LabelFile& about = labels.about;
    about.image_size = sequence.size;
    about.frame_count = sequence.frame_count;
    about.frame_rate_hz = sequence.frame_rate_hz;
    if (camera.empty()) {
        about.notes.emplace_back(
            "the video was never registered, so boxes between keyframes run straight in the image");
    }
    const FrameIndex last =
        sequence.frame_count > 0 ? sequence.frame_count - 1 : std::numeric_limits<FrameIndex>::max() - 1;
    labels.frames = [&annotations, &camera, last](const FrameVisitor& visitor) {
        LabelledFrames frames(annotations, camera, last);
        std::vector<LabelBox> in_frame;
        for (auto frame = frames.first(); frame; frame = frames.after(*frame)) {
            in_frame.clear();
            frames.take(*frame, in_frame);
            if (!in_frame.empty()) visitor(*frame, in_frame);
        }
    };
    return labels;
}

namespace {

LabelStream streamOf(const RunRecord& run, VisitBoxes visit) {
    LabelStream labels;
    labels.about.image_size = run.sequence.size;
    labels.about.frame_count = run.sequence.frame_count;
    labels.about.frame_rate_hz = run.sequence.frame_rate_hz;
    if (run.scale.gsd_known) labels.about.gsd_m = run.scale.gsd_m_per_px;
    labels.frames = [visit = std::move(visit)](const FrameVisitor& visitor) {
        std::vector<LabelBox> in_frame;
        FrameIndex present = 0;
        visit([&](FrameIndex frame, const BoxRecord& record) {
            if (frame != present && !in_frame.empty()) {
                visitor(present, in_frame);
                in_frame.clear();
            }
            present = frame;
            in_frame.push_back({record, Occlusion::none});
        });
        if (!in_frame.empty()) visitor(present, in_frame);
    };
    return labels;
}

}  // namespace

LabelStream labelStreamOf(const RunStore& store, const RunRecord& run, bool detections) {
    return streamOf(run, [&store, id = run.id, detections](const BoxVisitor& visitor) {
        detections ? store.visitDetectionBoxes(id, visitor) : store.visitTrackBoxes(id, visitor);
    });
}

LabelStream labelStreamOf(const RunStore& store, const RunRecord& run, CorrectedTracks corrected) {
    const std::string told = correctionsInWords(corrected);
    LabelStream labels =
        streamOf(run, [&store, id = run.id, corrected = std::move(corrected)](const BoxVisitor& visitor) {
            visitTrackBoxes(store, id, corrected, visitor);
        });
    if (!told.empty()) labels.about.notes.push_back("tracks as people corrected them: " + told);
    return labels;
}

LabelFile labelsOf(const AnnotationSet& annotations, const SequenceRecord& sequence, const CameraMotion& camera) {
    return collected(labelStreamOf(annotations, sequence, camera));
}

}  // namespace eyrie
