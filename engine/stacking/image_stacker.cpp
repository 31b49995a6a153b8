#include "stacking/image_stacker.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "core/geometry/angle.h"
#include "imaging/upright_patch.h"

namespace eyrie {
namespace {

constexpr double kShownLengths = 2.5;  ///< of a standard vehicle, along the motion
constexpr double kShownWidths = 1.25;  ///< of its length, across the motion
const cv::Size kFewestShown(16, 32);

double squaredDistance(cv::Point2f a, cv::Point2f b) {
    const cv::Point2f d = a - b;
    return static_cast<double>(d.x) * d.x + static_cast<double>(d.y) * d.y;
}

OrientedBox stackArea(const MasterPose& pose, cv::Size area) {
    return {pose.position, static_cast<double>(area.height), static_cast<double>(area.width), pose.heading};
}

/// The clusters with those members only that come from corners: inferred ones last for one frame.
std::vector<MotionCluster> cornersOf(std::vector<MotionCluster> clusters, const FrameMotion& motion) {
    for (MotionCluster& cluster : clusters) {
        std::erase_if(cluster.members,
                      [&](int member) { return motion.motion_vectors[static_cast<std::size_t>(member)].isInferred(); });
    }
    return clusters;
}

}  // namespace

void StackingOptions::describe(ParameterVisitor& v) {
    const ParameterDeclarer declare(v, ChainStage::stacking);
    declare.flag("stacking.enabled", enabled,
                 {"", "Search stacked images of each object in place of the single frame.", "Teutsch §5.3"});
    declare.choice(
        "stacking.initialisation", initialisation, {"detections", "k_means"},
        {"", "What new stacks are started from: detections of the frame before, or k-means on motion vectors.",
         "Teutsch §5.3.1"});
    declare.choice("stacking.arrangement", arrangement, {"accumulation", "circular_mean", "circular_median"},
                   {"", "How layers are kept and merged.", "Teutsch §5.3.3, eq. 5.1 and 5.2"});
    declare.integer("stacking.capacity", capacity, 2, 500,
                    {"layers", "Layers kept in a circular stack, H.", "Teutsch §7.3.4"});
    declare.integer("stacking.min_height", min_height, 1, 500,
                    {"layers", "Layers a stack needs before it is used, H_min.", "Teutsch §5.3.4"});
    declare.real("stacking.area_length", area_length_m, 5, 500,
                 {"m", "Length of the stack area along the motion.", "Teutsch §7.3.4: 345 px"});
    declare.real("stacking.area_width", area_width_m, 3, 200,
                 {"m", "Width of the stack area across the motion.", "Teutsch §7.3.4: 115 px"});
    declare.integer("stacking.neighbours", neighbours, 1, 25,
                    {"vectors", "Neighbours that vote for a new vector's stack, k.", "Teutsch §5.3.2"});
    declare.flag(
        "stacking.follow_lone_vectors", follow_lone_vectors,
        {"",
         "The vectors of a stack carry it even while they lie in no cluster, by their own direction. Off: they "
         "are lost to it there, as single directions blur its edges.",
         "Teutsch §5.3.2"});
    declare.real(
        "stacking.max_speed_difference", max_speed_difference, 0.01, 2,
        {"", "A stack replaces a cluster only if their speeds differ by no more than this share.", "Teutsch §5.3.4"});
    declare.real("stacking.max_turn", max_turn_deg, 1, 180,
                 {"degrees", "A stack replaces a cluster only if their directions differ by no more than this.",
                  "Teutsch §5.3.4"});
    declare.real("stacking.vehicle_length", vehicle_length_m, 1, 30,
                 {"m", "Length of a standard vehicle, from which the k of k-means follows.", "Teutsch §5.3.1"});
}

StackingOptions StackingOptions::thesis() {
    StackingOptions options;
    options.enabled = true;
    options.follow_lone_vectors = true;
    return options;
}

ImageStacker::ImageStacker(const StackingOptions& options, const SceneScale& scale)
    : options_(options),
      scale_(scale),
      area_(std::clamp(cvRound(scale.px(options.area_width_m)), 16, 1024),
            std::clamp(cvRound(scale.px(options.area_length_m)), 32, 2048)) {}

std::vector<ImageStacker::Placed> ImageStacker::placeVectors(const FrameMotion& motion,
                                                             const std::vector<MotionCluster>& clusters) const {
    std::vector<Placed> placed(motion.motion_vectors.size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const MotionVector& vector = motion.motion_vectors[i];
        placed[i].vector = &vector;
        placed[i].direction =
            std::atan2(static_cast<double>(vector.velocity.y), static_cast<double>(vector.velocity.x));
    }
    // Single directions fluctuate; the cluster's is steadier and keeps edges sharp (§5.3).
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        for (const int member : clusters[c].members) {
            placed[static_cast<std::size_t>(member)].direction = clusters[c].box.heading;
            placed[static_cast<std::size_t>(member)].cluster = static_cast<int>(c);
        }
    }
    return placed;
}

