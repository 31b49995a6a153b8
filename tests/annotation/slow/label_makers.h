#pragma once

#include <random>

#include "annotation/scenes.h"
#include "core/geometry/angle.h"

namespace eyrie::test {

/// Makes labels of every kind, the same ones for the same seed.
class LabelMaker {
 public:
    explicit LabelMaker(unsigned seed) : dice_(seed) {}

    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(dice_); }
    int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(dice_); }
    bool happens(double share) { return between(0, 1) < share; }

    /// Something that drives about from a frame on.
    LabelledObject object(ObjectId id, FrameIndex first, int keyframes) {
        LabelledObject made;
        made.id = id;
        made.notes = "notes of " + std::to_string(id);
        made.colour = static_cast<std::uint32_t>(id);
        FrameIndex frame = first;
        OrientedBox box{{between(40, 260), between(40, 200)}, between(14, 30), between(6, 14), between(-3, 3)};
        const bool upright = happens(0.15);
        const double sets = happens(0.5) ? 1 : 0.5;
        for (int i = 0; i < keyframes; ++i) {
            Keyframe each = keyframe(frame, box, happens(sets));
            if (upright) each.box.heading = kPi / 2 * number(-1, 2);
            each.computed = happens(0.6);
            each.outside = i > 0 && happens(0.1);
            each.ignore = happens(0.2);
            each.occlusion = static_cast<Occlusion>(happens(0.7) ? 0 : number(0, 2));
            made.keyframes.push_back(each);
            const int frames = number(1, 14);
            box.heading = wrapPi(box.heading + between(-0.5, 0.5));
            box.centre += cv::Point2d(std::cos(box.heading), std::sin(box.heading)) * (between(-0.3, 3) * frames);
            box.length *= between(0.95, 1.05);
            box.width *= between(0.95, 1.05);
            frame += frames;
        }
        made.last_frame = made.keyframes.back().frame + (happens(0.5) ? 0 : number(0, 20));
        return made;
    }

 private:
    std::mt19937 dice_;
};

/// A camera that stands, flies, loses the ground now and then or knows nothing.
inline CameraMotion cameraOfKind(int kind, FrameIndex last) {
    auto steps = stepsOf(flyingView, last);
    if (kind % 4 == 0) return CameraMotion::standing(0, last);
    if (kind % 4 == 1) return CameraMotion(steps);
    if (kind % 4 == 2) return {};
    for (int i = static_cast<int>(steps.size()) - 5; i > 0; i -= 37) steps.erase(steps.begin() + i);
    return CameraMotion(steps);
}

}  // namespace eyrie::test
