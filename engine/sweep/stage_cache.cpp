#include "sweep/stage_cache.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "chain/chain.h"
#include "chain/recording/classified_vehicles.h"
#include "chain/scale/scale_estimation.h"
#include "core/error.h"
#include "core/labels/result_box.h"
#include "detection/detector_factory.h"
#include "detection/roi_cutter.h"

namespace eyrie {
namespace {

/// Leaves a computation that nobody waits for any more.
struct Stopped {};

void leaveIf(const std::stop_token& stop) {
    if (stop.stop_requested()) throw Stopped{};
}

BoxesByFrame keptBoxes(const std::vector<FrameMotion>& motion, const std::vector<std::vector<Detection>>& detections) {
    BoxesByFrame boxes;
    for (std::size_t i = 0; i < detections.size(); ++i) {
        for (const Detection& detection : detections[i]) {
            if (detection.rejection == Rejection::none)
                boxes[motion[i].frame].push_back(boxOf(motion[i].frame, detection));
        }
    }
    return boxes;
}

/// The name of what is found with these parameters at that scale. A slope that was looked for depends on more of them
/// than the stage does.
std::string named(std::string signature, const SceneScale& scale) {
    if (scale.slope.isFlat()) return signature;
    std::array<char, 128> slope{};
    std::snprintf(slope.data(), slope.size(), "slope %a %a from %a %a\n", scale.slope.right_per_px,
                  scale.slope.down_per_px, scale.slope.centre_x, scale.slope.centre_y);
    return std::move(signature) + slope.data();
}

std::string nameUpTo(const ChainOptions& options, const SceneScale& scale, ChainStage last) {
    return named(signatureUpTo(options, last), scale);
}

std::vector<FrameMotionSummary> summariesOf(const std::vector<FrameMotion>& motion) {
    std::vector<FrameMotionSummary> summaries;
    summaries.reserve(motion.size());
    for (const FrameMotion& frame : motion) summaries.push_back({frame.frame, frame.registration, frame.image_size});
    return summaries;
}

/// Works through contiguous pieces of 0 … count on all cores. What a piece throws is thrown here.
void inPieces(std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& work) {
    constexpr std::size_t kPieceFrames = 16;  // small enough to share out, large enough for a decoder to read on
    const int pieces = static_cast<int>((count + kPieceFrames - 1) / kPieceFrames);
    std::mutex mutex;
    std::exception_ptr error;
    cv::parallel_for_(
        cv::Range(0, pieces),
        [&](const cv::Range& range) {
            for (int piece = range.start; piece < range.end; ++piece) {
                try {
                    const std::size_t begin = static_cast<std::size_t>(piece) * kPieceFrames;
                    work(begin, std::min(count, begin + kPieceFrames));
                } catch (...) {
                    const std::scoped_lock lock(mutex);
                    if (!error) error = std::current_exception();
                }
            }
        },
        pieces);
    if (error) std::rethrow_exception(error);
}

}  // namespace

/// A search area and what the detector prepared in it.
struct StageCache::Prepared {
    MotionRoi roi;
    std::unique_ptr<const PreparedArea> area;
    std::size_t bytes() const {
        return sizeof *this + roi.image.total() + roi.inside.total() + roi.vectors.size() * sizeof(cv::Point2f) +
               (area ? area->bytes() : 0);
    }
};

StageCache::StageCache(ClipFrames::Open open, FrameRange range, const SceneScale& scale, StageCacheOptions options)
    : frames_(std::move(open), range, options.frame_bytes), scale_(scale), options_(std::move(options)) {}

void StageCache::tell(ChainStage stage, int done) const {
    if (progress_) progress_(stage, done, frames_.count());
}

void StageCache::forFrames(const std::stop_token& stop,
                           const std::function<void(std::size_t, ClipFrames::Reader&)>& work) const {
    const auto piece = [&](std::size_t begin, std::size_t end) {
        ClipFrames::Reader reader = frames_.reader();
        for (std::size_t i = begin; i < end; ++i) {
            leaveIf(stop);
            work(i, reader);
        }
    };
    const auto count = static_cast<std::size_t>(frames_.count());
    options_.all_cores ? inPieces(count, piece) : piece(0, count);
}

void StageCache::useStoredMotion(const ChainOptions& options, std::vector<FrameMotion> motion) {
    const bool fits = motion.size() == static_cast<std::size_t>(frames_.count()) &&
                      motion.front().frame == frames_.first() && motion.back().frame == frames_.last();
    if (!fits) throw Error(ErrorKind::internal, "the stored motion vectors are not those of the frames to be swept");
    auto shared = std::make_shared<const Motion>(std::move(motion));
    motion_.get(nameUpTo(options, scaleFor(options, {}), ChainStage::motion), [&] { return shared; });
}

SceneScale StageCache::scaleFor(const ChainOptions& options, const std::stop_token& stop) {
    SceneScale scale = scale_;
    if (options.view.oblique && options_.looked_for_slope) return scale;
    scale.slope = {};
    if (!options.view.oblique) return scale;
    scale.slope = *slopes_.get(signatureUpTo(options, ChainStage::detection), [&] {
        ScaleSlope slope;
        if (options_.look_for_slope) {
            slope = options_.look_for_slope(options, stop);
        } else {
            const auto source = frames_.openAnew();
            slope = slopeFor(*source, {frames_.first(), frames_.last()}, options, scale, stop);
        }
        leaveIf(stop);
        return std::make_shared<const ScaleSlope>(slope);
    });
    return scale;
}

std::shared_ptr<StageCache::Motion> StageCache::computeMotion(const Point& point) {
    count(ChainStage::motion);
    auto motion = std::make_shared<Motion>();
    motion->reserve(static_cast<std::size_t>(frames_.count()));
    // Decodes ahead while frames are registered.
    std::jthread ahead;
    if (frames_.inMemory()) {
        ahead = std::jthread([this](const std::stop_token& done) {
            try {
                ClipFrames::Reader reader = frames_.reader();
                for (FrameIndex i = frames_.first(); i <= frames_.last() && !done.stop_requested(); ++i) reader.read(i);
            } catch (const Error&) {  // whoever needs the frame will meet the error
            }
        });
    }
    MotionHalf half(point.options, point.scale);
    ClipFrames::Reader reader = frames_.reader();
    for (FrameIndex i = frames_.first(); i <= frames_.last(); ++i) {
        leaveIf(point.stop);
        StageTimes times{};
        motion->push_back(half.next(reader.read(i), times));
        tell(ChainStage::motion, i - frames_.first() + 1);
    }
    return motion;
}

std::shared_ptr<const StageCache::Motion> StageCache::motion(const Point& point) {
    return motion_.get(nameUpTo(point.options, point.scale, ChainStage::motion), [&] { return computeMotion(point); });
}

std::shared_ptr<StageCache::Clusters> StageCache::differenceClusters(const Point& point, const Motion& motion) {
    auto clusters = std::make_shared<Clusters>();
    DifferenceMotion difference(point.options.difference, point.scale);
    ClipFrames::Reader reader = frames_.reader();
    for (const FrameMotion& frame : motion) {
        leaveIf(point.stop);
        clusters->push_back(difference.next(reader.read(frame.frame), frame).clusters);
        tell(ChainStage::clustering, static_cast<int>(clusters->size()));
    }
    return clusters;
}

std::shared_ptr<const StageCache::Clusters> StageCache::clusters(const Point& point, const Motion& motion) {
    return clusters_.get(nameUpTo(point.options, point.scale, ChainStage::clustering),
                         [&]() -> std::shared_ptr<const Clusters> {
                             count(ChainStage::clustering);
                             if (point.options.difference.method != MotionMethod::vectors)
                                 return differenceClusters(point, motion);
                             auto clusters = std::make_shared<Clusters>(motion.size());
                             forFrames(point.stop, [&](std::size_t i, ClipFrames::Reader&) {
                                 const SceneScale scale = point.scale.zoomed(motion[i].registration.zoom);
                                 (*clusters)[i] = MotionClustering(point.options.clustering, scale).cluster(motion[i]);
                             });
                             return clusters;
                         });
}

std::shared_ptr<const StageCache::Detections> StageCache::found(const Point& point, const Motion& motion) {
    const auto clusters = this->clusters(point, motion);
    return found_.get(nameUpTo(point.options, point.scale, ChainStage::detection), [&] {
        count(ChainStage::detection);
        const std::size_t frame_count = motion.size();
        // Tables are shared by all that agree in their parameters and only ever grow, hence the casts.
        const auto prepared = std::const_pointer_cast<AreaTable<Prepared>>(prepared_.get(
            named(preparationSignature(point.options), point.scale),
            [&] { return std::make_shared<const AreaTable<Prepared>>(frame_count, options_.area_bytes); }));
        const auto areas = std::const_pointer_cast<AreaTable<std::vector<Detection>>>(
            areas_.get(named(areaSignature(point.options), point.scale), [&] {
                return std::make_shared<const AreaTable<std::vector<Detection>>>(frame_count, options_.area_bytes / 8);
            }));
        const std::unique_ptr<Detector> detector = makeDetector(point.options.detection, point.scale);
        auto detections = std::make_shared<Detections>(frame_count);
        forFrames(point.stop, [&](std::size_t i, ClipFrames::Reader& reader) {
            std::optional<Frame> frame;
            for (std::size_t c = 0; c < (*clusters)[i].size(); ++c) {
                const MotionCluster& cluster = (*clusters)[i][c];
                std::shared_ptr<const std::vector<Detection>> in_area = areas->find(i, cluster);
                ++(in_area ? areas_known_ : areas_searched_);
                if (!in_area) {
                    std::shared_ptr<const Prepared> area = prepared->find(i, cluster);
                    if (!area) {
                        if (!frame) frame = reader.read(motion[i].frame);
                        auto made = std::make_shared<Prepared>();
                        made->roi = cutMotionRoi(*frame, cluster, 0, motion[i], point.options.detection, point.scale);
                        made->area = detector->prepare(made->roi);
                        prepared->keep(i, cluster, made, made->bytes());
                        area = std::move(made);
                    }
                    auto decided =
                        std::make_shared<const std::vector<Detection>>(detector->decide(area->roi, area->area.get()));
                    areas->keep(i, cluster, decided, decided->size() * sizeof(Detection));
                    in_area = std::move(decided);
                }
                for (Detection detection : *in_area) {
                    detection.cluster = static_cast<int>(c);
                    (*detections)[i].push_back(std::move(detection));
                }
            }
        });
        return detections;
    });
}

StageCache::Detections StageCache::detectionsByStacks(const Point& point, const Motion& motion) {
    count(ChainStage::stacking);
    Detections detections;
    TrackHalf half(point.options, point.scale);
    ClipFrames::Reader reader = frames_.reader();
    for (const FrameMotion& frame : motion) {
        leaveIf(point.stop);
        detections.push_back(half.next(reader.read(frame.frame), frame, {}).detections);
        tell(ChainStage::stacking, static_cast<int>(detections.size()));
    }
    return detections;
}

std::shared_ptr<const StageCache::Detected> StageCache::detected(const Point& point, const Motion& motion) {
    return detected_.get(nameUpTo(point.options, point.scale, ChainStage::removal), [&] {
        auto detected = std::make_shared<Detected>();
        if (point.options.stacking.enabled) {
            // Stacks are started from the detections of the frame before: nothing behind can be done by itself.
            detected->frames = detectionsByStacks(point, motion);
        } else {
            const auto found = this->found(point, motion);
            count(ChainStage::removal);
            detected->frames.resize(motion.size());
            const auto classifier =
                classifierOfBoxes(*makeDetector(point.options.detection, point.scale), point.options, point.scale);
            forFrames(point.stop, [&](std::size_t i, ClipFrames::Reader& reader) {
                detected->frames[i] = removed((*found)[i], motion[i], point.options, point.scale);
                if (classifier && classifier->looksAt(motion[i].frame))
                    classifier->judge(detected->frames[i], reader.read(motion[i].frame), motion[i].registration.zoom);
            });
        }
        detected->boxes = keptBoxes(motion, detected->frames);
        return detected;
    });
}

std::shared_ptr<const std::vector<TimedState>> StageCache::states(const Point& point, const Motion& motion,
                                                                  const Detections& detections) {
    return states_.get(nameUpTo(point.options, point.scale, ChainStage::tracking), [&] {
        count(ChainStage::tracking);
        auto states = std::make_shared<std::vector<TimedState>>();
        Tracker tracker(point.options.tracking, point.scale);
        ClipFrames::Reader reader = frames_.reader();
        for (std::size_t i = 0; i < motion.size(); ++i) {
            leaveIf(point.stop);
            const PictureOfFrame picture = [&] { return reader.read(motion[i].frame).gray; };
            for (const TrackState& state : tracker.next(motion[i], detections[i], nullptr, picture))
                states->emplace_back(motion[i].frame, state);
        }
        return states;
    });
}

std::shared_ptr<const BoxesByFrame> StageCache::tracks(const Point& point, const Motion& motion,
                                                       const std::vector<std::vector<Detection>>& detections,
                                                       const std::vector<TimedState>& states) {
    return tracks_.get(nameUpTo(point.options, point.scale, ChainStage::finishing), [&] {
        count(ChainStage::finishing);
        auto boxes = std::make_shared<BoxesByFrame>();
        const auto placeOf = [&motion](FrameIndex frame) -> std::optional<std::size_t> {
            const auto found =
                std::lower_bound(motion.begin(), motion.end(), frame,
                                 [](const FrameMotion& candidate, FrameIndex at) { return candidate.frame < at; });
            if (found == motion.end() || found->frame != frame) return std::nullopt;
            return static_cast<std::size_t>(found - motion.begin());
        };
        const VectorsAt vectors_at = [&](FrameIndex frame) {
            const auto place = placeOf(frame);
            return place ? motion[*place].motion_vectors : std::vector<MotionVector>{};
        };
        const ClassifiedAt classified_at = [&](FrameIndex frame) {
            const auto place = placeOf(frame);
            return place && *place < detections.size() ? classifiedOf(detections[*place])
                                                       : std::vector<ClassifiedBox>{};
        };
        for (const auto& [frame, state] :
             finishTracks(states, summariesOf(motion), point.options.finishing, point.scale,
                          {vectors_at, classifiedVehicles(point.options, classified_at)}))
            (*boxes)[frame].push_back(boxOf(frame, state));
        nameClasses(*boxes, point.scale, point.options.classes);
        return boxes;
    });
}

std::optional<ClipResult> StageCache::run(const ChainOptions& options, const std::stop_token& stop) {
    try {
        const SceneScale scale = scaleFor(options, stop);
        const Point point{options, scale, stop};
        const auto motion = this->motion(point);
        const auto detected = this->detected(point, *motion);
        const auto states = this->states(point, *motion, detected->frames);
        ClipResult result;
        result.detections = std::shared_ptr<const BoxesByFrame>(detected, &detected->boxes);
        result.tracks = tracks(point, *motion, detected->frames, *states);
        return result;
    } catch (const Stopped&) {
        return std::nullopt;
    }
}

}  // namespace eyrie
