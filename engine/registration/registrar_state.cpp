// What the registrar remembers between frames, as bytes and back.
#include <cmath>

#include "core/state_values.h"
#include "registration/registrar.h"

namespace eyrie {
namespace {

bool usable(cv::Point2f p) {
    constexpr float kFar = 1e6F;  // px
    return std::abs(p.x) < kFar && std::abs(p.y) < kFar;
}

cv::Mat headerOf(const PaddedPicture& picture) {
    return {picture.height(), picture.width(), CV_8UC1, const_cast<std::uint8_t*>(picture.row(0)),
            static_cast<std::size_t>(picture.stride())};
}

}  // namespace

template <class Archive>
void transfer(Archive& archive, LocalTurn& turn) {
    archive(turn.xx, turn.xy, turn.yx, turn.yy);
}

/// All but the slot, which is only a place in memory.
template <class Archive>
void transfer(Archive& archive, TrackedCorner& corner) {
    archive(corner.id, corner.position, corner.offset, corner.velocity, corner.drift, corner.turn, corner.patch_turn,
            corner.position_variance, corner.residual, corner.age, corner.patch_age, corner.on_background, corner.moves,
            corner.held, corner.ground, corner.held_frames, corner.sticks);
    archive.require(usable(corner.position) && usable(corner.offset) && usable(corner.velocity) &&
                        usable(corner.held) && usable(corner.ground) && corner.age >= 0 && corner.held_frames >= 0,
                    "a corner that cannot be");
}

template <class Archive>
void CornerSet::transfer(Archive& archive) {
    int window = window_;
    archive(window, corners);
    archive.require(window == window_, "corners of another window");
    for (std::size_t i = 0; i < corners.size(); ++i) {
        TrackedCorner& corner = corners[i];
        archive.require(i == 0 || corners[i - 1].id < corner.id, "corners in disorder");
        if constexpr (Archive::reading) corner.slot = takeSlot();
        archive.numbers(patch(corner), std::size_t(patchSamples(window_)));
        archive.numbers(surrounding(corner), std::size_t(surroundingSamples(window_)));
    }
}

template <class Archive>
void BurnedInGraphics::transfer(Archive& archive) {
    archive(size_, level_, way_, looks_, along_x_, along_y_, energy_, weight_);
    archive.require(level_ >= 0 && level_ < ImagePyramid::kMaxLevels, "a level that no picture has");
    archive.require(size_.width >= 0 && size_.height >= 0, "a picture of negative size");
    for (const auto* sum : {&along_x_, &along_y_, &energy_, &weight_})
        archive.require(sum->size() == pixels(), "sums of another picture");
    std::vector<std::uint8_t> marked;
    if (!mask_.empty()) marked.assign(mask_.cells.datastart, mask_.cells.dataend);
    archive(marked);
    archive.require(marked.empty() || marked.size() == pixels(), "graphics of another picture");
    if constexpr (Archive::reading) {
        mask_ = {};
        if (!marked.empty()) mask_ = {cv::Mat(levelSize(), CV_8UC1, marked.data()).clone(), 1 << level_};
    }
}

template <class Archive>
void ZoomFollower::transfer(Archive& archive) {
    archive(zoom_log_, zooming_, pending_);
    archive.require(std::abs(zoom_log_) < 10 && pending_.size() <= window_, "a zoom that no camera has");
}

template <class Archive>
void ClockFollower::transfer(Archive& archive) {
    archive(last_time_us_, ahead_);
    archive.require(last_time_us_ >= 0 && ahead_ >= 0 && ahead_ < 1e3, "a clock that cannot be");
}

template <class Archive>
void Registrar::Anchor::transfer(Archive& archive) {
    if constexpr (Archive::reading) {
        pyramid.build(archive.picture(frame, {}));
    } else {
        archive.picture(frame, headerOf(pyramid.level(0)));
    }
    corners.transfer(archive);
    archive(noise, latest_from_anchor, frames_ago, time_us);
    archive.require(time_us >= 0, "a picture before the video");
}

template <class Archive>
void Registrar::transfer(Archive& archive) {
    const auto anchor = [&](std::optional<Anchor>& one) {
        bool there = one.has_value();
        archive(there);
        if constexpr (Archive::reading) {
            one.reset();
            if (there) one.emplace(Anchor{{}, CornerSet(tracker_.window())});
        }
        if (one) one->transfer(archive);
    };
    anchor(anchor_);
    anchor(older_);
    graphics_.transfer(archive);
    zoom_.transfer(archive);
    archive(repetition_, motion_, recent_, repeated_, usual_corners_, last_frame_);
    clock_.transfer(archive);
    archive(next_id_);
    for (const auto* one : {&anchor_, &older_}) {
        archive.require(!*one || (*one)->corners.size() == 0 || (*one)->corners.corners.back().id < next_id_,
                        "a corner from the future");
    }
    if constexpr (Archive::reading) {
        zoomTo(zoom_.zoom());
        estimator_.reset();
        if (anchor_) estimator_.emplace(options_.homography, anchor_->pyramid.size());
    }
}

template void Registrar::transfer(StateWriter&);
template void Registrar::transfer(StateReader&);

}  // namespace eyrie
