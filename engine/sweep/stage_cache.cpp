#include "sweep/stage_cache.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "chain/chain.h"
#include "chain/recording/classified_vehicles.h"
#include "chain/scale_estimation.h"
#include "core/error.h"
#include "detection/detector_factory.h"
#include "detection/roi_cutter.h"

namespace eyrie {
namespace {

/// Leaves a computation that nobody waits for any more.
struct Stopped {};

void leaveIf(const std::stop_token& stop) {
    if (stop.stop_requested()) throw Stopped{};
}

BoxRecord recordOf(FrameIndex frame, const Detection& detection) {
    BoxRecord record;
    record.frame = frame;
    record.box = detection.box;
    record.score = shownScore(detection);
    record.velocity = detection.velocity;
    return record;
}

BoxRecord recordOf(FrameIndex frame, const TrackState& state) {
    BoxRecord record;
    record.frame = frame;
    record.id = state.id;
    record.box = state.box;
    record.score = state.score;
    record.velocity = state.velocity;
    record.origin = nameOf(state.origin);
    return record;
}

BoxesByFrame keptBoxes(const std::vector<FrameMotion>& motion, const std::vector<std::vector<Detection>>& detections) {
    BoxesByFrame boxes;
    for (std::size_t i = 0; i < detections.size(); ++i) {
        for (const Detection& detection : detections[i]) {
            if (detection.rejection == Rejection::none)
                boxes[motion[i].frame].push_back(recordOf(motion[i].frame, detection));
        }
    }
    return boxes;
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
    const auto shared = std::make_shared<const Motion>(std::move(motion));
    motion_.get(signatureUpTo(options, ChainStage::motion), [&] { return shared; });
}

SceneScale StageCache::scaleFor(const ChainOptions& options, const std::stop_token& stop) {
    SceneScale scale = scale_;
    if (options.view.oblique && options_.looked_for_slope) return scale;
    scale.slope = {};
    if (!options.view.oblique) return scale;
    scale.slope = *slopes_.get(signatureUpTo(options, ChainStage::detection), [&] {
        const auto source = frames_.openAnew();
        auto slope = std::make_shared<const ScaleSlope>(
            slopeFor(*source, {frames_.first(), frames_.last()}, options, scale, stop));
        leaveIf(stop);
        return slope;
    });
    return scale;
}

std::shared_ptr<StageCache::Motion> StageCache::computeMotion(const ChainOptions& options,
                                                              const std::stop_token& stop) {
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
    MotionHalf half(options, scaleFor(options, stop));
    ClipFrames::Reader reader = frames_.reader();
    for (FrameIndex i = frames_.first(); i <= frames_.last(); ++i) {
        leaveIf(stop);
        StageTimes times{};
        motion->push_back(half.next(reader.read(i), times));
        tell(ChainStage::motion, i - frames_.first() + 1);
    }
    return motion;
}

std::shared_ptr<const StageCache::Motion> StageCache::motion(const ChainOptions& options, const std::stop_token& stop) {
    return motion_.get(signatureUpTo(options, ChainStage::motion), [&] { return computeMotion(options, stop); });
}

std::shared_ptr<StageCache::Clusters> StageCache::differenceClusters(const ChainOptions& options, const Motion& motion,
                                                                     const std::stop_token& stop) {
    auto clusters = std::make_shared<Clusters>();
    DifferenceMotion difference(options.difference, scaleFor(options, stop));
    ClipFrames::Reader reader = frames_.reader();
    for (const FrameMotion& frame : motion) {
        leaveIf(stop);
        clusters->push_back(difference.next(reader.read(frame.frame), frame).clusters);
        tell(ChainStage::clustering, static_cast<int>(clusters->size()));
    }
    return clusters;
}

std::shared_ptr<const StageCache::Clusters> StageCache::clusters(const ChainOptions& options, const Motion& motion,
                                                                 const std::stop_token& stop) {
    return clusters_.get(signatureUpTo(options, ChainStage::clustering), [&]() -> std::shared_ptr<const Clusters> {
        count(ChainStage::clustering);
        if (options.difference.method != MotionMethod::vectors) return differenceClusters(options, motion, stop);
        auto clusters = std::make_shared<Clusters>(motion.size());
        const MotionClustering clustering(options.clustering, scaleFor(options, stop));
        forFrames(stop, [&](std::size_t i, ClipFrames::Reader&) { (*clusters)[i] = clustering.cluster(motion[i]); });
        return clusters;
    });
}

std::shared_ptr<const StageCache::Detections> StageCache::found(const ChainOptions& options, const Motion& motion,
                                                                const std::stop_token& stop) {
    const auto clusters = this->clusters(options, motion, stop);
    return found_.get(signatureUpTo(options, ChainStage::detection), [&] {
        count(ChainStage::detection);
        const std::size_t frame_count = motion.size();
        // Tables are shared by all that agree in their parameters and only ever grow, hence the casts.
        const auto prepared =
            std::const_pointer_cast<AreaTable<Prepared>>(prepared_.get(preparationSignature(options), [&] {
                return std::make_shared<const AreaTable<Prepared>>(frame_count, options_.area_bytes);
            }));
        const auto areas =
            std::const_pointer_cast<AreaTable<std::vector<Detection>>>(areas_.get(areaSignature(options), [&] {
                return std::make_shared<const AreaTable<std::vector<Detection>>>(frame_count, options_.area_bytes / 8);
            }));
        const SceneScale scale = scaleFor(options, stop);
        const std::unique_ptr<Detector> detector = makeDetector(options.detection, scale);
        auto detections = std::make_shared<Detections>(frame_count);
        forFrames(stop, [&](std::size_t i, ClipFrames::Reader& reader) {
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
                        made->roi = cutMotionRoi(*frame, cluster, 0, motion[i], options.detection, scale);
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

StageCache::Detections StageCache::detectionsByStacks(const ChainOptions& options, const Motion& motion,
                                                      const std::stop_token& stop) {
    count(ChainStage::stacking);
    Detections detections;
    TrackHalf half(options, scaleFor(options, stop));
    ClipFrames::Reader reader = frames_.reader();
    for (const FrameMotion& frame : motion) {
        leaveIf(stop);
        detections.push_back(half.next(reader.read(frame.frame), frame, {}).detections);
        tell(ChainStage::stacking, static_cast<int>(detections.size()));
    }
    return detections;
}

std::shared_ptr<const StageCache::Detected> StageCache::detected(const ChainOptions& options, const Motion& motion,
                                                                 const std::stop_token& stop) {
    return detected_.get(signatureUpTo(options, ChainStage::removal), [&] {
        auto detected = std::make_shared<Detected>();
        if (options.stacking.enabled) {
            // Stacks are started from the detections of the frame before: nothing behind can be done by itself.
            detected->frames = detectionsByStacks(options, motion, stop);
        } else {
            const auto found = this->found(options, motion, stop);
            count(ChainStage::removal);
            const SceneScale scale = scaleFor(options, stop);
            detected->frames.resize(motion.size());
            forFrames(stop, [&](std::size_t i, ClipFrames::Reader&) {
                detected->frames[i] = removed((*found)[i], motion[i], options, scale);
            });
        }
        detected->boxes = keptBoxes(motion, detected->frames);
        return detected;
    });
}

std::shared_ptr<const std::vector<TimedState>> StageCache::states(const ChainOptions& options, const Motion& motion,
                                                                  const Detections& detections,
                                                                  const std::stop_token& stop) {
    return states_.get(signatureUpTo(options, ChainStage::tracking), [&] {
        count(ChainStage::tracking);
        auto states = std::make_shared<std::vector<TimedState>>();
        Tracker tracker(options.tracking, scaleFor(options, stop));
        ClipFrames::Reader reader = frames_.reader();
        for (std::size_t i = 0; i < motion.size(); ++i) {
            leaveIf(stop);
            const PictureOfFrame picture = [&] { return reader.read(motion[i].frame).gray; };
            for (const TrackState& state : tracker.next(motion[i], detections[i], nullptr, picture))
                states->emplace_back(motion[i].frame, state);
        }
        return states;
    });
}

std::shared_ptr<const BoxesByFrame> StageCache::tracks(const ChainOptions& options, const Motion& motion,
                                                       const std::vector<std::vector<Detection>>& detections,
                                                       const std::vector<TimedState>& states,
                                                       const std::stop_token& stop) {
    return tracks_.get(signatureUpTo(options, ChainStage::finishing), [&] {
        const SceneScale scale = scaleFor(options, stop);
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
        const BoxesAt vehicles_at = [&](FrameIndex frame) {
            const auto place = placeOf(frame);
            return place && *place < detections.size() ? vehiclesOf(detections[*place]) : std::vector<OrientedBox>{};
        };
        for (const auto& [frame, state] : finishTracks(states, summariesOf(motion), options.finishing, scale,
                                                       {vectors_at, classifiedVehicles(options, vehicles_at)}))
            (*boxes)[frame].push_back(recordOf(frame, state));
        nameClasses(*boxes, scale, options.classes);
        return boxes;
    });
}

std::optional<ClipResult> StageCache::run(const ChainOptions& options, const std::stop_token& stop) {
    try {
        const auto motion = this->motion(options, stop);
        const auto detected = this->detected(options, *motion, stop);
        const auto states = this->states(options, *motion, detected->frames, stop);
        ClipResult result;
        result.detections = std::shared_ptr<const BoxesByFrame>(detected, &detected->boxes);
        result.tracks = tracks(options, *motion, detected->frames, *states, stop);
        return result;
    } catch (const Stopped&) {
        return std::nullopt;
    }
}

}  // namespace eyrie
