#include "annotation/keyframes/box_reader.h"

#include <algorithm>
#include <cmath>

#include "annotation/edits/carried_boxes.h"
#include "annotation/keyframes/keyframe_path.h"
#include "core/geometry/angle.h"
#include "core/geometry/upright.h"

namespace eyrie {
namespace {

using Keyframes = std::vector<Keyframe>;

/// Boxes along the image's axes are those of somebody (or some file) who does not turn boxes.
bool drawnUpright(const Keyframe& keyframe) {
    return keyframe.heading_set && isUpright(keyframe.box);
}

/// Whether boxes between a keyframe and the next (after the last one: the one before) stay upright in the image,
/// however the camera turns. One alone may just lie so.
bool staysUpright(const std::vector<Keyframe>& keyframes, std::size_t here) {
    if (keyframes.size() < 2) return false;
    const Keyframe& a = keyframes[here];
    const Keyframe& b = keyframes[here + 1 < keyframes.size() ? here + 1 : here - 1];
    return drawnUpright(a) && drawnUpright(b) && std::abs(turnBetween(a.box.heading, b.box.heading)) < 1e-9;
}

/// Keyframes as knots in the image of a reference frame, over the ground or as they are.
class KnotMaker {
 public:
    KnotMaker(FrameIndex reference, const CameraMotion* camera, CarriedBoxes* known)
        : reference_(reference), camera_(camera), known_(known) {}

    std::optional<Knot> make(const Keyframe& keyframe) const {
        std::optional<OrientedBox> box = keyframe.box;
        if (camera_ != nullptr) {
            box = known_ != nullptr ? known_->carried(keyframe.box, keyframe.frame, reference_)
                                    : carriedBox(keyframe.box, keyframe.frame, reference_, *camera_);
        }
        if (!box) return std::nullopt;
        return Knot{static_cast<double>(keyframe.frame - reference_),
                    box->centre,
                    box->length,
                    box->width,
                    box->heading,
                    keyframe.heading_set,
                    drawnUpright(keyframe)};
    }

    bool onGround() const { return camera_ != nullptr; }

 private:
    FrameIndex reference_;
    const CameraMotion* camera_;
    CarriedBoxes* known_;
};

/// The path around a keyframe, and which of its knots that is. An object that was outside the image has no path there.
struct LocalPath {
    KeyframePath path;
    std::size_t here = 0;
};

std::optional<LocalPath> pathAround(const LabelledObject& object, std::size_t here, std::size_t reach,
                                    const KnotMaker& maker, PathShape shape) {
    const Keyframes& keyframes = object.keyframes;
    std::array<Knot, 2> before;
    std::size_t earlier = 0;
    while (earlier < reach && here > earlier) {
        const Keyframe& keyframe = keyframes[here - earlier - 1];
        const auto knot = keyframe.outside ? std::nullopt : maker.make(keyframe);
        if (!knot) break;
        before[earlier++] = *knot;
    }
    const auto own = maker.make(keyframes[here]);
    if (!own) return std::nullopt;
    LocalPath local{KeyframePath(shape, maker.onGround()), earlier};
    for (std::size_t i = earlier; i-- > 0;) local.path.add(before[i]);
    local.path.add(*own);
    for (std::size_t i = here + 1; i < keyframes.size() && i <= here + 1 + reach; ++i) {
        if (keyframes[i - 1].outside && i > here + 1) break;
        const auto knot = maker.make(keyframes[i]);
        if (!knot) break;
        local.path.add(*knot);
        if (i + 1 == keyframes.size()) local.path.setStandsAfter(maker.onGround() && standsAtItsEnd(object));
    }
    return local;
}

bool hasNext(const LocalPath& local) {
    return local.here + 1 < local.path.count();
}

struct PathBox {
    OrientedBox box;
    bool heading_from_path = false;
};

/// The way of an object from one keyframe to the next, over the ground with a camera, in the image without.
class WayFrom {
 public:
    WayFrom(const LabelledObject& object, std::size_t here, const CameraMotion* camera, CarriedBoxes* known,
            PathShape shape)
        : camera_(camera), reference_(object.keyframes[here].frame) {
        const Keyframes& keyframes = object.keyframes;
        const KnotMaker maker(reference_, camera, known);
        local_ = pathAround(object, here, 1, maker, shape);
        if (!local_) return;
        cut_off_ = here + 1 < keyframes.size() && !hasNext(*local_);
        // Where it stands, headings come from the movement before and after, so look one keyframe further.
        const bool stands = !hasNext(*local_) || !local_->path.moving(local_->here);
        if (stands && keyframes.size() > 1) local_ = pathAround(object, here, 2, maker, shape);
        if (staysUpright(keyframes, here)) upright_heading_ = keyframes[here].box.heading;
    }

