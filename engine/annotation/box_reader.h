#pragma once

#include <memory>

#include "annotation/interpolation.h"

namespace eyrie {

/// Boxes of one object in many frames, as boxAt gives them: what is the same between two keyframes is worked out once,
/// so that frames in order cost little. Object and camera must outlive it and stay as they are. Used by one thread.
class BoxReader {
 public:
    BoxReader(const LabelledObject& object, const CameraMotion& camera, PathShape shape = PathShape::smooth);
    ~BoxReader();
    BoxReader(const BoxReader&) = delete;
    BoxReader& operator=(const BoxReader&) = delete;
    LabelledBox at(FrameIndex frame);
    /// Whether the object moves from this keyframe (by its place among all) to the next, over the ground or, without a
    /// camera, in the image: boxes between the two then depend on one more keyframe to either side, else on up to two.
    bool movesFrom(std::size_t keyframe);

 private:
    void goTo(std::size_t here);
    struct Piece;
    const LabelledObject& object_;
    const CameraMotion& camera_;
    PathShape shape_;
    std::unique_ptr<Piece> piece_;
};

}  // namespace eyrie