void ImageStacker::moveMasters(const std::vector<Placed>& placed) {
    std::map<int, std::vector<MasterVector::Suggestion>> suggestions;
    for (const auto& p : placed) {
        const auto owner = owner_.find(p.vector->id);
        if (owner == owner_.end()) continue;
        if (p.cluster >= 0 || options_.follow_lone_vectors)
            suggestions[owner->second].push_back({p.vector, p.direction});
    }
    std::erase_if(entries_, [&](Entry& entry) { return !entry.master.update(suggestions[entry.master.id()]); });
    owner_.clear();
    for (const auto& entry : entries_) {
        for (const CornerId id : entry.master.related()) owner_[id] = entry.master.id();
    }
}

void ImageStacker::relateNewVectors(const std::vector<Placed>& placed, const std::vector<MotionCluster>& clusters) {
    std::vector<std::pair<const Placed*, int>> related;
    for (const auto& cluster : clusters) {
        for (const int member : cluster.members) {
            const Placed& newcomer = placed[static_cast<std::size_t>(member)];
            if (owner_.count(newcomer.vector->id)) continue;
            std::vector<std::pair<double, int>> voters;
            for (const int other : cluster.members) {
                const Placed& neighbour = placed[static_cast<std::size_t>(other)];
                const auto owner = owner_.find(neighbour.vector->id);
                if (owner == owner_.end()) continue;
                voters.emplace_back(squaredDistance(neighbour.vector->position, newcomer.vector->position),
                                    owner->second);
            }
            if (voters.empty()) continue;
            const auto count = std::min(voters.size(), static_cast<std::size_t>(options_.neighbours));
            std::partial_sort(voters.begin(), voters.begin() + static_cast<std::ptrdiff_t>(count), voters.end());
            std::map<int, int> votes;
            int winner = voters.front().second;  // the nearest decides a tie
            for (std::size_t i = 0; i < count; ++i) ++votes[voters[i].second];
            for (const auto& [master, number] : votes) {
                if (number > votes[winner]) winner = master;
            }
            related.emplace_back(&newcomer, winner);
        }
    }
    for (const auto& [newcomer, master] : related) {
        for (auto& entry : entries_) {
            if (entry.master.id() == master) entry.master.relate(*newcomer->vector, newcomer->direction);
        }
        owner_[newcomer->vector->id] = master;
    }
}

void ImageStacker::start(const std::vector<const Placed*>& members) {
    if (members.empty()) return;
    std::vector<double> x, y, headings, vx, vy;
    for (const auto* member : members) {
        x.push_back(member->vector->position.x);
        y.push_back(member->vector->position.y);
        headings.push_back(member->direction);
        vx.push_back(member->vector->velocity.x);
        vy.push_back(member->vector->velocity.y);
    }
    const MasterPose pose{
        {lowerMedian(x), lowerMedian(y)}, medianHeading(headings), {lowerMedian(vx), lowerMedian(vy)}};
    Entry entry{MasterVector(next_id_++, pose), ImageStack(options_.arrangement, area_, options_.capacity)};
    for (const auto* member : members) {
        entry.master.relate(*member->vector, member->direction);
        owner_[member->vector->id] = entry.master.id();
    }
    entries_.push_back(std::move(entry));
}

