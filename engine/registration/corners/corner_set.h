#pragma once

#include <hwy/cache_control.h>

#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "core/values/ids.h"
#include "registration/corners/patch_alignment.h"

namespace eyrie {

/// A corner that is being tracked.
struct TrackedCorner {
    CornerId id = 0;
    cv::Point2f position{0, 0};   ///< px
    cv::Point2f offset{0, 0};     ///< from the centre of its patch to the corner, px in the present picture
    cv::Point2f velocity{0, 0};   ///< px/frame relative to the ground, in the axes of the present picture
    cv::Point2f drift{0, 0};      ///< slow mean of it, to tell movers from the background
    LocalTurn turn;               ///< present picture from the picture that its surrounding was stored from
    LocalTurn patch_turn;         ///< the same as it was when the patch was last made from the surrounding
    float position_variance = 0;  ///< px² per grey level² of noise, as last tracked
    float residual = 0;           ///< mean square, grey levels, as last tracked
    int age = 0;                  ///< frames since detection
    int patch_age = 0;            ///< frames since its surrounding was stored
    int slot = 0;                 ///< where patch and surrounding are stored
    bool on_background = false;
    bool moves = false;        ///< its drift stands out from that of the background
    cv::Point2f held{0, 0};    ///< px in the picture where it has stayed since …
    cv::Point2f ground{0, 0};  ///< … and where the ground that was there then is now
    int held_frames = 0;
    bool sticks = false;  ///< it belongs to the picture, not to the ground: dirt, vignette, compression
};

/// The tracked corners of one picture, ascending in id, with their patches. A value: copies are independent.
class CornerSet {
 public:
    explicit CornerSet(int window = kSmallestWindow) : window_(window) {}

    int window() const { return window_; }
    int size() const { return static_cast<int>(corners.size()); }

    const std::int16_t* patch(const TrackedCorner& corner) const {
        return patches_.data() + std::ptrdiff_t(corner.slot) * patchSamples(window_);
    }
    std::int16_t* patch(const TrackedCorner& corner) {
        return patches_.data() + std::ptrdiff_t(corner.slot) * patchSamples(window_);
    }

    /// What stood around the corner when it was stored; patches are made from it as the picture turns.
    std::int16_t* surrounding(const TrackedCorner& corner) {
        return surroundings_.data() + std::ptrdiff_t(corner.slot) * surroundingSamples(window_);
    }

    /// Asks the memory for a patch that will soon be needed.
    void prefetchPatch(const TrackedCorner& corner) const {
        const auto* bytes = reinterpret_cast<const char*>(patch(corner));
        const int count = patchSamples(window_) * static_cast<int>(sizeof(std::int16_t));
        for (int offset = 0; offset < count; offset += 64) hwy::Prefetch(bytes + offset);
    }

    /// Room for one more patch.
    int takeSlot() {
        if (!free_slots_.empty()) {
            const int slot = free_slots_.back();
            free_slots_.pop_back();
            return slot;
        }
        const int slot = slots_++;
        patches_.resize(std::size_t(slots_) * std::size_t(patchSamples(window_)));
        surroundings_.resize(std::size_t(slots_) * std::size_t(surroundingSamples(window_)));
        return slot;
    }
    void giveBack(int slot) { free_slots_.push_back(slot); }

    template <class Predicate>
    void removeIf(Predicate unwanted) {
        std::erase_if(corners, [&](const TrackedCorner& corner) {
            const bool leaves = unwanted(corner);
            if (leaves) giveBack(corner.slot);
            return leaves;
        });
    }

    /// Corners and patches, written or read; see core/state_archive.h. The set must be made for the same window.
    template <class Archive>
    void transfer(Archive& archive);

    std::vector<TrackedCorner> corners;

 private:
    int window_;
    int slots_ = 0;
    std::vector<std::int16_t> patches_;
    std::vector<std::int16_t> surroundings_;
    std::vector<int> free_slots_;
};

}  // namespace eyrie