    /// Nothing where frames are not connected over the ground.
    std::optional<PathBox> at(FrameIndex frame) {
        if (!local_ || (cut_off_ && frame > reference_)) return std::nullopt;
        PathBox result = onPath(static_cast<double>(frame - reference_));
        if (camera_ != nullptr && frame != reference_) {
            const auto carried = carriedBox(result.box, reference_, frame, *camera_);
            if (!carried) return std::nullopt;
            result.box = *carried;
        }
        if (upright_heading_) result.box.heading = *upright_heading_;
        result.box.heading = wrapPi(result.box.heading);
        return result;
    }

 private:
    /// The box at a moment `time` after the keyframe, in the image of that keyframe.
    PathBox onPath(double time) {
        const KeyframePath& path = local_->path;
        const Knot& a = path.knot(local_->here);
        if (time <= 0 || !hasNext(*local_)) {
            return {{a.point, a.length, a.width, path.headingAt(local_->here)}, path.headingFollowsPath(local_->here)};
        }
        const Knot& b = path.knot(local_->here + 1);
        if (!piece_) piece_.emplace(path, local_->here);
        const double share = (time - a.time) / (b.time - a.time);
        PathBox result;
        result.box.centre = piece_->position(share);
        result.box.length = a.length + share * (b.length - a.length);
        result.box.width = a.width + share * (b.width - a.width);
        result.box.heading = piece_->heading(share);
        result.heading_from_path = path.moving(local_->here) && !a.heading_set && !b.heading_set;
        return result;
    }

    const CameraMotion* camera_;
    FrameIndex reference_;
    std::optional<LocalPath> local_;
    bool cut_off_ = false;  ///< the next keyframe cannot be reached
    std::optional<double> upright_heading_;
    std::optional<PathPiece> piece_;
};

}  // namespace

/// What was worked out between two keyframes.
struct BoxReader::Piece {
    std::size_t here = 0;
    std::optional<WayFrom> on_ground;
    std::optional<WayFrom> in_image;

    WayFrom& onGround(const BoxReader& reader) {
        if (!on_ground) on_ground.emplace(reader.object_, here, &reader.camera_, reader.known_, reader.shape_);
        return *on_ground;
    }
    WayFrom& inImage(const BoxReader& reader) {
        if (!in_image) in_image.emplace(reader.object_, here, nullptr, nullptr, reader.shape_);
        return *in_image;
    }
};

BoxReader::BoxReader(const LabelledObject& object, const CameraMotion& camera, PathShape shape, CarriedBoxes* known)
    : object_(object), camera_(camera), shape_(shape), known_(known) {}

BoxReader::~BoxReader() = default;

LabelledBox BoxReader::at(FrameIndex frame) {
    LabelledBox result;
    const Keyframes& keyframes = object_.keyframes;
    const auto passed = static_cast<std::size_t>(
        std::upper_bound(keyframes.begin(), keyframes.end(), frame,
                         [](FrameIndex f, const Keyframe& keyframe) { return f < keyframe.frame; }) -
        keyframes.begin());
    if (passed == 0 || frame > object_.last_frame) return result;
    const std::size_t here = passed - 1;
    const Keyframe& before = keyframes[here];
    result.occlusion = before.occlusion;
    result.outside = before.outside;
    result.ignore = before.ignore;

    const bool exact = before.frame == frame;
    if (exact && before.heading_set) {
        result.source = BoxSource::keyframe;
        result.box = before.box;
        return result;
    }
    if (!piece_) piece_ = std::make_unique<Piece>();
    if (piece_->here != here) *piece_ = Piece{here, {}, {}};
    const FrameIndex until = exact || passed == keyframes.size() ? frame : keyframes[passed].frame;
    std::optional<PathBox> box;
    if (camera_.connects(before.frame, until)) {
        box = piece_->onGround(*this).at(frame);
    }
    result.source = exact ? BoxSource::keyframe : box ? BoxSource::ground : BoxSource::image;
    // A keyframe whose neighbours are not connected with it follows the path it has in the image.
    if (!box || (exact && !box->heading_from_path && !before.heading_set && keyframes.size() > 1)) {
        const auto in_image = piece_->inImage(*this).at(frame);
        const bool next_connected =
            passed < keyframes.size() && camera_.connects(before.frame, keyframes[passed].frame);
        const bool last_connected = here > 0 && camera_.connects(before.frame, keyframes[here - 1].frame);
        if (!box || (!next_connected && !last_connected)) box = in_image;
    }
    result.box = box->box;
    result.heading_from_path = box->heading_from_path;
    if (exact) {
        // To the bit as it was set.
        const double heading = before.heading_set || !box->heading_from_path ? before.box.heading : box->box.heading;
        result.box = before.box;
        result.box.heading = heading;
    }
    return result;
}

}  // namespace eyrie