void ImageStacker::startFromDetections(const std::vector<Placed>& placed) {
    std::map<CornerId, const Placed*> by_id;
    for (const auto& p : placed) by_id[p.vector->id] = &p;
    for (const auto& ids : remembered_) {
        std::vector<const Placed*> free;
        std::map<int, int> owners;
        int present = 0;
        for (const CornerId id : ids) {
            const auto at = by_id.find(id);
            if (at == by_id.end() || at->second->cluster < 0) continue;
            ++present;
            const auto owner = owner_.find(id);
            if (owner == owner_.end()) {
                free.push_back(at->second);
            } else {
                ++owners[owner->second];
            }
        }
        // A detection most of whose vectors already have one stack is that stack's object, unless the stack's master
        // vector lies in another detection: then two objects shared it, and this one gets its own.
        bool has_stack = false;
        for (const auto& [master, count] : owners) has_stack = has_stack || 2 * count >= present;
        if (has_stack) {
            for (const auto& entry : entries_) {
                const auto own = owners.find(entry.master.id());
                if (own == owners.end() || 2 * own->second < present) continue;
                if (2 * own->second < static_cast<int>(entry.master.related().size())) {
                    has_stack = false;
                    for (const CornerId id : ids) {
                        const auto at = by_id.find(id);
                        if (at != by_id.end() && at->second->cluster >= 0 && owner_.count(id))
                            free.push_back(at->second);
                    }
                }
                break;
            }
        }
        if (!has_stack) start(free);
    }
}

void ImageStacker::startFromClusters(const std::vector<Placed>& placed, const std::vector<MotionCluster>& clusters,
                                     const SceneScale& scale) {
    for (const auto& cluster : clusters) {
        std::vector<const Placed*> free;
        for (const int member : cluster.members) {
            const Placed& p = placed[static_cast<std::size_t>(member)];
            if (!owner_.count(p.vector->id)) free.push_back(&p);
        }
        if (free.size() < 3) continue;
        const double vehicle = scale.at(cluster.box.centre).px(options_.vehicle_length_m);
        const double vehicles = cluster.box.length / vehicle;
        const int k = std::clamp(static_cast<int>(std::lround(vehicles)), 1, static_cast<int>(free.size()));
        cv::Mat points(static_cast<int>(free.size()), 4, CV_32F);
        const double speed = std::max(std::hypot(cluster.velocity.x, cluster.velocity.y), 1e-3);
        const auto motion_weight = static_cast<float>(vehicle / speed);
        for (int i = 0; i < points.rows; ++i) {
            const MotionVector& vector = *free[static_cast<std::size_t>(i)]->vector;
            points.at<float>(i, 0) = vector.position.x;
            points.at<float>(i, 1) = vector.position.y;
            points.at<float>(i, 2) = vector.velocity.x * motion_weight;
            points.at<float>(i, 3) = vector.velocity.y * motion_weight;
        }
        cv::Mat labels;
        cv::theRNG().state = 1;  // the same start for every call, so that runs repeat
        cv::kmeans(points, k, labels, {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.1}, 2,
                   cv::KMEANS_PP_CENTERS);
        for (int group = 0; group < k; ++group) {
            std::vector<const Placed*> members;
            for (int i = 0; i < points.rows; ++i) {
                if (labels.at<int>(i) == group) members.push_back(free[static_cast<std::size_t>(i)]);
            }
            start(members);
        }
    }
}

StackLayer ImageStacker::layerOf(const Frame& frame, const MasterPose& pose) const {
    return {frame.gray, imageFromPatch(stackArea(pose, area_), area_), area_, frame.index};
}

void ImageStacker::update(const Frame& frame, const FrameMotion& motion, const std::vector<MotionCluster>& found) {
    if (!motion.registration.reliable()) {
        remembered_.clear();
        return;
    }
    const std::vector<MotionCluster> clusters = cornersOf(found, motion);
    const std::vector<Placed> placed = placeVectors(motion, clusters);
    moveMasters(placed);
    relateNewVectors(placed, clusters);
    if (options_.initialisation == StackInitialisation::detections) {
        startFromDetections(placed);
    } else {
        startFromClusters(placed, clusters, scale_.zoomed(motion.registration.zoom));
    }
    std::erase_if(entries_, [](const Entry& entry) { return entry.master.related().empty(); });
    // Accumulation cuts whole areas at once; the circular arrangements cut nothing here.
    cv::parallel_for_(cv::Range(0, static_cast<int>(entries_.size())), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            Entry& entry = entries_[static_cast<std::size_t>(i)];
            entry.stack.add(layerOf(frame, entry.master.pose()));
        }
    });
    remembered_.clear();
}

