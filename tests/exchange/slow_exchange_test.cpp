#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "annotation/edits/ignore_regions.h"
#include "annotation/keyframes/interpolation.h"
#include "correction/corrected_tracks.h"
#include "exchange/label_doubles.h"
#include "exchange/label_import.h"
#include "exchange/loose_boxes.h"
#include "exchange/project_labels.h"
#include "support/dice.h"
#include "support/temporary_folder.h"
#include "support/written_run.h"

/// Labels that come and go, against the same told frame by frame.
namespace eyrie::slow_exchange_test {
namespace {

using test::Dice;

/// Links boxes of neighbouring frames, one best pair after the other.
void linkSlowly(LabelFile& labels) {
    int highest = 0;
    for (const auto& [frame, records] : labels.boxes)
        for (const LabelBox& each : records) highest = std::max(highest, each.id.value_or(0));
    struct Known {
        int id = 0;
        OrientedBox box;
        cv::Point2d step{0, 0};
        std::string name;
    };
    std::map<FrameIndex, std::vector<Known>> known;
    for (auto& [frame, records] : labels.boxes) {
        std::vector<Known> before = known[frame - 1];
        std::vector<LabelBox*> open;
        for (LabelBox& each : records)
            if (!each.id && !each.ignore) open.push_back(&each);
        for (;;) {
            double most = 0.3;
            LabelBox* best = nullptr;
            Known* with = nullptr;
            for (Known& known_one : before)
                for (LabelBox* each : open) {
                    if (each->id || known_one.id < 0 || each->object_class != known_one.name) continue;
                    OrientedBox there = known_one.box;
                    there.centre += known_one.step;
                    const double shared = overlap(there.upright(), each->box.upright());
                    if (shared < most || (shared == most && best != nullptr)) continue;
                    most = shared;
                    best = each;
                    with = &known_one;
                }
            if (best == nullptr) break;
            best->id = with->id;
            known[frame].push_back({with->id, best->box, best->box.centre - with->box.centre, with->name});
            with->id = -1;
        }
        for (LabelBox* each : open) {
            if (each->id) continue;
            each->id = ++highest;
            known[frame].push_back({highest, each->box, {0, 0}, each->object_class});
        }
    }
}

TEST(SlowExchange, BoxesWithoutIdAreLinkedBestPairFirst) {
    Dice dice(1);
    int linked = 0;
    for (int i = 0; i < 200; ++i) {
        LabelFile labels;
        for (int car = 0; car < 6; ++car) {
            OrientedBox box{{dice.between(0, 90), dice.between(0, 60)},
                            dice.between(12, 24),
                            dice.between(6, 12),
                            dice.between(-3, 3)};
            const cv::Point2d speed(dice.between(-9, 9), dice.between(-5, 5));
            for (FrameIndex frame = 0; frame < 12; ++frame) {
                box.centre += speed;
                if (frame == 7 && i % 3 == 0) continue;  // a frame in which nobody looked
                if (dice.happens(0.1)) continue;
                LabelBox each;
                each.frame = frame;
                each.box = box;
                each.box.centre += cv::Point2d(dice.between(-1, 1), dice.between(-1, 1));
                each.object_class = dice.happens(0.05) ? "bus" : "car";
                each.ignore = dice.happens(0.05);
                if (dice.happens(0.05)) each.id = dice.number(1, 40);
                labels.boxes[frame].push_back(each);
            }
        }
        LabelFile slow = labels;
        int loose = 0;
        std::set<int> fresh;
        linkSlowly(slow);
        const LooseBoxCount count = gatherLooseBoxes(labels, LooseBoxes::link);
        Dice again(1);
        for (const auto& [frame, records] : labels.boxes)
            for (std::size_t k = 0; k < records.size(); ++k)
                ASSERT_EQ(records[k].id, slow.boxes.at(frame)[k].id) << i << ", frame " << frame;
        for (const auto& [frame, records] : labels.boxes)
            for (const LabelBox& each : records) loose += each.id && !each.ignore;
        ASSERT_LE(count.boxes, loose);
        ASSERT_GT(count.boxes, count.objects);
        linked += count.boxes - count.objects;
    }
    EXPECT_GT(linked, 3000);
}

/// An object with a keyframe in each of its frames, and a file that shows it or something near it.
LabelledObject driven(Dice& dice, ObjectId id) {
    LabelledObject object;
    object.id = id;
    object.object_class = "car";
    const FrameIndex first = dice.number(0, 60);
    object.last_frame = first + (dice.happens(0.3) ? 0 : dice.number(1, 90));
    OrientedBox box{{dice.between(30, 90), dice.between(30, 60)}, 20, 9, dice.between(-3, 3)};
    for (FrameIndex frame = first; frame <= object.last_frame; ++frame) {
        Keyframe each;
        each.frame = frame;
        each.box = box;
        each.heading_set = true;
        each.outside = dice.happens(0.03);
        object.keyframes.push_back(each);
        box.centre += cv::Point2d(dice.between(0, 2), dice.between(-0.5, 0.5));
        box.heading += dice.between(-0.02, 0.02);
    }
    return object;
}

TEST(SlowExchange, ObjectsAreKnownByFourOfFiveOfTheirBoxes) {
    Dice dice(2);
    int same = 0, other = 0;
    for (int i = 0; i < 300; ++i) {
        AnnotationSet set;
        for (const ObjectId id : {2, 5, 9}) set.objects[id] = driven(dice, id);
        LabelFile labels;
        for (const auto& [id, object] : set.objects) {
            const double wrong = dice.between(0, 0.35);
            for (const Keyframe& keyframe : object.keyframes) {
                if (dice.happens(0.1)) continue;
                LabelBox each;
                each.frame = keyframe.frame;
                each.id = id + 100;
                each.box = keyframe.box;
                if (dice.happens(wrong)) each.box.centre.y += dice.happens(0.5) ? 3 : -3;
                labels.boxes[each.frame].push_back(each);
                if (dice.happens(0.1)) labels.boxes[each.frame].back().id.reset();
            }
        }
        if (i % 4 == 3) set.objects.at(5).last_frame -= 2;
        std::map<int, std::vector<LabelBox>> tracks;
        for (const auto& [frame, records] : labels.boxes)
            for (const LabelBox& each : records)
                if (each.id) tracks[*each.id].push_back(each);
        std::map<int, ObjectId> slow;
        for (const auto& [id, boxes] : tracks) {
            for (const bool longer : {true, false})
                for (const auto& [known, object] : set.objects) {
                    if ((object.keyframes.front().frame < object.last_frame) != longer || slow.count(id) > 0) continue;
                    if (boxes.back().frame < object.keyframes.front().frame) continue;
                    if (boxes.front().frame > object.last_frame) continue;
                    const std::size_t looks = std::min<std::size_t>(40, boxes.size());
                    std::size_t right = 0;
                    for (std::size_t k = 0; k < looks; ++k) {
                        const LabelBox& box = boxes[k * boxes.size() / looks];
                        const LabelledBox shown = boxAt(object, box.frame, {});
                        if (!shown.exists() || shown.outside) continue;
                        double apart = 0;
                        for (std::size_t c = 0; c < 4; ++c)
                            apart = std::max(apart, cv::norm(shown.box.corners()[c] - box.box.corners()[c]));
                        right += apart <= 2;
                    }
                    if (5 * right >= 4 * looks) slow[id] = known;
                }
            ++(slow.count(id) > 0 ? same : other);
        }
        ASSERT_EQ(alreadyLabelled(labels, set, {}, 2), slow) << i;
    }
    EXPECT_GT(same, 300);
    EXPECT_GT(other, 50);
}

/// What a project knows of labels, without one.
ImportGround groundOf(const AnnotationSet& set, int first_object, int first_region) {
    test::TemporaryFolder folder;
    ProjectFile project = ProjectFile::create(folder / "p.eyrie");
    SequenceRecord sequence;
    sequence.path = "/nowhere/clip.mp4";
    const int id = ensureSequence(project, sequence);
    const AnnotationStore store(project, id);
    ImportGround ground(store);
    ground.present = set;
    ground.first_object = first_object;
    ground.first_region = first_region;
    return ground;
}

TEST(SlowExchange, WhatIsImportedShowsInEachFrameWhatTheFileHas) {
    Dice dice(3);
    SequenceRecord sequence;
    sequence.size = {200, 150};
    sequence.frame_count = 60;
    const ImportGround empty = groundOf({}, 1, 1), used = groundOf({}, 12, 4);
    std::size_t kept = 0, all = 0;
    for (int i = 0; i < 60; ++i) {
        LabelFile labels;
        const int lowest = dice.number(-2, 3);
        std::map<std::pair<int, FrameIndex>, LabelBox> expected;
        int behind = 0;
        for (int car = 0; car < 4; ++car) {
            OrientedBox box{{dice.between(30, 90), dice.between(30, 90)}, 20, 9, i % 4 == 0 ? 0 : dice.between(-3, 3)};
            const bool stands = dice.happens(0.3);
            for (FrameIndex frame = dice.number(0, 20); frame < 64; ++frame) {
                if (!stands) box.centre += cv::Point2d(dice.between(0, 2), dice.between(-1, 1));
                if (dice.happens(car == 3 ? 0.4 : 0.06)) continue;
                LabelBox each;
                each.frame = frame;
                each.id = lowest + car;
                each.box = box;
                each.object_class = "car";
                each.ignore = frame / 7 % 4 == car;
                each.occlusion = static_cast<Occlusion>(frame / 5 % 7 < 2 ? 1 + car % 2 : 0);
                labels.boxes[frame].push_back(each);
                behind += frame >= 60;
                if (frame < 60) expected[{car, frame}] = each;
                // An ignored one may have the same number.
                if (!dice.happens(0.02)) continue;
                each.box.centre.x += 40;
                labels.boxes[frame].push_back(each);
                behind += frame >= 60;
            }
        }
        const double tolerance = i % 5 == 4 ? 0 : dice.between(0.3, 2);
        const ImportGround& ground = i % 2 == 0 ? empty : used;
        const LabelImport plan = planImport(labels, sequence, {}, ground, tolerance);
        ASSERT_EQ(plan.objects, 4);
        int boxes = 0, keyframes = 0;
        for (const auto& [frame, records] : labels.boxes)
            if (frame < 60) boxes += static_cast<int>(records.size());
        ASSERT_EQ(plan.boxes, boxes);
        const std::string note = std::to_string(behind) + " boxes lie after the video's last frame, 59,";
        ASSERT_EQ(std::any_of(plan.notes.begin(), plan.notes.end(),
                              [&](const auto& each) { return each.rfind(note, 0) == 0; }),
                  behind > 0);
        ASSERT_EQ(plan.edit.objects.size(), 4U);
        for (int car = 0; car < 4; ++car) {
            const LabelledObject& object = *plan.edit.objects[static_cast<std::size_t>(car)].after;
            ASSERT_EQ(object.id, i % 2 == 1 ? 12 + car : lowest > 0 ? lowest + car : 1 + car);
            keyframes += static_cast<int>(object.keyframes.size());
            std::size_t own = 0;
            for (FrameIndex frame = 0; frame < 60; ++frame) {
                const auto there = expected.find({car, frame});
                const LabelledBox shown = boxAt(object, frame, {});
                ASSERT_EQ(shown.visible(), there != expected.end()) << i << ", object " << car << ", frame " << frame;
                if (there == expected.end()) continue;
                ++own;
                ASSERT_EQ(shown.ignore, there->second.ignore) << i << ", frame " << frame;
                ASSERT_EQ(shown.occlusion, there->second.occlusion) << i << ", frame " << frame;
                for (std::size_t c = 0; c < 4; ++c)
                    ASSERT_LE(cv::norm(shown.box.corners()[c] - there->second.box.corners()[c]), tolerance + 1e-6);
            }
            kept += tolerance > 0 ? object.keyframes.size() : 0;
            all += tolerance > 0 ? own : 0;
        }
        ASSERT_EQ(plan.keyframes, keyframes);
    }
    EXPECT_LT(kept, all);
}

TEST(SlowExchange, BoxesOnAPannedGroundAreShownWhereTheFileHasThem) {
    // The ground goes 3 px to the left and 1 px down a frame; some stand on it, some in the picture, some drive.
    std::vector<Homography> steps(40);
    for (int frame = 0; frame < 40; ++frame) {
        Homography& step = steps[static_cast<std::size_t>(frame)];
        step.from_frame = frame;
        step.to_frame = frame + 1;
        step.matrix(0, 2) = -3;
        step.matrix(1, 2) = 1;
    }
    const CameraMotion camera(steps);
    SequenceRecord sequence;
    sequence.size = {400, 300};
    sequence.frame_count = 40;
    const ImportGround empty = groundOf({}, 1, 1);
    for (const int last : {1, 2, 9, 39})
        for (const double tolerance : {0.45, 1.5}) {
            LabelFile labels;
            for (FrameIndex frame = 0; frame <= last; ++frame)
                for (const int id : {1, 2, 3, 4}) {
                    LabelBox box;
                    box.frame = frame;
                    box.id = id;
                    box.box = {{200, 40.0 * id}, 20, 10, id == 4 ? 0.3 : 0};
                    if (id != 2) box.box.centre += cv::Point2d(-3, 1) * frame;
                    if (id == 3) box.box.centre.x += 5 * frame;
                    labels.boxes[frame].push_back(box);
                }
            const LabelImport plan = planImport(labels, sequence, camera, empty, tolerance);
            ASSERT_EQ(plan.edit.objects.size(), 4U);
            for (std::size_t i = 0; i < 4; ++i) {
                const LabelledObject& object = *plan.edit.objects[i].after;
                EXPECT_LE(object.keyframes.size(), 2U);
                for (FrameIndex frame = 0; frame <= last; ++frame) {
                    const OrientedBox& box = labels.boxes.at(frame)[i].box;
                    const OrientedBox shown = boxAt(object, frame, camera).box;
                    for (std::size_t c = 0; c < 4; ++c)
                        ASSERT_LE(cv::norm(shown.corners()[c] - box.corners()[c]), tolerance + 1e-6)
                            << object.id << ", frame " << frame;
                }
            }
        }
}

TEST(SlowExchange, WhatIsThereAlreadyLiesWithinAPixelAndTheTolerance) {
    AnnotationSet set;
    LabelledObject car;
    car.id = 3;
    car.keyframes.resize(1);
    car.keyframes[0].box = {{50, 40}, 20, 10, 0};
    car.keyframes[0].heading_set = true;
    car.last_frame = 9;
    set.objects[3] = car;
    SequenceRecord sequence;
    sequence.size = {200, 150};
    sequence.frame_count = 10;
    const auto doubles = [&](double off, double region_off, double tolerance) {
        LabelFile labels;
        for (FrameIndex frame = 0; frame < 10; ++frame) {
            LabelBox box, area;
            box.frame = area.frame = frame;
            box.id = 7;
            box.box = car.keyframes[0].box;
            box.box.centre.x += off;
            area.ignore = true;
            area.box = {{104.5 + region_off, 64.5}, 30, 20, 0};
            labels.boxes[frame] = {box, area};
        }
        if (set.regions.empty()) {
            const ImportedLabels imported = annotationsOf(labels);
            set.regions = imported.annotations.regions;
            EXPECT_EQ(set.regions.size(), 1U);
        }
        return planImport(labels, sequence, {}, groundOf(set, 4, 2), tolerance).doubles;
    };
    EXPECT_EQ(doubles(0, 0, 0.5), 2);
    EXPECT_EQ(doubles(1.45, 5, 0.5), 1);
    EXPECT_EQ(doubles(1.55, 5, 0.5), 0);
    EXPECT_EQ(doubles(0.95, 5, 0), 1);
    EXPECT_EQ(doubles(1.05, 5, 0), 0);
    EXPECT_EQ(doubles(9, 0.95, 0.5), 1) << "regions are as exact as they were drawn";
    EXPECT_EQ(doubles(9, 1.05, 0.5), 0);
}

TEST(SlowExchange, LabelsLeaveFrameByFrame) {
    Dice dice(4);
    for (int i = 0; i < 60; ++i) {
        AnnotationSet set;
        for (int k = 1; k <= 4; ++k) {
            LabelledObject object = driven(dice, k);
            object.keyframes[0].ignore = dice.happens(0.5);
            object.keyframes[0].occlusion = static_cast<Occlusion>(dice.number(0, 2));
            for (std::size_t f = 1; f < object.keyframes.size(); ++f) {
                object.keyframes[f].ignore = object.keyframes[0].ignore;
                object.keyframes[f].occlusion = object.keyframes[0].occlusion;
            }
            object.object_class = "class " + std::to_string(k);
            set.objects[k] = object;
        }
        for (int k = 1; k <= 2; ++k) {
            IgnoreRegion region;
            region.id = k;
            region.polygon = {{10, 10}, {40, 10}, {40, 30}, {10, 30}};
            if (dice.happens(0.5))
                region.polygon[2].x += dice.happens(0.5) ? dice.between(-0.3, 0.3) : dice.between(3, 6);
            if (dice.happens(0.3)) region.polygon.pop_back();
            region.first_frame = dice.number(0, 130);
            region.last_frame = region.first_frame + dice.number(0, 30);
            set.regions[k] = region;
        }
        SequenceRecord sequence;
        sequence.frame_count = i % 5 == 4 ? 0 : dice.number(1, 150);
        std::map<FrameIndex, std::vector<LabelBox>> slow;
        for (FrameIndex frame = 0; frame < (sequence.frame_count > 0 ? sequence.frame_count : 400); ++frame) {
            for (const auto& [id, object] : set.objects) {
                const LabelledBox shown = boxAt(object, frame, {});
                if (!shown.visible()) continue;
                LabelBox each;
                each.id = id;
                each.box = shown.box;
                each.ignore = shown.ignore;
                each.occlusion = shown.occlusion;
                each.object_class = object.object_class;
                slow[frame].push_back(each);
            }
            for (const auto& [id, region] : set.regions) {
                if (frame < region.first_frame || frame > region.last_frame) continue;
                LabelBox each;
                each.ignore = true;
                // What is a rectangle but for half a pixel is one box.
                const bool whole = region.polygon.size() == 4 && std::abs(region.polygon[2].x - 40) < 1;
                if (whole) {
                    each.box.length = -1;
                    slow[frame].push_back(each);
                    continue;
                }
                for (const OrientedBox& box : coveringBoxes(region.polygon)) {
                    each.box = box;
                    slow[frame].push_back(each);
                }
            }
        }
        const LabelFile labels = labelsOf(set, sequence, {});
        std::vector<FrameIndex> frames, slow_frames;
        for (const auto& [frame, records] : labels.boxes) frames.push_back(frame);
        for (const auto& [frame, records] : slow) slow_frames.push_back(frame);
        ASSERT_EQ(frames, slow_frames) << i;
        for (const auto& [frame, records] : slow) {
            const auto& found = labels.boxes.at(frame);
            ASSERT_EQ(found.size(), records.size()) << i << ", frame " << frame;
            for (std::size_t k = 0; k < found.size(); ++k) {
                ASSERT_EQ(found[k].frame, frame);
                ASSERT_EQ(found[k].id, records[k].id);
                ASSERT_EQ(found[k].ignore, records[k].ignore);
                ASSERT_EQ(found[k].occlusion, records[k].occlusion);
                ASSERT_EQ(found[k].object_class, records[k].object_class);
                if (records[k].box.length < 0) {
                    EXPECT_NEAR(found[k].box.area(), 600, 30);
                    continue;
                }
                ASSERT_NEAR(found[k].box.centre.x, records[k].box.centre.x, 1e-9);
                ASSERT_NEAR(found[k].box.centre.y, records[k].box.centre.y, 1e-9);
                ASSERT_NEAR(found[k].box.length, records[k].box.length, 1e-9);
            }
        }
    }
}

class RunLabels : public testing::Test {
 protected:
    /// A run over so many frames; tracks 1 … `tracks` are there in each but every seventh.
    RunRecord written(int frames, int tracks, bool gsd_known, const std::string& path = "/nowhere/clip.mp4") {
        RunRecord planned;
        planned.sequence = {.path = path, .size = {320, 240}, .frame_count = frames, .frame_rate_hz = 30};
        planned.scale = {0.25, 30, gsd_known, {}};
        return test::writeRun(path_, planned, [&](int frame, FrameResult& result) {
            result.motion.time_us = std::int64_t{33'000} * frame;
            result.motion.registration.current_from_previous.matrix(0, 2) = -2;
            if (frame % 7 == 6) return;
            for (int id = 1; id <= tracks; ++id) {
                TrackState state;
                state.id = id;
                state.box = {{30.0 + 2 * frame, 40.0 * id}, 20, 8, 0};
                state.status = TrackStatus::confirmed;
                result.tracks.push_back(state);
                Detection detection;
                detection.box = state.box;
                detection.box.centre.x += 1;
                result.detections.push_back(detection);
            }
        });
    }
    /// "0: 1 2; 1: …", of tracks their numbers, of detections a d.
    static std::string told(const LabelStream& labels) {
        std::string text;
        labels.frames([&](FrameIndex frame, const std::vector<LabelBox>& boxes) {
            text += std::to_string(frame) + ":";
            for (const LabelBox& box : boxes) {
                EXPECT_EQ(box.frame, frame);
                text += box.id ? " " + std::to_string(*box.id) : " d";
            }
            text += "; ";
        });
        return text;
    }
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "p.eyrie";
};

TEST_F(RunLabels, TracksAndDetectionsLeaveFrameByFrame) {
    const RunRecord run = written(9, 2, true);
    ProjectFile project = ProjectFile::open(path_, ProjectFile::Mode::read_only);
    const RunStore store(project);
    const LabelStream tracks = labelStreamOf(store, run, false);
    EXPECT_EQ(told(tracks), "0: 1 2; 1: 1 2; 2: 1 2; 3: 1 2; 4: 1 2; 5: 1 2; 7: 1 2; 8: 1 2; ");
    EXPECT_EQ(told(labelStreamOf(store, run, true)),
              "0: d d; 1: d d; 2: d d; 3: d d; 4: d d; 5: d d; 7: d d; 8: d d; ");
    EXPECT_EQ(tracks.about.gsd_m, 0.25);
    EXPECT_EQ(tracks.about.frame_count, 9);
    EXPECT_EQ(tracks.about.frame_rate_hz, 30);
    EXPECT_EQ(tracks.about.image_size, cv::Size(320, 240));
    EXPECT_TRUE(tracks.about.notes.empty());
    CorrectedTracks none;
    EXPECT_EQ(told(labelStreamOf(store, run, none)), told(tracks));
    EXPECT_TRUE(labelStreamOf(store, run, none).about.notes.empty());
    CorrectedTracks without_first;
    without_first.replaced = {1};
    without_first.rejected[1] = {};
    without_first.applied[CorrectionKind{}] = 1;
    const LabelStream corrected = labelStreamOf(store, run, without_first);
    EXPECT_EQ(told(corrected), "0: 2; 1: 2; 2: 2; 3: 2; 4: 2; 5: 2; 7: 2; 8: 2; ");
    ASSERT_EQ(corrected.about.notes.size(), 1U);
    EXPECT_THAT(corrected.about.notes[0], testing::StartsWith("tracks as people corrected them: "));
}

TEST_F(RunLabels, AScaleThatNobodyKnowsIsNotTold) {
    const RunRecord run = written(3, 1, false);
    ProjectFile project = ProjectFile::open(path_, ProjectFile::Mode::read_only);
    EXPECT_FALSE(labelStreamOf(RunStore(project), run, false).about.gsd_m);
}

TEST_F(RunLabels, TheCameraIsThatOfTheLastRunOverTheVideoWithTwoFrames) {
    const RunRecord first = written(5, 1, false);
    written(4, 1, false, "/nowhere/other.mp4");
    const RunRecord second = written(2, 1, false);
    written(1, 1, false);
    ProjectFile project = ProjectFile::open(path_, ProjectFile::Mode::read_only);
    const RunStore store(project);
    const auto last = lastRunOver(store, first.sequence.id);
    ASSERT_TRUE(last);
    EXPECT_EQ(last->id, second.id);
    EXPECT_FALSE(lastRunOver(store, 99));
    const CameraMotion camera = cameraMotionOf(store, first.sequence.id);
    EXPECT_TRUE(camera.connects(0, 1));
    EXPECT_FALSE(camera.connects(1, 2));
    EXPECT_NEAR(camera.map(0, 1)->apply({10, 10}).x, 8, 1e-9);
    EXPECT_TRUE(cameraMotionOf(store, 99).empty());
    // A label between keyframes runs over that ground, and says so only where there is none.
    EXPECT_TRUE(labelStreamOf(AnnotationSet{}, first.sequence, camera).about.notes.empty());
    EXPECT_EQ(labelStreamOf(AnnotationSet{}, first.sequence, {}).about.notes.size(), 1U);
}

}  // namespace
}  // namespace eyrie::slow_exchange_test
