#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "annotation/edits/identity_edits.h"
#include "annotation/edits/ignore_regions.h"
#include "annotation/keyframes/interpolation.h"
#include "annotation/review/attention.h"
#include "annotation/review/join_suggestions.h"
#include "annotation/review/proposals.h"
#include "annotation/review/review_state.h"
#include "annotation/slow/label_makers.h"

/// What is suggested, proposed, marked and exported of labels, against the same counted frame by frame.
namespace eyrie::slow_review_test {
namespace {

AnnotationSet someLabels(test::LabelMaker& maker, int count) {
    AnnotationSet set;
    for (int i = 0; i < count; ++i) {
        const ObjectId id = 1 + 2 * i;
        set.objects[id] = maker.object(id, maker.number(0, 90), maker.number(1, 6));
        if (i == 0 || !maker.happens(0.4)) continue;
        // Nearly the same as one before it, in part of its frames or later.
        LabelledObject like = set.objects[id - 2];
        like.id = id;
        const int later = maker.number(-8, 60);
        for (Keyframe& each : like.keyframes) {
            each.frame += std::max(later, -firstFrameOf(set.objects[id - 2]));
            each.box.centre += cv::Point2d(maker.between(-3, 3), maker.between(-3, 3));
        }
        like.last_frame = like.keyframes.back().frame + maker.number(0, 5);
        set.objects[id] = like;
    }
    return set;
}

TEST(SlowReview, JoinsAreSuggestedAsTheRulesSay) {
    test::LabelMaker maker(1);
    int suggested = 0;
    for (int i = 0; i < 400; ++i) {
        const CameraMotion camera = test::cameraOfKind(i, 260);
        const AnnotationSet set = someLabels(maker, 7);
        SuggestionOptions options;
        options.max_gap = maker.number(0, 60);
        options.max_distance_px = maker.between(10, 200);
        options.px_per_gap_frame = maker.between(0, 2);
        options.max_count = maker.number(1, 4);
        const ObjectId self = 1 + 2 * maker.number(0, 6);
        std::vector<JoinSuggestion> slow;
        for (const auto& [id, object] : set.objects) {
            const LabelledObject *a = &set.objects.at(self), *b = &object;
            const bool later = firstFrameOf(*b) > a->last_frame;
            if (!later) std::swap(a, b);
            const FrameIndex end = a->last_frame, begin = firstFrameOf(*b);
            if (begin <= end) continue;
            JoinSuggestion each;
            each.object = id;
            each.later = later;
            for (FrameIndex frame = end + 1; frame < begin; ++frame) ++each.gap;
            const OrientedBox last = boxAt(*a, end, camera).box, next = boxAt(*b, begin, camera).box;
            each.over_ground = camera.connects(end, begin);
            each.distance_px = cv::norm(carriedPoint(last.centre, end, begin, camera) - next.centre);
            const FrameIndex past = std::max(end - 8, firstFrameOf(*a));
            if (past < end) {
                const cv::Point2d from = carriedPoint(boxAt(*a, past, camera).box.centre, past, end, camera);
                const cv::Point2d going = last.centre + (last.centre - from) * (1.0 * (begin - end) / (end - past));
                each.distance_px =
                    std::min(each.distance_px, cv::norm(carriedPoint(going, end, begin, camera) - next.centre));
            }
            const auto carried = carriedBox(last, end, begin, camera);
            each.heading_turn = std::abs(turnBetween(carried.value_or(last).heading, next.heading));
            if (each.gap <= options.max_gap &&
                each.distance_px <= options.max_distance_px + options.px_per_gap_frame * each.gap)
                slow.push_back(each);
        }
        std::stable_sort(slow.begin(), slow.end(), [](auto& x, auto& y) { return x.distance_px < y.distance_px; });
        if (slow.size() > static_cast<std::size_t>(options.max_count))
            slow.resize(static_cast<std::size_t>(options.max_count));
        const auto found = suggestJoins(set, self, camera, options);
        ASSERT_EQ(found.size(), slow.size()) << i;
        for (std::size_t k = 0; k < found.size(); ++k) {
            ASSERT_EQ(found[k].object, slow[k].object) << i;
            ASSERT_EQ(found[k].later, slow[k].later) << i;
            ASSERT_EQ(found[k].gap, slow[k].gap) << i;
            ASSERT_EQ(found[k].over_ground, slow[k].over_ground) << i;
            ASSERT_NEAR(found[k].distance_px, slow[k].distance_px, 1e-7) << i;
            ASSERT_NEAR(found[k].heading_turn, slow[k].heading_turn, 1e-9) << i;
        }
        suggested += static_cast<int>(found.size());
    }
    EXPECT_GT(suggested, 300);
    EXPECT_TRUE(suggestJoins({}, 3, {}).empty());
    EXPECT_TRUE(suggestFusions({}, 3, {}).empty());
}

TEST(SlowReview, FusionsAreSuggestedAsTheRulesSay) {
    test::LabelMaker maker(2);
    int suggested = 0;
    for (int i = 0; i < 200; ++i) {
        const CameraMotion camera = test::cameraOfKind(i, 400);
        AnnotationSet set = someLabels(maker, 7);
        const ObjectId self = 1 + 2 * maker.number(0, 6);
        const int longer = maker.happens(0.4) ? maker.number(50, 160) : 0;
        for (auto& [id, object] : set.objects) object.last_frame += longer;
        const double least = maker.between(0.02, 0.5);
        std::vector<FuseSuggestion> slow;
        for (const auto& [id, object] : set.objects) {
            if (id == self) continue;
            const LabelledObject& own = set.objects.at(self);
            std::vector<FrameIndex> shared;
            for (FrameIndex frame = firstFrameOf(own); frame <= own.last_frame; ++frame)
                if (frame >= firstFrameOf(object) && frame <= object.last_frame) shared.push_back(frame);
            const std::size_t step = shared.size() < 50 ? 1 : shared.size() / 50;
            FuseSuggestion each;
            each.object = id;
            double sum = 0;
            for (std::size_t k = 0; k < shared.size(); k += step) {
                const LabelledBox a = boxAt(own, shared[k], camera), b = boxAt(object, shared[k], camera);
                if (a.outside || b.outside) continue;
                ++each.shared_frames;
                sum += overlap(a.box, b.box);
            }
            each.mean_overlap = sum / each.shared_frames;
            if (each.shared_frames > 0 && each.mean_overlap >= least) slow.push_back(each);
        }
        std::stable_sort(slow.begin(), slow.end(), [](auto& x, auto& y) { return x.mean_overlap > y.mean_overlap; });
        const auto found = suggestFusions(set, self, camera, least);
        ASSERT_EQ(found.size(), slow.size()) << i;
        for (std::size_t k = 0; k < found.size(); ++k) {
            ASSERT_EQ(found[k].object, slow[k].object) << i;
            ASSERT_EQ(found[k].shared_frames, slow[k].shared_frames) << i;
            ASSERT_NEAR(found[k].mean_overlap, slow[k].mean_overlap, 1e-12) << i;
        }
        suggested += static_cast<int>(found.size());
    }
    EXPECT_GT(suggested, 40);
}

/// A track that an object shows, more or less.
DenseTrack trackOf(const LabelledObject& object, const CameraMotion& camera, test::LabelMaker& maker, TrackId id) {
    DenseTrack track;
    track.id = id;
    track.track_class = static_cast<TrackClass>(maker.number(0, 2));
    const cv::Point2d off(maker.between(-6, 6), maker.between(-6, 6));
    const FrameIndex from = maker.number(firstFrameOf(object), object.last_frame);
    for (FrameIndex frame = from - maker.number(0, 30); frame <= object.last_frame + 2; ++frame) {
        if (frame < 0 || (!track.boxes.empty() && maker.happens(0.1))) continue;
        OrientedBox box = boxAt(object, std::clamp(frame, firstFrameOf(object), object.last_frame), camera).box;
        box.centre += off;
        box.length *= maker.between(0.98, 1.02);
        track.boxes.push_back({frame, box});
    }
    return track;
}

ObjectId slowlyTheSame(const DenseTrack& track, const AnnotationSet& set, const CameraMotion& camera, double least) {
    ObjectId best = 0;
    double most = 0;
    const std::size_t step = track.boxes.size() < 12 ? 1 : track.boxes.size() / 12;
    for (const auto& [id, object] : set.objects) {
        double sum = 0;
        int looks = 0, shared = 0;
        for (std::size_t i = 0; i < track.boxes.size(); i += step) {
            ++looks;
            const LabelledBox box = boxAt(object, track.boxes[i].frame, camera);
            if (!box.exists() || box.outside) continue;
            ++shared;
            sum += overlap(box.box, track.boxes[i].box);
        }
        if (shared == 0 || 3 * shared < looks || sum / shared <= most) continue;
        most = sum / shared;
        best = id;
    }
    return most >= least ? best : 0;
}

TEST(SlowReview, TracksAreProposedAsTheRulesSay) {
    test::LabelMaker maker(3);
    int same = 0;
    for (int i = 0; i < 12; ++i) {
        const CameraMotion camera = test::cameraOfKind(i, 260);
        const AnnotationSet set = someLabels(maker, 5);
        std::vector<DenseTrack> tracks;
        for (const auto& [id, object] : set.objects) tracks.push_back(trackOf(object, camera, maker, 10 + id));
        ProposalOptions options;
        options.min_frames = maker.number(-1, 12);
        options.object_class = "truck";
        options.min_overlap_with_object = maker.between(0.2, 0.6);
        options.tolerance_of_length = maker.between(0, 0.3);
        if (i % 5 == 4) {
            options.reduction.tolerance_px = 0;
            options.reduction.min_overlap = 0.7;
        }
        const auto proposals = proposeTracks(tracks, set, camera, options);
        std::size_t at = 0;
        for (const DenseTrack& track : tracks) {
            if (static_cast<int>(track.boxes.size()) < options.min_frames) continue;
            ASSERT_LT(at, proposals.size());
            const Proposal& found = proposals[at++];
            std::vector<double> lengths;
            for (const FrameBox& box : track.boxes) lengths.push_back(box.box.length);
            std::sort(lengths.begin(), lengths.end());
            ReductionOptions reduction = options.reduction;
            reduction.thorough = true;
            const double usual = lengths[lengths.size() / 2];
            if (i % 5 != 4) reduction.tolerance_px = std::max(1.5, options.tolerance_of_length * usual);
            const auto keyframes = reduceToKeyframes(track.boxes, camera, reduction);
            ASSERT_EQ(found.track, track.id);
            ASSERT_EQ(found.track_class, track.track_class);
            ASSERT_EQ(found.object.object_class, "truck");
            ASSERT_EQ(found.object.origin, ObjectOrigin::proposal_accepted);
            ASSERT_EQ(found.object.last_frame, track.boxes.back().frame);
            ASSERT_EQ(found.object.keyframes.size(), keyframes.size());
            double worst = 0;
            for (const FrameBox& box : track.boxes)
                worst = std::max(worst, test::cornerDistance(boxAt(found.object, box.frame, camera).box, box.box));
            ASSERT_NEAR(found.max_corner_px, worst, 1e-9);
            for (std::size_t k = 0; k < keyframes.size(); ++k) {
                ASSERT_EQ(found.object.keyframes[k].frame, keyframes[k].frame);
                ASSERT_TRUE(found.object.keyframes[k].computed);
            }
            ASSERT_EQ(found.same_as, slowlyTheSame(track, set, camera, options.min_overlap_with_object));
            same += found.same_as != 0;
            const LabelledObject taken = accepted(found, 77, 0x123456);
            ASSERT_EQ(taken.id, 77);
            ASSERT_EQ(taken.colour, 0x123456U);
        }
        ASSERT_EQ(at, proposals.size());
    }
    EXPECT_GT(same, 8);
    EXPECT_EQ(originAfterChange(ObjectOrigin::proposal_accepted), ObjectOrigin::proposal_corrected);
    for (const ObjectOrigin other : {ObjectOrigin::hand, ObjectOrigin::imported, ObjectOrigin::proposal_corrected})
        EXPECT_EQ(originAfterChange(other), other);
}

std::string slowClass(const Proposal& proposal, const AnnotationSet& set, const CameraMotion& camera,
                      const std::string& drawn) {
    const LabelledObject& own = proposal.object;
    std::string kind = proposal.track_class == TrackClass::unknown || trackClassOf(drawn) == TrackClass::unknown ||
                               trackClassOf(drawn) == proposal.track_class
                           ? drawn
                           : commonestWordOf(proposal.track_class);
    if (own.keyframes.empty()) return kind;
    AnnotationSet near;
    for (const auto& [id, object] : set.objects) {
        if (firstFrameOf(own) - object.last_frame > 50 || firstFrameOf(object) - own.last_frame > 50) continue;
        const FrameIndex first = std::max(firstFrameOf(own), firstFrameOf(object));
        const FrameIndex last = std::min(own.last_frame, object.last_frame);
        bool close = first > last;
        for (const FrameIndex frame : {first, (first + last) / 2, last}) {
            if (first > last) break;
            const OrientedBox a = boxAt(own, frame, camera).box, b = boxAt(object, frame, camera).box;
            close = close || cv::norm(a.centre - b.centre) < a.length + b.length;
        }
        if (close) near.objects[id] = object;
    }
    near.objects[-1] = own;
    const auto fusions = suggestFusions(near, -1, camera, 0.3);
    if (!fusions.empty()) return set.objects.at(fusions[0].object).object_class;
    SuggestionOptions options;
    options.max_gap = 50;
    options.max_distance_px = own.keyframes[0].box.length;
    options.px_per_gap_frame = 0;
    const auto joins = suggestJoins(near, -1, camera, options);
    return joins.empty() ? kind : set.objects.at(joins[0].object).object_class;
}

TEST(SlowReview, ProposalsHaveTheClassOfWhatTheyGoOnWith) {
    test::LabelMaker maker(4);
    std::map<std::string, int> classes;
    for (int i = 0; i < 400; ++i) {
        const CameraMotion camera = test::cameraOfKind(i, 400);
        AnnotationSet set = someLabels(maker, 4);
        for (auto& [id, object] : set.objects) object.object_class = "class " + std::to_string(id);
        Proposal proposal;
        proposal.track_class = static_cast<TrackClass>(maker.number(0, 2));
        proposal.object = set.objects.at(1 + 2 * maker.number(0, 3));
        const int later = maker.happens(0.5)
                              ? maker.number(0, 8)
                              : proposal.object.last_frame - firstFrameOf(proposal.object) + maker.number(0, 60);
        for (Keyframe& each : proposal.object.keyframes) {
            each.frame += later;
            each.box.centre += cv::Point2d(maker.between(-20, 20), maker.between(-20, 20));
        }
        proposal.object.last_frame += later;
        if (i % 40 == 39) proposal.object.keyframes.clear();
        const std::string drawn =
            std::array{"car", "truck", "motorcycle", "thing"}[static_cast<std::size_t>(maker.number(0, 3))];
        const std::string found = classOfProposal(proposal, set, camera, drawn);
        ASSERT_EQ(found, slowClass(proposal, set, camera, drawn)) << i;
        ++classes[found];
    }
    EXPECT_GT(classes.size(), 5U);
}

TEST(SlowReview, WhatDeservesALookIsTold) {
    test::LabelMaker maker(5);
    std::map<AttentionKind, int> kinds;
    for (int i = 0; i < 300; ++i) {
        const CameraMotion camera = test::cameraOfKind(i, 260);
        AnnotationSet set = someLabels(maker, 4);
        for (int k = 0; k < 3; ++k) {
            const FrameIndex first = maker.number(0, 100);
            set.reviews.push_back({1 + 2 * maker.number(0, 3), first, first + maker.number(0, 30),
                                   static_cast<ReviewState>(maker.number(0, 2)), maker.happens(0.5) ? "Ada" : "", ""});
        }
        AttentionOptions options;
        options.image = {300, 240};
        options.frame_count = maker.number(60, 140);
        options.border_px = maker.between(5, 40);
        options.jump_px = maker.between(0.3, 3);
        options.jump_factor = maker.between(1.2, 3);
        options.turn_per_frame = maker.between(0.05, 0.35);
        options.size_factor = maker.between(1.02, 1.1);
        if (i % 20 == 19) options.image = {};
        std::vector<AttentionItem> slow;
        const ReviewIndex reviews(set);
        for (const auto& [id, object] : set.objects) {
            const auto& keyframes = object.keyframes;
            const auto add = [&, own = id](FrameIndex frame, AttentionKind kind) {
                slow.push_back({own, frame, kind, ""});
            };
            const auto inside = [&, &each = object](FrameIndex frame) {
                const LabelledBox box = boxAt(each, frame, camera);
                if (!box.exists() || options.image.empty()) return false;
                for (const cv::Point2d& corner : box.box.corners())
                    if (corner.x <= options.border_px || corner.y <= options.border_px ||
                        corner.x >= options.image.width - 1 - options.border_px ||
                        corner.y >= options.image.height - 1 - options.border_px)
                        return false;
                return true;
            };
            for (FrameIndex frame = firstFrameOf(object); frame <= object.last_frame; ++frame) {
                const auto& spans = reviews.spansOf(id);
                for (const ReviewSpan& span : spans)
                    if (span.first_frame == frame && span.state == ReviewState::questionable)
                        add(frame, AttentionKind::questionable);
            }
            if (firstFrameOf(object) > 0 && inside(firstFrameOf(object)))
                add(firstFrameOf(object), AttentionKind::starts_inside);
            if (object.last_frame < options.frame_count - 1 && inside(object.last_frame))
                add(object.last_frame, AttentionKind::ends_inside);
            for (std::size_t k = 1; k + 1 < keyframes.size(); ++k)
                if (keyframes[k].outside && !keyframes[k - 1].outside && inside(keyframes[k].frame - 1))
                    add(keyframes[k].frame, AttentionKind::gap);
            std::optional<double> before;
            for (std::size_t k = 0; k + 1 < keyframes.size(); ++k) {
                const Keyframe &a = keyframes[k], &b = keyframes[k + 1];
                std::optional<double> speed;
                if (!a.outside && b.frame <= object.last_frame) {
                    const OrientedBox from = carriedBox(a.box, a.frame, b.frame, camera).value_or(a.box);
                    speed = cv::norm(b.box.centre - from.centre) / (b.frame - a.frame);
                    if (before && std::abs(*speed - *before) >= options.jump_px &&
                        std::max(*speed, *before) >= options.jump_factor * std::min(*speed, *before))
                        add(a.frame, AttentionKind::jump);
                    const auto differ = [&](double x, double y) {
                        return x >= y * options.size_factor || y >= x * options.size_factor;
                    };
                    if (differ(from.length, b.box.length) || differ(from.width, b.box.width))
                        add(b.frame, AttentionKind::size);
                    const double turn = std::abs(turnBetween(from.heading, b.box.heading));
                    if (a.heading_set && b.heading_set && turn >= options.turn_per_frame * (b.frame - a.frame))
                        add(b.frame, AttentionKind::turn);
                }
                before = speed;
            }
        }
        std::stable_sort(slow.begin(), slow.end(),
                         [](auto& a, auto& b) { return a.frame != b.frame ? a.frame < b.frame : a.object < b.object; });
        const auto found = attentionList(set, camera, options);
        ASSERT_EQ(found.size(), slow.size()) << i;
        for (std::size_t k = 0; k < found.size(); ++k) {
            ASSERT_EQ(found[k].object, slow[k].object) << i;
            ASSERT_EQ(found[k].frame, slow[k].frame) << i;
            ASSERT_EQ(found[k].kind, slow[k].kind) << i << " " << found[k].text;
            ++kinds[found[k].kind];
        }
        for (int k = 0; k < 5; ++k) {
            const FrameIndex frame = maker.number(-1, 130);
            const ObjectId id = maker.number(0, 8);
            std::optional<AttentionItem> next;
            for (const AttentionItem& each : found)
                if (!next && (each.frame > frame || (each.frame == frame && each.object > id))) next = each;
            if (!next && !found.empty()) next = found.front();
            const auto told = nextAttention(found, frame, id);
            ASSERT_EQ(told.has_value(), next.has_value());
            if (!next) continue;
            ASSERT_EQ(std::tie(told->frame, told->object), std::tie(next->frame, next->object));
        }
    }
    EXPECT_EQ(kinds.size(), 7U) << "each kind of them";
}

TEST(SlowReview, TheNextThatNobodyHasCheckedIsFound) {
    test::LabelMaker maker(6);
    for (int i = 0; i < 300; ++i) {
        AnnotationSet set = someLabels(maker, 4);
        for (int k = 0; k < 12; ++k) {
            const FrameIndex first = maker.number(0, 120);
            set.reviews.push_back({1 + 2 * maker.number(0, 3), maker.happens(0.4) ? 0 : first,
                                   first + maker.number(0, 90),
                                   maker.happens(0.8) ? ReviewState::checked : ReviewState::questionable,
                                   maker.happens(0.5) ? "Ada" : "Bob", maker.happens(0.5) ? "a" : "b"});
        }
        const ReviewIndex index(set);
        const auto stateOf = [&](ObjectId id, FrameIndex frame) {
            ReviewState state = ReviewState::unseen;
            for (const ReviewMark& mark : set.reviews)
                if (mark.object == id && frame >= mark.first_frame && frame <= mark.last_frame) state = mark.state;
            return state;
        };
        const auto uncheckedFrom = [&](ObjectId id, FrameIndex from) -> std::optional<FrameIndex> {
            const LabelledObject& object = set.objects.at(id);
            for (FrameIndex frame = std::max(from, firstFrameOf(object)); frame <= object.last_frame; ++frame)
                if (stateOf(id, frame) != ReviewState::checked) return frame;
            return std::nullopt;
        };
        double checked = 0, all = 0;
        for (const auto& [id, object] : set.objects)
            for (FrameIndex frame = firstFrameOf(object); frame <= object.last_frame; ++frame) {
                ASSERT_EQ(index.stateAt(id, frame), stateOf(id, frame));
                checked += stateOf(id, frame) == ReviewState::checked;
                ++all;
            }
        ASSERT_NEAR(index.checkedShare(), checked / all, 1e-12);
        for (int k = 0; k < 6; ++k) {
            const ObjectId id = maker.number(0, 8);
            const FrameIndex frame = maker.number(-2, 160);
            std::optional<std::pair<ObjectId, FrameIndex>> next;
            const auto look = [&](ObjectId each, FrameIndex from) {
                if (next || set.objects.count(each) == 0) return;
                if (const auto there = uncheckedFrom(each, from)) next = {each, *there};
            };
            look(id, frame + 1);
            for (ObjectId each = id + 1; each < 9; ++each) look(each, 0);
            for (ObjectId each = 0; each <= id; ++each) look(each, 0);
            const auto found = index.nextUnchecked(id, frame);
            ASSERT_EQ(found.has_value(), next.has_value());
            if (!next) continue;
            ASSERT_EQ(found->object, next->first);
            ASSERT_EQ(found->frame, next->second);
        }
    }
}

bool slowlyContains(const std::vector<cv::Point2d>& polygon, cv::Point2d at) {
    // How often the border goes around the point.
    double around = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const cv::Point2d a = polygon[i] - at, b = polygon[(i + 1) % polygon.size()] - at;
        if (a == cv::Point2d()) return true;
        if (a.cross(b) == 0 && a.dot(b) <= 0) return true;
        around += std::atan2(a.cross(b), a.dot(b));
    }
    return std::lround(around / (2 * kPi)) % 2 != 0;
}

TEST(SlowReview, RegionsContainWhatTheirBorderGoesAround) {
    test::LabelMaker maker(7);
    for (int i = 0; i < 400; ++i) {
        std::vector<cv::Point2d> polygon(static_cast<std::size_t>(maker.number(3, 8)));
        for (cv::Point2d& corner : polygon) corner = {1.0 * maker.number(0, 12), 1.0 * maker.number(0, 12)};
        for (int y = -1; y <= 13; ++y)
            for (int x = -1; x <= 13; ++x)
                ASSERT_EQ(contains(polygon, cv::Point2d(x, y)), slowlyContains(polygon, cv::Point2d(x, y))) << i;
        const double row = maker.between(0.2, 6);
        double low = 1e9, high = -1e9;
        for (const cv::Point2d& corner : polygon) {
            low = std::min(low, corner.y);
            high = std::max(high, corner.y);
        }
        const auto boxes = coveringBoxes(polygon, row);
        if (high <= low) continue;
        const int rows = static_cast<int>(std::ceil((high - low) / std::max(row, 0.5)));
        for (const OrientedBox& box : boxes) {
            ASSERT_NEAR(box.width, (high - low) / rows, 1e-9);
            const double which = (box.centre.y - low) / box.width - 0.5;
            ASSERT_NEAR(which, std::round(which), 1e-6);
            ASSERT_EQ(box.heading, 0);
        }
        for (int r = 0; r < rows; ++r) {
            const double y = low + (r + 0.5) * (high - low) / rows;
            if (std::abs(y - std::round(y)) < 1e-9) continue;  // along a border
            for (const double x : {0.317, 1.731, 2.919, 4.437, 5.111, 6.613, 7.237, 8.839, 9.343, 10.641, 11.747}) {
                const bool covered = std::any_of(boxes.begin(), boxes.end(), [&](const OrientedBox& box) {
                    return std::abs(y - box.centre.y) < 1e-6 && std::abs(x - box.centre.x) <= box.length / 2;
                });
                ASSERT_EQ(covered, slowlyContains(polygon, {x, y})) << i << ": " << x << ", " << y;
            }
        }
    }
}

TEST(SlowReview, BoxesForAnEvaluationAreThoseOfEachFrame) {
    test::LabelMaker maker(8);
    int ignored = 0, counted = 0;
    for (int i = 0; i < 60; ++i) {
        const CameraMotion camera = test::cameraOfKind(i, 200);
        AnnotationSet set = someLabels(maker, 4);
        for (int k = 0; k < 3; ++k) {
            IgnoreRegion region;
            region.id = k + 1;
            const cv::Point2d at(maker.between(0, 260), maker.between(0, 200));
            const double side = maker.between(20, 90);
            region.polygon = {at, at + cv::Point2d(side, 5), at + cv::Point2d(side / 2, side)};
            region.anchor = maker.happens(0.5) ? RegionAnchor::image : RegionAnchor::ground;
            region.reference_frame = maker.number(0, 60);
            region.first_frame = maker.number(0, 40);
            region.last_frame = region.first_frame + maker.number(0, 60);
            set.regions[region.id] = region;
            const FrameIndex first = maker.number(0, 60);
            set.reviews.push_back({1 + 2 * k, first, first + 40, ReviewState::checked, "", ""});
        }
        GroundTruthOptions options;
        options.first_frame = maker.number(0, 30);
        options.last_frame = options.first_frame + maker.number(0, 60);
        options.image = maker.happens(0.8) ? cv::Size(280, 210) : cv::Size();
        options.min_share_in_image = maker.between(0.3, 0.9);
        options.ignore_fully_occluded = maker.happens(0.5);
        options.only_checked = maker.happens(0.3);
        options.regions_as_boxes = maker.happens(0.5);
        const auto found = groundTruthBoxes(set, camera, options);
        ASSERT_EQ(found.size(), static_cast<std::size_t>(options.last_frame - options.first_frame + 1));
        const ReviewIndex reviews(set);
        for (FrameIndex frame = options.first_frame; frame <= options.last_frame; ++frame) {
            std::vector<BoxRecord> slow;
            std::vector<std::vector<cv::Point2d>> regions;
            for (const auto& [id, region] : set.regions) {
                if (frame < region.first_frame || frame > region.last_frame) continue;
                regions.push_back(region.polygon);
                const auto map = camera.map(region.reference_frame, frame);
                if (region.anchor == RegionAnchor::ground && map)
                    for (cv::Point2d& corner : regions.back()) corner = map->apply(corner);
            }
            for (const auto& [id, object] : set.objects) {
                const LabelledBox box = boxAt(object, frame, camera);
                if (!box.visible()) continue;
                const double share = options.image.empty() ? 1 : areaInImage(box.box, options.image) / box.box.area();
                if (share <= 0) continue;
                BoxRecord record;
                record.id = id;
                record.box = box.box;
                record.ignore = box.ignore || share < options.min_share_in_image;
                if (options.ignore_fully_occluded && box.occlusion == Occlusion::fully) record.ignore = true;
                if (options.only_checked && reviews.stateAt(id, frame) != ReviewState::checked) record.ignore = true;
                for (const auto& region : regions)
                    record.ignore = record.ignore || slowlyContains(region, box.box.centre);
                slow.push_back(record);
            }
            int next = 8;  // above all objects
            for (const auto& region : regions)
                for (const OrientedBox& box : coveringBoxes(region)) {
                    if (!options.regions_as_boxes) break;
                    if (!options.image.empty() && areaInImage(box, options.image) <= 0) continue;
                    BoxRecord record;
                    record.id = next++;
                    record.box = box;
                    record.ignore = true;
                    slow.push_back(record);
                }
            const auto& now = found.at(frame);
            ASSERT_EQ(now.size(), slow.size()) << i << ", frame " << frame;
            for (std::size_t k = 0; k < now.size(); ++k) {
                ASSERT_EQ(now[k].frame, frame);
                ASSERT_EQ(now[k].id, slow[k].id);
                ASSERT_EQ(now[k].ignore, slow[k].ignore) << i << ", frame " << frame;
                ASSERT_NEAR(now[k].box.centre.x, slow[k].box.centre.x, 1e-7);
                ASSERT_NEAR(now[k].box.length, slow[k].box.length, 1e-7);
                ++(now[k].ignore ? ignored : counted);
            }
        }
    }
    EXPECT_GT(ignored, 500);
    EXPECT_GT(counted, 500);
}

bool sameMark(const ReviewMark& a, const ReviewMark& b) {
    return a.object == b.object && a.first_frame == b.first_frame && a.last_frame == b.last_frame &&
           a.state == b.state && a.person == b.person && a.when_utc == b.when_utc;
}

TEST(SlowReview, MarksMoveFrameByFrame) {
    test::LabelMaker maker(9);
    for (int i = 0; i < 500; ++i) {
        AnnotationSet set = someLabels(maker, 4);
        for (int k = 0; k < 8; ++k) {
            const FrameIndex first = maker.number(0, 30);
            set.reviews.push_back({1 + 2 * maker.number(0, 3), first, first + maker.number(0, 12),
                                   static_cast<ReviewState>(maker.number(0, 2)), maker.happens(0.5) ? "Ada" : "Bob",
                                   ""});
        }
        IdentityChange change;
        FrameIndex begin = 0;
        for (int k = 0; k < maker.number(0, 3); ++k) {
            const FrameIndex first = begin + maker.number(0, 9), last = first + maker.number(0, 9);
            change.review_moves.push_back({maker.happens(0.7) ? 1 : 3, maker.number(10, 12), first, last});
            begin = last + 1;
        }
        if (maker.happens(0.3)) change.removed.push_back(3);
        if (maker.happens(0.2)) change.removed.push_back(99);
        if (maker.happens(0.5)) change.after.push_back(set.objects.at(5));
        if (maker.happens(0.5)) {
            change.after.push_back(set.objects.at(5));
            change.after.back().id = 40;
        }
        const AnnotationEdit edit = editOf("moved", set, change);
        // What every mark says of every frame, in their order.
        std::vector<ReviewMark> marks = set.reviews;
        if (edit.reviews) {
            ASSERT_TRUE(!edit.reviews->removed.empty() || !edit.reviews->added.empty());
            ASSERT_EQ(edit.reviews->removed.size() + edit.reviews->kept, set.reviews.size());
            for (std::size_t k = 0; k < edit.reviews->removed.size(); ++k)
                ASSERT_TRUE(sameMark(edit.reviews->removed[k], set.reviews[edit.reviews->kept + k]));
            marks.resize(edit.reviews->kept);
            for (const ReviewMark& each : edit.reviews->added) marks.push_back(each);
            if (!edit.reviews->removed.empty() && !edit.reviews->added.empty()) {
                ASSERT_FALSE(sameMark(edit.reviews->removed[0], edit.reviews->added[0]))
                    << "it begins where they differ";
            }
        }
        std::map<std::pair<ObjectId, FrameIndex>, std::vector<std::pair<ReviewState, std::string>>> now, right;
        for (const ReviewMark& mark : marks)
            for (FrameIndex frame = mark.first_frame; frame <= mark.last_frame; ++frame)
                now[{mark.object, frame}].emplace_back(mark.state, mark.person);
        for (const ReviewMark& mark : set.reviews)
            for (FrameIndex frame = mark.first_frame; frame <= mark.last_frame; ++frame) {
                ObjectId whose = mark.object;
                for (const ReviewMove& move : change.review_moves)
                    if (move.from == mark.object && frame >= move.first_frame && frame <= move.last_frame)
                        whose = move.to;
                if (std::count(change.removed.begin(), change.removed.end(), whose) > 0) continue;
                right[{whose, frame}].emplace_back(mark.state, mark.person);
            }
        ASSERT_EQ(now, right) << i;
        std::size_t expected = change.after.size();
        for (const ObjectId id : change.removed) expected += set.objects.count(id);
        ASSERT_EQ(edit.objects.size(), expected);
        for (const auto& each : edit.objects) {
            const ObjectId id = each.after ? each.after->id : each.before->id;
            ASSERT_EQ(each.before.has_value(), set.objects.count(id) > 0);
            ASSERT_EQ(each.after.has_value(), id == 5 || id == 40);
        }
    }
}

}  // namespace
}  // namespace eyrie::slow_review_test