std::vector<MotionRoi> ImageStacker::replace(const MotionCluster& cluster, int cluster_index,
                                             const OrientedBox& extended, const FrameMotion& motion) const {
    std::vector<MotionRoi> rois;
    const double speed = std::hypot(cluster.velocity.x, cluster.velocity.y);
    for (const auto& entry : entries_) {
        const MasterPose& pose = entry.master.pose();
        const double difference = std::abs(std::hypot(pose.velocity.x, pose.velocity.y) - speed);
        const double turn = std::abs(turnBetween(pose.heading, cluster.box.heading));
        if (difference > options_.max_speed_difference * std::max(speed, 1e-6)) continue;
        if (turn > radiansFromDegrees(options_.max_turn_deg)) continue;
        if (!cluster.box.contains(pose.position) || !entry.isSearched(options_)) continue;

        const cv::Matx23d image_from_stack = imageFromPatch(stackArea(pose, area_), area_);
        std::vector<cv::Point2d> corners;
        for (const auto& corner : extended.corners()) corners.push_back(toPatch(image_from_stack, corner));
        const OrientedBox around = boxAround(corners, 0);
        const cv::Rect part(cv::Point(static_cast<int>(std::floor(around.centre.x - around.length / 2)),
                                      static_cast<int>(std::floor(around.centre.y - around.width / 2))),
                            cv::Point(static_cast<int>(std::ceil(around.centre.x + around.length / 2)) + 1,
                                      static_cast<int>(std::ceil(around.centre.y + around.width / 2)) + 1));
        if ((part & cv::Rect({0, 0}, area_)) != part) continue;

        MotionRoi roi;
        roi.image = entry.stack.stacked(part);
        roi.image_from_roi = image_from_stack;
        const cv::Point2d origin = toImage(image_from_stack, part.tl());
        roi.image_from_roi(0, 2) = origin.x;
        roi.image_from_roi(1, 2) = origin.y;
        roi.inside = insideMask(roi.image_from_roi, part.size(), motion.image_size);
        roi.box = extended;
        roi.cluster = cluster_index;
        roi.velocity = cluster.velocity;
        roi.zoom = motion.registration.zoom;
        roi.stack_layers = entry.stack.height();
        for (const int member : cluster.members) {
            const cv::Point2d p =
                toPatch(roi.image_from_roi, motion.motion_vectors[static_cast<std::size_t>(member)].position);
            roi.vectors.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y));
        }
        rois.push_back(std::move(roi));
    }
    return rois;
}

void ImageStacker::remember(const FrameMotion& motion, const std::vector<Detection>& detections) {
    remembered_.clear();
    for (const auto& detection : detections) {
        if (detection.rejection != Rejection::none) continue;
        std::vector<CornerId> ids;
        for (const int index : detection.vectors) {
            const MotionVector& vector = motion.motion_vectors[static_cast<std::size_t>(index)];
            if (!vector.isInferred()) ids.push_back(vector.id);
        }
        if (!ids.empty()) remembered_.push_back(std::move(ids));
    }
}

cv::Rect ImageStacker::shownPart(StackPictures pictures) const {
    if (pictures == StackPictures::none) return {};
    if (pictures == StackPictures::whole_area) return {{0, 0}, area_};
    const double vehicle = scale_.px(options_.vehicle_length_m);
    const cv::Size size(std::clamp(cvRound(kShownWidths * vehicle), kFewestShown.width, area_.width),
                        std::clamp(cvRound(kShownLengths * vehicle), kFewestShown.height, area_.height));
    return {{(area_.width - size.width) / 2, (area_.height - size.height) / 2}, size};
}

std::vector<StackView> ImageStacker::views(const Frame& frame, StackPictures pictures) const {
    std::vector<StackView> views;
    std::vector<const Entry*> shown;
    for (const auto& entry : entries_) {
        if (entry.stack.height() == 0) continue;
        views.push_back({entry.master.id(),
                         entry.master.pose(),
                         entry.stack.height(),
                         entry.isSearched(options_),
                         entry.master.related(),
                         {},
                         {}});
        shown.push_back(&entry);
    }
    const cv::Rect part = shownPart(pictures);
    if (part.empty()) return views;
    cv::parallel_for_(cv::Range(0, static_cast<int>(views.size())), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            StackView& view = views[static_cast<std::size_t>(i)];
            view.stacked = shown[static_cast<std::size_t>(i)]->stack.stacked(part);
            view.raw = layerOf(frame, view.pose).cut(part);
        }
    });
    return views;
}

void ImageStacker::reset() {
    entries_.clear();
    owner_.clear();
    remembered_.clear();
}

}  // namespace eyrie
