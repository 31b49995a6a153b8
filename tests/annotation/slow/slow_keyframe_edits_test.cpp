#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

#include "annotation/edits/identity_edits.h"
#include "annotation/edits/object_pieces.h"
#include "annotation/keyframes/interpolation.h"
#include "annotation/keyframes/keyframe_reduction.h"
#include "annotation/slow/label_makers.h"

/// What corrections do to other keyframes, and what is left of objects that are cut and put together, against the same
/// worked out from all frames.
namespace eyrie::slow_keyframe_edits_test {
namespace {

void expectSame(const LabelledObject& a, const LabelledObject& b, const std::string& where) {
    ASSERT_EQ(a.id, b.id) << where;
    ASSERT_EQ(a.notes, b.notes) << where;
    ASSERT_EQ(a.last_frame, b.last_frame) << where;
    ASSERT_EQ(a.keyframes.size(), b.keyframes.size()) << where;
    for (std::size_t i = 0; i < a.keyframes.size(); ++i) {
        const Keyframe &x = a.keyframes[i], &y = b.keyframes[i];
        const std::string here = where + ", frame " + std::to_string(x.frame);
        ASSERT_EQ(x.frame, y.frame) << here;
        ASSERT_NEAR(x.box.centre.x, y.box.centre.x, 1e-7) << here;
        ASSERT_NEAR(x.box.centre.y, y.box.centre.y, 1e-7) << here;
        ASSERT_NEAR(x.box.length, y.box.length, 1e-7) << here;
        ASSERT_NEAR(x.box.width, y.box.width, 1e-7) << here;
        ASSERT_NEAR(turnBetween(x.box.heading, y.box.heading), 0, 1e-7) << here;
        ASSERT_EQ(x.heading_set, y.heading_set) << here;
        ASSERT_EQ(x.computed, y.computed) << here;
        ASSERT_EQ(x.occlusion, y.occlusion) << here;
        ASSERT_EQ(x.outside, y.outside) << here;
        ASSERT_EQ(x.ignore, y.ignore) << here;
    }
}

bool axial(double heading) {
    return std::abs(std::remainder(heading, kPi / 2)) < 1e-9;
}

/// The upright box around one, told by a heading along the image's axes.
OrientedBox hull(const OrientedBox& box, double heading) {
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (const cv::Point2d& corner : box.corners()) {
        left = std::min(left, corner.x);
        right = std::max(right, corner.x);
        top = std::min(top, corner.y);
        bottom = std::max(bottom, corner.y);
    }
    const bool across = std::abs(std::cos(heading)) < 0.5;
    const double wide = right - left, high = bottom - top;
    return {{(left + right) / 2, (top + bottom) / 2}, across ? high : wide, across ? wide : high, heading};
}

/// Does to a keyframe, shown with a heading, a share of what became of `before`.
void correct(Keyframe& keyframe, double shown, const OrientedBox& before, const OrientedBox& after, double share) {
    const double ahead = (after.centre - before.centre).dot(before.direction()) / before.length;
    const cv::Point2d right(-before.direction().y, before.direction().x);
    const double aside = (after.centre - before.centre).dot(right) / before.length;
    const cv::Point2d d(std::cos(shown), std::sin(shown));
    keyframe.box.centre += d * (share * ahead * keyframe.box.length);
    keyframe.box.centre += cv::Point2d(-d.y, d.x) * (share * aside * keyframe.box.length);
    keyframe.box.length += share * keyframe.box.length * (after.length - before.length) / before.length;
    keyframe.box.width += share * keyframe.box.width * (after.width - before.width) / before.width;
    if (keyframe.heading_set)
        keyframe.box.heading = wrapPi(keyframe.box.heading + share * turnBetween(before.heading, after.heading));
}

LabelledObject slowlyCarriedOn(const LabelledObject& object, FrameIndex frame, const OrientedBox& box, bool heading_set,
                               const CameraMotion& camera) {
    const LabelledBox shown = boxAt(object, frame, camera);
    LabelledObject result = object;
    Keyframe own = object.keyframes.front();
    for (const Keyframe& each : object.keyframes)
        if (each.frame <= frame) own = each;
    own.frame = frame;
    own.box = box;
    own.heading_set = heading_set;
    own.computed = false;
    auto& keyframes = result.keyframes;
    keyframes.erase(std::remove_if(keyframes.begin(), keyframes.end(), [&](auto& each) { return each.frame == frame; }),
                    keyframes.end());
    std::optional<FrameIndex> hand_before, hand_after;
    for (const Keyframe& each : keyframes) {
        if (each.computed) continue;
        if (each.frame < frame) hand_before = each.frame;
        if (each.frame > frame && !hand_after) hand_after = each.frame;
    }
    const bool same_vehicle = shown.visible() && overlap(shown.box, box) >= 0.1;
    const bool becomes_upright = heading_set && axial(box.heading) && !axial(shown.box.heading);
    for (Keyframe& each : keyframes) {
        if (!same_vehicle || !each.computed || each.outside) continue;
        const auto& hand = each.frame < frame ? hand_before : hand_after;
        double share = 1;
        if (hand) share = 1.0 - 1.0 * (each.frame - frame) / (*hand - frame);
        if (share <= 0) continue;
        OrientedBox there = boxAt(object, each.frame, camera).box;
        if (becomes_upright) {
            there = hull(there, box.heading);
            each.box = there;
            each.heading_set = true;
        }
        correct(each, there.heading, becomes_upright ? hull(shown.box, box.heading) : shown.box, box, share);
    }
    keyframes.push_back(own);
    std::sort(keyframes.begin(), keyframes.end(), [](auto& a, auto& b) { return a.frame < b.frame; });
    result.last_frame = std::max(result.last_frame, frame);
    return result;
}

TEST(SlowKeyframeEdits, CorrectionsGoOnAsTheRulesSay) {
    test::LabelMaker maker(4);
    int changed = 0, upright = 0;
    for (int i = 0; i < 1500; ++i) {
        const CameraMotion camera = test::cameraOfKind(i, 160);
        const LabelledObject object = maker.object(3, maker.number(5, 12), maker.number(1, 7));
        const FrameIndex frame = maker.number(0, object.last_frame + 2);
        OrientedBox box = boxAt(object, frame, camera).box;
        if (box.length <= 0) box = object.keyframes.front().box;
        box.centre += cv::Point2d(maker.between(-6, 6), maker.between(-6, 6));
        box.length *= maker.between(0.8, 1.2);
        box.width *= maker.between(0.8, 1.2);
        box.heading =
            maker.happens(0.3) ? kPi / 2 * maker.number(-1, 2) : wrapPi(box.heading + maker.between(-0.4, 0.4));
        const bool set = maker.happens(0.7);
        const LabelledObject slow = slowlyCarriedOn(object, frame, box, set, camera);
        expectSame(withBoxCarriedOn(object, frame, box, set, camera), slow, std::to_string(i));
        if (HasFatalFailure()) return;
        for (const Keyframe& each : slow.keyframes) {
            const Keyframe* before = keyframeAt(object, each.frame);
            if (before == nullptr || each.frame == frame) continue;
            changed += before->box.centre != each.box.centre;
            upright += axial(each.box.heading) && !axial(before->box.heading);
        }
    }
    EXPECT_GT(changed, 500);
    EXPECT_GT(upright, 50);
}

LabelledObject slowlySpread(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera) {
    const auto& all = object.keyframes;
    const auto own = std::find_if(all.begin(), all.end(), [&](auto& each) { return each.frame == frame; });
    if (own == all.end() || all.size() == 1) return object;
    LabelledObject others = object;
    others.keyframes.erase(others.keyframes.begin() + (own - all.begin()));
    if (others.last_frame < frame) others.last_frame = frame;
    const OrientedBox after = boxAt(object, frame, camera).box;
    OrientedBox before = boxAt(others, frame, camera).box;
    if (own == all.begin()) {
        // Where it was before that is not known: only its size is.
        before = after;
        const auto back = carriedBox(all[1].box, all[1].frame, frame, camera);
        if (back) before = {after.centre, back->length, back->width, after.heading};
    }
    if (before.length <= 0 || before.width <= 0) return object;
    bool any_computed = false;
    for (const Keyframe& each : others.keyframes) any_computed = any_computed || each.computed;
    LabelledObject result = object;
    for (Keyframe& each : result.keyframes) {
        if (each.frame == frame || each.outside || (any_computed && !each.computed)) continue;
        correct(each, boxAt(others, each.frame, camera).box.heading, before, after, 1);
    }
    return result;
}

TEST(SlowKeyframeEdits, CorrectionsSpreadAsTheRulesSay) {
    test::LabelMaker maker(5);
    for (int i = 0; i < 1500; ++i) {
        const CameraMotion camera = test::cameraOfKind(i, 160);
        LabelledObject object = maker.object(3, maker.number(5, 12), maker.number(1, 6));
        if (maker.happens(0.1)) object.last_frame -= 3;
        if (maker.happens(0.05)) object.keyframes.back().box.width = 0;
        const auto& one =
            object.keyframes[static_cast<std::size_t>(maker.number(0, static_cast<int>(object.keyframes.size()) - 1))];
        const FrameIndex frame = one.frame + (maker.happens(0.1) ? 1 : 0);
        expectSame(withCorrectionSpread(object, frame, camera), slowlySpread(object, frame, camera), std::to_string(i));
        if (HasFatalFailure()) return;
    }
}

TEST(SlowKeyframeEdits, SizesAreThoseOfOneBoxOnTheGround) {
    test::LabelMaker maker(6);
    for (int i = 0; i < 200; ++i) {
        const CameraMotion camera = test::cameraOfKind(i, 160);
        const LabelledObject object = maker.object(3, maker.number(0, 12), maker.number(1, 6));
        const FrameIndex frame = maker.number(0, object.last_frame);
        const OrientedBox box{{maker.between(0, 300), maker.between(0, 200)},
                              maker.between(10, 40),
                              maker.between(4, 20),
                              maker.between(-3, 3)};
        LabelledObject slow = object;
        for (Keyframe& each : slow.keyframes) {
            double nearer = 1;
            if (camera.connects(frame, each.frame)) nearer = (1 + 0.002 * each.frame) / (1 + 0.002 * frame);
            if (i % 4 == 0) nearer = 1;
            each.box.length = box.length * nearer;
            each.box.width = box.width * nearer;
        }
        expectSame(withSize(object, frame, box, camera), slow, std::to_string(i));
        if (HasFatalFailure()) return;
    }
}

/// Keyframes are put in wherever a frame of [first, last] shows another box than `right` does.
LabelledObject asBefore(LabelledObject object, const std::vector<FrameBox>& right, const CameraMotion& camera) {
    ReductionOptions half_a_pixel;
    half_a_pixel.tolerance_px = 0.5;
    return refined(std::move(object), right, camera, half_a_pixel);
}

Keyframe madeAt(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera) {
    Keyframe made;
    bool exact = false;
    for (const Keyframe& each : object.keyframes) {
        if (each.frame > frame) break;
        made = each;
        exact = each.frame == frame;
    }
    if (exact) return made;
    const LabelledBox shown = boxAt(object, frame, camera);
    made.frame = frame;
    made.box = shown.box;
    made.heading_set = !shown.heading_from_path;
    return made;
}

std::vector<FrameBox> visibleBoxes(const LabelledObject& object, FrameIndex first, FrameIndex last,
                                   const CameraMotion& camera) {
    std::vector<FrameBox> boxes;
    for (FrameIndex frame = first; frame <= last; ++frame) {
        const LabelledBox box = boxAt(object, frame, camera);
        if (box.exists() && !box.outside) boxes.push_back({frame, box.box});
    }
    return boxes;
}

LabelledObject slowPiece(const LabelledObject& object, FrameIndex first, FrameIndex last, const CameraMotion& camera) {
    first = std::max(first, object.keyframes.front().frame);
    last = std::min(last, object.last_frame);
    LabelledObject piece = object;
    piece.last_frame = last;
    piece.keyframes = {madeAt(object, first, camera)};
    bool goes_on = false;
    for (const Keyframe& each : object.keyframes) {
        if (each.frame > first && each.frame <= last) piece.keyframes.push_back(each);
        goes_on = goes_on || each.frame > last;
    }
    if (goes_on && piece.keyframes.back().frame != last) piece.keyframes.push_back(madeAt(object, last, camera));
    return asBefore(piece, visibleBoxes(object, first, last, camera), camera);
}

TEST(SlowKeyframeEdits, PiecesShowInEveryFrameWhatTheWholeShowed) {
    test::LabelMaker maker(7);
    for (int i = 0; i < 600; ++i) {
        const CameraMotion camera = test::cameraOfKind(i, 260);
        const LabelledObject object = maker.object(3, maker.number(0, 12), maker.number(1, 14));
        const FrameIndex begin = firstFrameOf(object);
        FrameIndex first = maker.number(begin - 3, object.last_frame),
                   last = maker.number(first, object.last_frame + 3);
        if (last < begin) last = begin;
        if (maker.happens(0.2)) first = 0;
        if (maker.happens(0.2)) last = 1 << 30;
        expectSame(pieceOf(object, first, last, camera), slowPiece(object, first, last, camera), std::to_string(i));
        if (HasFatalFailure()) return;
    }
}

LabelledObject slowlyJoined(const LabelledObject& earlier, const LabelledObject& later, const LabelledObject& identity,
                            bool outside_between, const CameraMotion& camera) {
    LabelledObject result = identity;
    result.keyframes.clear();
    for (const Keyframe& each : earlier.keyframes)
        if (each.frame <= earlier.last_frame) result.keyframes.push_back(each);
    const FrameIndex end = earlier.last_frame, begin = later.keyframes.front().frame;
    if (result.keyframes.back().frame < end) result.keyframes.push_back(madeAt(earlier, end, camera));
    if (outside_between && begin - end > 1) {
        Keyframe gone = result.keyframes.back();
        gone.box = carriedBox(gone.box, end, end + 1, camera).value_or(gone.box);
        gone.frame = end + 1;
        gone.outside = true;
        result.keyframes.push_back(gone);
    }
    for (const Keyframe& each : later.keyframes) result.keyframes.push_back(each);
    result.last_frame = later.last_frame;
    auto boxes = visibleBoxes(earlier, earlier.keyframes.front().frame, end, camera);
    for (const FrameBox& each : visibleBoxes(later, begin, later.last_frame, camera)) boxes.push_back(each);
    return asBefore(result, boxes, camera);
}

TEST(SlowKeyframeEdits, JoinedOnesShowInEveryFrameWhatBothShowed) {
    test::LabelMaker maker(8);
    for (int i = 0; i < 600; ++i) {
        const CameraMotion camera = test::cameraOfKind(i, 460);
        const LabelledObject earlier = maker.object(3, maker.number(0, 12), maker.number(1, 9));
        LabelledObject later = maker.object(5, earlier.last_frame + maker.number(1, 12), maker.number(1, 9));
        const bool outside = maker.happens(0.5);
        const LabelledObject& identity = maker.happens(0.5) ? earlier : later;
        const LabelledObject both = joined(earlier, later, identity, outside, camera);
        expectSame(both, slowlyJoined(earlier, later, identity, outside, camera), std::to_string(i));
        if (HasFatalFailure()) return;
        for (const LabelledObject& part : {earlier, later})
            for (const FrameBox& each : visibleBoxes(part, firstFrameOf(part), part.last_frame, camera))
                ASSERT_LE(test::cornerDistance(boxAt(both, each.frame, camera).box, each.box), 0.5 + 1e-6) << i;
    }
}

LabelledObject slowlyFlagged(const LabelledObject& object, FrameIndex first, FrameIndex last, const FlagChange& flags,
                             const CameraMotion& camera) {
    first = std::max(first, object.keyframes.front().frame);
    last = std::min(last, object.last_frame);
    if (first > last) return object;
    LabelledObject result = object;
    for (const FrameIndex frame : {first, last + 1}) {
        if (frame > object.last_frame || keyframeAt(result, frame) != nullptr) continue;
        result.keyframes.push_back(madeAt(object, frame, camera));
        std::sort(result.keyframes.begin(), result.keyframes.end(), [](auto& a, auto& b) { return a.frame < b.frame; });
    }
    for (Keyframe& each : result.keyframes) {
        if (each.frame < first || each.frame > last) continue;
        if (flags.occlusion) each.occlusion = *flags.occlusion;
        if (flags.outside) each.outside = *flags.outside;
        if (flags.ignore) each.ignore = *flags.ignore;
    }
    std::vector<FrameBox> boxes;
    for (const FrameBox& each : visibleBoxes(object, object.keyframes.front().frame, object.last_frame, camera))
        if (boxAt(result, each.frame, camera).visible()) boxes.push_back(each);
    return asBefore(result, boxes, camera);
}

TEST(SlowKeyframeEdits, FlagsOfARangeMoveNoBox) {
    test::LabelMaker maker(9);
    for (int i = 0; i < 500; ++i) {
        const CameraMotion camera = test::cameraOfKind(i, 260);
        const LabelledObject object = maker.object(3, maker.number(3, 12), maker.number(1, 9));
        const FrameIndex first = maker.number(0, object.last_frame + 3),
                         last = maker.number(first - 1, object.last_frame + 3);
        FlagChange flags;
        if (maker.happens(0.5)) flags.occlusion = static_cast<Occlusion>(maker.number(0, 2));
        if (maker.happens(0.5)) flags.outside = maker.happens(0.5);
        if (maker.happens(0.5)) flags.ignore = maker.happens(0.5);
        expectSame(withFlags(object, first, last, flags, camera), slowlyFlagged(object, first, last, flags, camera),
                   std::to_string(i));
        if (HasFatalFailure()) return;
    }
}

TEST(SlowKeyframeEdits, ThoseFusedByTheMeanAreInTheMiddleOfBoth) {
    test::LabelMaker maker(10);
    for (int i = 0; i < 300; ++i) {
        const CameraMotion camera = test::cameraOfKind(i, 260);
        LabelledObject kept = maker.object(3, maker.number(0, 12), maker.number(1, 7));
        LabelledObject other =
            maker.object(5, maker.number(std::max(0, firstFrameOf(kept) - 5), kept.last_frame), maker.number(4, 7));
        other.last_frame = std::max(other.last_frame, firstFrameOf(kept));
        const FrameIndex first = std::max(firstFrameOf(kept), firstFrameOf(other));
        const FrameIndex last = std::min(kept.last_frame, other.last_frame);
        ASSERT_LE(first, last);
        for (const FuseRule rule : {FuseRule::prefer_kept, FuseRule::mean}) {
            const IdentityChange change = fuseInParallel(kept, other, camera, rule);
            ASSERT_EQ(change.after.size(), 1U);
            ASSERT_EQ(change.removed, std::vector<ObjectId>{5});
            const LabelledObject& fused = change.after.front();
            ASSERT_EQ(fused.id, 3);
            ASSERT_EQ(fused.notes, kept.notes);
            ASSERT_EQ(fused.last_frame, std::max(kept.last_frame, other.last_frame));
            ASSERT_EQ(firstFrameOf(fused), std::min(firstFrameOf(kept), firstFrameOf(other)));
            ASSERT_EQ(change.review_moves.size(), 2U);
            EXPECT_EQ(change.review_moves[0].last_frame, first - 1);
            EXPECT_EQ(change.review_moves[1].first_frame, last + 1);
            // Before and after what both have, whoever has more is shown as it was.
            for (FrameIndex frame = firstFrameOf(fused); frame <= fused.last_frame; ++frame) {
                const LabelledBox now = boxAt(fused, frame, camera);
                const LabelledBox a = boxAt(kept, frame, camera), b = boxAt(other, frame, camera);
                if (!now.visible()) continue;
                if (frame < first || frame > last || rule == FuseRule::prefer_kept) {
                    const LabelledBox& before = a.exists() ? a : b;
                    ASSERT_LE(test::cornerDistance(now.box, before.box), 0.5 + 1e-6) << i << ", frame " << frame;
                }
                const bool told = keyframeAt(kept, frame) != nullptr || keyframeAt(other, frame) != nullptr;
                if (frame < first || frame > last || rule != FuseRule::mean || !told || !a.visible() || !b.visible())
                    continue;
                const Keyframe* there = keyframeAt(fused, frame);
                ASSERT_NE(there, nullptr) << i << ", frame " << frame;
                EXPECT_LT(cv::norm(there->box.centre - (a.box.centre + b.box.centre) / 2), 1e-6);
                EXPECT_NEAR(there->box.length, (a.box.length + b.box.length) / 2, 1e-6);
                EXPECT_NEAR(there->box.width, (a.box.width + b.box.width) / 2, 1e-6);
            }
        }
    }
}

}  // namespace
}  // namespace eyrie::slow_keyframe_edits_test
