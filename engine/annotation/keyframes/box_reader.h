#pragma once

#include <memory>

#include "annotation/keyframes/interpolation.h"

namespace eyrie {

class CarriedBoxes;

/// Boxes of one object in many frames, as boxAt gives them: what is the same between two keyframes is worked out once,
/// so that frames in order cost little. Object and camera must outlive it and stay as they are. Used by one thread.
class BoxReader {
 public:
    /// `known`, if given, keeps what was carried over the ground for other readers of objects with the same keyframes.
    BoxReader(const LabelledObject& object, const CameraMotion& camera, PathShape shape = PathShape::smooth,
              CarriedBoxes* known = nullptr);
    ~BoxReader();
    BoxReader(const BoxReader&) = delete;
    BoxReader& operator=(const BoxReader&) = delete;
    LabelledBox at(FrameIndex frame);

 private:
    struct Piece;
    const LabelledObject& object_;
    const CameraMotion& camera_;
    PathShape shape_;
    CarriedBoxes* known_;
    std::unique_ptr<Piece> piece_;
};

}  // namespace eyrie
