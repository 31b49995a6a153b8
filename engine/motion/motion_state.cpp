// What independent motion and difference images remember between frames, as bytes and back.
#include <cmath>

#include "core/state_values.h"
#include "motion/differences/difference_motion.h"
#include "motion/vectors/independent_motion.h"

namespace eyrie {

template <class Archive>
void CornerHistory::transfer(Archive& archive) {
    archive(step_);
    archive.require(step_ >= -1, "a negative number of pictures");
    std::size_t corners = archive.count(entries_.size());
    if constexpr (Archive::reading) {
        const std::int64_t step = step_;
        clear();
        step_ = step;
    }
    for (std::size_t i = 0; i < corners; ++i) {
        if constexpr (Archive::reading) entries_.push_back({0, takeSlot(), 0});
        int known = Archive::reading ? 0 : steps(i);
        archive(entries_[i].id, known);
        archive.require(i == 0 || entries_[i - 1].id < entries_[i].id, "corners in disorder");
        archive.require(known >= 0 && known <= depth_ && known <= step_, "a corner's past is too long");
        // How long a corner has been known counts up to the depth only.
        if constexpr (Archive::reading) entries_[i].first_step = step_ - known;
        for (int n = 0; n <= known; ++n) archive(position(entries_[i].slot, step_ - n));
    }
}

template <class Archive>
void RegisteredFrames::Picture::transfer(Archive& archive) {
    archive(newest_from_it, frames_ago);
    gray = archive.picture(newest_from_it.from_frame, gray);
    const double determinant = cv::determinant(newest_from_it.matrix);
    archive.require(frames_ago >= 0, "a picture of the future");
    archive.require(std::isfinite(determinant) && determinant != 0, "a picture without a way to it");
}

template <class Archive>
void RegisteredFrames::transfer(Archive& archive) {
    archive(pictures_, last_frame_);
    archive.require(static_cast<int>(pictures_.size()) <= depth_ + 1, "too many pictures");
    for (const Picture& picture : pictures_) {
        archive.require(last_frame_ && picture.newest_from_it.to_frame == *last_frame_, "a picture beside the way");
    }
}

template <class Archive>
void Silhouettes::transfer(Archive& archive) {
    archive(frames_, next_id_);
}

template <class Archive>
void MovingAreas::transfer(Archive& archive) {
    archive(frames_, next_id_);
}

template <class Archive>
void IndependentMotion::Path::transfer(Archive& archive) {
    archive(current_from_past, frames);
    archive.require(frames >= 0, "a way of negative length");
}

template <class Archive>
void IndependentMotion::transfer(Archive& archive) {
    archive(silhouettes_, areas_, history_, paths_, newest_, any_picture_, last_frame_, last_motion_);
    if (!any_picture_) return;
    const auto arrives = [&](const Path& path) {
        return last_frame_ && path.current_from_past.to_frame == *last_frame_;
    };
    archive.require(arrives(newest_), "a way that ends elsewhere");
    for (const Path& path : paths_) archive.require(arrives(path), "a way that ends elsewhere");
    archive.require(history_.longest() <= static_cast<int>(paths_.size()), "corners without a way to their past");
}

/// The images of the last answer are for looking at it only.
template <class Archive>
void DifferenceMotion::transfer(Archive& archive) {
    archive(frames_, last_.clusters, last_.noise, last_.threshold);
}

template void IndependentMotion::transfer(StateWriter&);
template void IndependentMotion::transfer(StateReader&);
template void DifferenceMotion::transfer(StateWriter&);
template void DifferenceMotion::transfer(StateReader&);

}  // namespace eyrie
