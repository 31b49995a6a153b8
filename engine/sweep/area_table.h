#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/values/motion_cluster.h"

namespace eyrie {

/// Whether two clusters give the same search area with the same vectors in it.
inline bool sameCluster(const MotionCluster& a, const MotionCluster& b) {
    return a.box.centre == b.box.centre && a.box.length == b.box.length && a.box.width == b.box.width &&
           a.box.heading == b.box.heading && a.velocity == b.velocity && a.members == b.members &&
           a.moving_points == b.moving_points;
}

/// What was found out about the search areas of a clip, by frame and cluster, whatever parameters made the cluster.
/// Several threads may use it at once.
template <class Value>
class AreaTable {
 public:
    /// Once more than `max_bytes` are kept, nothing is added.
    AreaTable(std::size_t frames, std::size_t max_bytes) : frames_(frames), max_bytes_(max_bytes) {}

    std::shared_ptr<const Value> find(std::size_t frame, const MotionCluster& cluster) const {
        const Frame& at = frames_[frame];
        const std::scoped_lock lock(at.mutex);
        const auto [begin, end] = at.entries.equal_range(hashOf(cluster));
        for (auto entry = begin; entry != end; ++entry) {
            if (sameCluster(entry->second.cluster, cluster)) return entry->second.value;
        }
        return nullptr;
    }

    /// `bytes`: what the value takes, roughly.
    void keep(std::size_t frame, const MotionCluster& cluster, std::shared_ptr<const Value> value, std::size_t bytes) {
        const std::size_t whole = bytes + sizeof(Entry) + cluster.members.size() * sizeof(int) +
                                  cluster.moving_points.size() * sizeof(cv::Point2f);
        if (bytes_.fetch_add(whole, std::memory_order_relaxed) + whole > max_bytes_) {
            bytes_.fetch_sub(whole, std::memory_order_relaxed);
            return;
        }
        Frame& at = frames_[frame];
        const std::scoped_lock lock(at.mutex);
        at.entries.emplace(hashOf(cluster), Entry{cluster, std::move(value)});
    }

    std::size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
    struct Entry {
        MotionCluster cluster;
        std::shared_ptr<const Value> value;
    };
    struct Frame {
        mutable std::mutex mutex;
        std::unordered_multimap<std::size_t, Entry> entries;
    };
    static std::size_t hashOf(const MotionCluster& cluster) {
        const std::hash<double> hash;
        return hash(cluster.box.centre.x) ^ (hash(cluster.box.centre.y) * 31) ^ cluster.members.size();
    }

    std::vector<Frame> frames_;
    std::size_t max_bytes_;
    std::atomic<std::size_t> bytes_{0};
};

}  // namespace eyrie
