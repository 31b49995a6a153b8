#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include "annotation/edits/ignore_regions.h"

#include "core/error.h"
#include "exchange/label_import.h"
#include "exchange/project_labels.h"
#include "formats/label_formats.h"
#include "support/temporary_folder.h"

namespace eyrie::label_exchange_test {
namespace {

using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class LabelExchange : public testing::Test {
 protected:
    LabelExchange() : project_(ProjectFile::create(folder_ / "p.eyrie")) {
        sequence_.path = "/nowhere/clip.mp4";
        sequence_.size = {160, 120};
        sequence_.frame_count = 20;
        sequence_.frame_rate_hz = 25;
        sequence_.id = ensureSequence(project_, sequence_);
    }
    /// Drives to the right at 2 px/frame in the image; hidden from frame 8 on.
    static LabelFile car(int frames) {
        LabelFile labels;
        for (int frame = 0; frame < frames; ++frame) {
            LabelBox box;
            box.frame = frame;
            box.id = 4;
            box.object_class = "tram";
            box.box = {{30.0 + 2 * frame, 40}, 20, 8, 0};
            box.occlusion = frame < 8 ? Occlusion::none : Occlusion::partly;
            labels.boxes[frame].push_back(box);
        }
        return labels;
    }
    test::TemporaryFolder folder_;
    ProjectFile project_;
    SequenceRecord sequence_;
};

TEST_F(LabelExchange, APlanChangesNothingUntilItIsApplied) {
    AnnotationStore store(project_, sequence_.id);
    const LabelImport plan = planImport(car(24), sequence_, {}, store, 0.5);
    EXPECT_TRUE(store.annotations().objects.empty());
    EXPECT_EQ(plan.objects, 1);
    EXPECT_EQ(plan.boxes, 20);
    EXPECT_THAT(plan.notes, Contains(HasSubstr("4 boxes lie after the video's last frame, 19")));
    EXPECT_THAT(plan.notes, Contains(HasSubstr("never registered")));
    store.apply(plan.edit);
    ASSERT_TRUE(store.annotations().objects.contains(4));
    EXPECT_LE(store.annotations().objects.at(4).keyframes.size(), 4u);
    ASSERT_EQ(store.annotations().classes.size(), 1u);
    EXPECT_EQ(store.annotations().classes[0].name, "tram");

    const LabelFile back = labelsOf(store.annotations(), sequence_, {});
    const LabelFile before = car(20);
    ASSERT_EQ(back.boxes.size(), 20u);
    for (const auto& [frame, records] : before.boxes) {
        const LabelBox& found = back.boxes.at(frame)[0];
        EXPECT_NEAR(cv::norm(found.box.centre - records[0].box.centre), 0, 0.5);
        EXPECT_EQ(found.occlusion, records[0].occlusion) << frame;
        EXPECT_EQ(found.object_class, "tram");
    }
}

/// Two keyframes say as little or as much however many frames lie between them.
TEST_F(LabelExchange, KeyframesFarBehindTheVideoCostNothing) {
    const std::filesystem::path file = folder_ / "far.xml";
    const int far = 900'000;
    std::ofstream(file) << "<annotations><track id=\"1\" label=\"car\">"
                        << "<box frame=\"0\" keyframe=\"1\" xtl=\"10\" ytl=\"10\" xbr=\"30\" ybr=\"20\"/>"
                        << "<box frame=\"" << far
                        << "\" keyframe=\"1\" xtl=\"110\" ytl=\"60\" xbr=\"130\" ybr=\"70\"/></track></annotations>";
    const LabelFile all = readLabels(file);
    ASSERT_EQ(all.boxes.size(), std::size_t{far + 1});
    EXPECT_EQ(all.not_filled, 0);
    ImportOptions options;
    options.frame_count = sequence_.frame_count;
    const LabelFile labels = readLabels(file, "auto", options);
    EXPECT_LT(labels.boxes.size(), 20'000u);
    ASSERT_TRUE(labels.boxes.contains(far)) << "what is said of a frame is there";
    EXPECT_EQ(labels.boxes.size() + static_cast<std::size_t>(labels.not_filled), all.boxes.size());
    EXPECT_THAT(reportOn(labels).notes, Contains(HasSubstr("far beyond the video's end")));

    AnnotationStore store(project_, sequence_.id);
    const LabelImport few = planImport(labels, sequence_, {}, store, 0.45);
    const LabelImport plan = planImport(all, sequence_, {}, store, 0.45);
    EXPECT_EQ(few.notes, plan.notes);
    EXPECT_THAT(few.notes, Contains(HasSubstr("899981 boxes lie after the video's last frame")));
    EXPECT_EQ(few.boxes, 20);
    ASSERT_EQ(few.edit.objects.size(), 1u);
    const std::vector<Keyframe>& keyframes = few.edit.objects[0].after->keyframes;
    const std::vector<Keyframe>& expected = plan.edit.objects[0].after->keyframes;
    ASSERT_EQ(keyframes.size(), expected.size());
    EXPECT_EQ(keyframes.back().frame, expected.back().frame);
    EXPECT_EQ(keyframes.back().box.centre, expected.back().box.centre);

    // Frames of the file are not those of the video where they are shifted.
    options.frame_shift = 100;
    EXPECT_EQ(readLabels(file, "auto", options).boxes.size(), labels.boxes.size() - 100);
}

TEST_F(LabelExchange, AFileImportedTwiceAddsNothingUnlessAsked) {
    AnnotationStore store(project_, sequence_.id);
    LabelFile labels = car(20);
    LabelBox region;
    region.ignore = true;
    region.box = {{80, 60}, 30, 20, 0};
    for (int frame = 0; frame < 20; ++frame) {
        region.frame = frame;
        labels.boxes[frame].push_back(region);
    }
    for (const double tolerance : {1.5, 0.0}) {
        const LabelImport first = planImport(labels, sequence_, {}, store, tolerance);
        EXPECT_EQ(first.doubles, tolerance > 0 ? 0 : 2) << "the second time around all is there";
        if (!first.edit.empty()) store.apply(first.edit);
    }
    ASSERT_EQ(store.annotations().objects.size(), 1u);
    ASSERT_EQ(store.annotations().regions.size(), 1u);
    const LabelImport again = planImport(labels, sequence_, {}, store, 1.5);
    EXPECT_TRUE(again.edit.empty());
    EXPECT_THAT(again.notes, Contains(HasSubstr("labelled already")));

    // A second car in the file is new, also where it is near.
    for (auto& [frame, records] : labels.boxes) {
        LabelBox beside = records[0];
        beside.id = 5;
        beside.box.centre.y += 4;
        records.push_back(beside);
    }
    const LabelImport one_more = planImport(labels, sequence_, {}, store, 1.5);
    EXPECT_EQ(one_more.objects, 1);
    EXPECT_EQ(one_more.doubles, 2);
    const LabelImport all = planImport(labels, sequence_, {}, store, 1.5, Doubles::add);
    EXPECT_EQ(all.objects, 2);
    EXPECT_EQ(all.doubles, 0);
}

/// Whole pixels with the axes of the image must come back to the digit, however the camera turns and zooms below them.
TEST_F(LabelExchange, UprightBoxesComeBackToTheDigitUnderATurningCamera) {
    std::vector<Homography> steps;
    for (int frame = 0; frame + 1 < 20; ++frame) {
        Homography step;
        step.from_frame = frame;
        step.to_frame = frame + 1;
        const double scale = 1.002, turn = 0.004;
        step.matrix = {scale * std::cos(turn),
                       -scale * std::sin(turn),
                       0.6,
                       scale * std::sin(turn),
                       scale * std::cos(turn),
                       -0.3,
                       0,
                       0,
                       1};
        steps.push_back(step);
    }
    const CameraMotion camera(steps);
    LabelFile labels;
    for (int frame = 0; frame < 20; ++frame) {
        for (const int id : {1, 2, 3}) {  // one stands on the ground, one in the image, one jitters
            LabelBox box;
            box.frame = frame;
            box.id = id;
            box.object_class = "car";
            cv::Point2d corner(40, 30);
            if (id == 1) corner = camera.map(0, frame)->apply({90, 60});
            if (id == 3) corner = {100.0 + 3 * frame, 20.0 + (frame * 7) % 3};
            const double left = std::round(corner.x), top = std::round(corner.y);
            box.box = boxFromEdges({left, top, 21, 10.0 + (id == 3 ? frame % 2 : 0)}, 0);
            labels.boxes[frame].push_back(box);
        }
    }
    AnnotationStore store(project_, sequence_.id);
    store.apply(planImport(labels, sequence_, camera, store, 0.45).edit);
    const LabelFile back = labelsOf(store.annotations(), sequence_, camera);
    EXPECT_EQ(reportOn(back).turned, 0);
    for (const auto& [frame, records] : labels.boxes) {
        ASSERT_EQ(back.boxes.at(frame).size(), 3u);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(back.boxes.at(frame)[i].box.heading, 0) << frame;
            const BoxEdges before = edgesOf(records[i].box, 0);
            const BoxEdges after = edgesOf(back.boxes.at(frame)[i].box, 0);
            EXPECT_EQ(std::round(after.left), before.left) << frame;
            EXPECT_EQ(std::round(after.top), before.top) << frame;
            EXPECT_EQ(std::round(after.left + after.width), before.left + before.width) << frame;
            EXPECT_EQ(std::round(after.top + after.height), before.top + before.height) << frame;
        }
    }
    EXPECT_LT(store.annotations().objects.at(2).keyframes.size(), 20u) << "still few keyframes";
}

TEST_F(LabelExchange, FramesComeOneByOneAndTheSameAgain) {
    AnnotationSet annotations;
    const auto addObject = [&](int id, FrameIndex first, FrameIndex last) {
        LabelledObject object;
        object.id = id;
        object.object_class = "car";
        object.keyframes.resize(1);
        object.keyframes[0].frame = first;
        object.keyframes[0].box = {{20.0 + id, 30}, 10, 5, 0};
        object.last_frame = last;
        annotations.objects[id] = object;
    };
    addObject(9, 2, 4);
    addObject(3, 4, 5);
    addObject(5, 12, 1'000'000);  // behind a gap, and beyond the video
    IgnoreRegion region;
    region.id = 1;
    region.polygon = {{10, 10}, {30, 10}, {30, 30}, {10, 30}};
    region.first_frame = 5;
    region.last_frame = 7;
    annotations.regions[1] = region;
    const CameraMotion camera;
    const LabelStream labels = labelStreamOf(annotations, sequence_, camera);
    const auto told = [&] {
        std::string text;
        labels.frames([&](FrameIndex frame, const std::vector<LabelBox>& boxes) {
            text += std::to_string(frame) + ':';
            for (const LabelBox& box : boxes) text += ' ' + (box.id ? std::to_string(*box.id) : "area");
            text += '\n';
        });
        return text;
    };
    const std::string once = told();
    EXPECT_THAT(once, StartsWith("2: 9\n3: 9\n4: 3 9\n5: 3 area\n6: area\n7: area\n12: 5\n13: 5\n"));
    EXPECT_THAT(once, EndsWith("19: 5\n"));
    EXPECT_EQ(told(), once);
}

TEST_F(LabelExchange, RegionsLeaveAsBoxesThatCoverThem) {
    AnnotationSet annotations;
    IgnoreRegion square;
    square.id = 1;
    square.polygon = {{10, 10}, {30, 10}, {30, 30}, {10, 30}};
    square.first_frame = 2;
    square.last_frame = 3;
    annotations.regions[1] = square;
    IgnoreRegion triangle = square;
    triangle.id = 2;
    triangle.polygon = {{60, 20}, {120, 20}, {60, 80}};
    triangle.last_frame = 1'000'000;  // behind the video
    annotations.regions[2] = triangle;
    const LabelFile labels = labelsOf(annotations, sequence_, {});
    EXPECT_EQ(labels.boxes.rbegin()->first, 19);
    const OrientedBox first = labels.boxes.at(2)[0].box;
    EXPECT_NEAR(first.centre.x, 20, 1e-9);
    EXPECT_NEAR(first.area(), 400, 1e-9);
    EXPECT_GT(labels.boxes.at(2).size(), 2u);
    double covered = 0;
    for (const LabelBox& box : labels.boxes.at(5)) {
        EXPECT_TRUE(box.ignore);
        EXPECT_FALSE(box.id);
        covered += box.box.area();
    }
    EXPECT_GE(covered, 1800);  // the triangle
    EXPECT_LT(covered, 2600);  // and not its square of 3600
}

/// Detections of two cars that pass each other, and one lone box of another class; nobody numbered them.
LabelFile detections() {
    LabelFile labels;
    for (int frame = 0; frame < 10; ++frame) {
        for (const int lane : {0, 1}) {
            if (frame == 6 && lane == 1) continue;
            LabelBox box;
            box.frame = frame;
            box.object_class = "car";
            box.box = {{lane == 0 ? 20.0 + 6 * frame : 80.0 - 6 * frame, 40.0 + 15 * lane}, 18, 9, 0};
            labels.boxes[frame].push_back(box);
        }
    }
    LabelBox lone = labels.boxes[3][0];
    lone.object_class = "person";
    labels.boxes[3].push_back(lone);
    return labels;
}

TEST_F(LabelExchange, BoxesWithoutIdBecomeObjectsOfOneFrame) {
    AnnotationStore store(project_, sequence_.id);
    const LabelImport plan = planImport(detections(), sequence_, {}, store, 0.45);
    EXPECT_EQ(plan.objects, 20);
    EXPECT_EQ(plan.loose.boxes, 20);
    EXPECT_THAT(plan.notes, Contains(HasSubstr("20 boxes have no id; each is an object of one frame")));
    store.apply(plan.edit);
    const LabelFile back = labelsOf(store.annotations(), sequence_, {});
    const LabelFile before = detections();
    for (const auto& [frame, records] : before.boxes) {
        ASSERT_EQ(back.boxes.at(frame).size(), records.size()) << frame;
        for (std::size_t i = 0; i < records.size(); ++i)
            EXPECT_NEAR(cv::norm(back.boxes.at(frame)[i].box.centre - records[i].box.centre), 0, 1e-6);
    }
    // the same file again adds nothing
    const LabelImport again = planImport(detections(), sequence_, {}, store, 0.45);
    EXPECT_EQ(again.objects, 0);
    EXPECT_EQ(again.doubles, 20);
}

TEST_F(LabelExchange, BoxesWithoutIdAreLinkedOnRequest) {
    AnnotationStore store(project_, sequence_.id);
    const LabelImport plan = planImport(detections(), sequence_, {}, store, 0.45, Doubles::skip, LooseBoxes::link);
    EXPECT_EQ(plan.objects, 4) << "a car, another before and behind its gap, a person";
    EXPECT_THAT(plan.notes, Contains(HasSubstr("into 4 objects")));
    store.apply(plan.edit);
    int whole = 0;
    for (const auto& [id, object] : store.annotations().objects) {
        const bool first_lane = std::abs(object.keyframes.front().box.centre.y - 40) < 1;
        EXPECT_EQ(object.last_frame == 3, object.object_class == "person");
        for (const Keyframe& keyframe : object.keyframes)
            EXPECT_EQ(std::abs(keyframe.box.centre.y - 40) < 1, first_lane) << "stays in its lane";
        whole += object.keyframes.front().frame == 0 && object.last_frame == 9;
    }
    EXPECT_EQ(whole, 1);
}

TEST_F(LabelExchange, LinkingKeepsTheIdsThatThereAre) {
    LabelFile labels = detections();
    for (auto& [frame, records] : labels.boxes) records[0].id = 30;
    const LooseBoxCount count = gatherLooseBoxes(labels, LooseBoxes::link);
    EXPECT_EQ(count.boxes, 10);
    EXPECT_EQ(count.objects, 3);
    for (const auto& [frame, records] : labels.boxes) {
        EXPECT_EQ(records[0].id, 30);
        for (std::size_t i = 1; i < records.size(); ++i) EXPECT_GT(records[i].id, 30);
    }
}

TEST_F(LabelExchange, IdsThatLeaveNoRoomAreNotKept) {
    AnnotationStore store(project_, sequence_.id);
    LabelFile labels = detections();
    labels.boxes[0][0].id = 2147483647;
    store.apply(planImport(labels, sequence_, {}, store, 0.45).edit);
    EXPECT_EQ(store.annotations().objects.size(), 20u);
    EXPECT_EQ(store.annotations().objects.rbegin()->first, 20);
    EXPECT_GT(store.newObjectId(), 20);
}

/// A car that stands at x in these frames.
void addTo(LabelFile& labels, int id, double x, FrameIndex first, FrameIndex last) {
    for (FrameIndex frame = first; frame <= last; ++frame) {
        LabelBox box;
        box.frame = frame;
        box.id = id;
        box.object_class = "car";
        box.box = {{x, 40}, 20, 8, 0};
        labels.boxes[frame].push_back(box);
    }
}

/// The frames in which an object is seen, ignored ones with an i, partly hidden ones with a p: "0 1 2p 5i".
std::string framesOf(const LabelFile& labels, int id) {
    std::string frames;
    for (const auto& [frame, records] : labels.boxes) {
        for (const LabelBox& box : records) {
            if (box.id != id) continue;
            frames += (frames.empty() ? "" : " ") + std::to_string(frame);
            if (box.ignore) frames += "i";
            if (box.occlusion == Occlusion::partly) frames += "p";
        }
    }
    return frames;
}

TEST_F(LabelExchange, AnObjectIsSeenAndFlaggedInTheFramesOfTheFileAndNoOthers) {
    LabelFile labels;
    addTo(labels, 4, 30, 1, 5);
    addTo(labels, 4, 40, 8, 8);
    addTo(labels, 4, 50, 11, 19);
    addTo(labels, 5, 90, 3, 3);
    addTo(labels, 6, 120, 0, 19);
    for (const FrameIndex frame : {3, 4, 12}) labels.boxes[frame][0].occlusion = Occlusion::partly;
    for (const FrameIndex frame : {13, 14}) labels.boxes[frame][0].ignore = true;
    for (const double tolerance : {0.5, 0.0}) {
        ProjectFile project = ProjectFile::create(folder_ / ("p" + std::to_string(tolerance) + ".eyrie"));
        SequenceRecord sequence = sequence_;
        sequence.id = ensureSequence(project, sequence);
        AnnotationStore store(project, sequence.id);
        store.apply(planImport(labels, sequence, {}, store, tolerance).edit);
        const LabelFile back = labelsOf(store.annotations(), sequence, {});
        EXPECT_EQ(framesOf(back, 4), framesOf(labels, 4));
        EXPECT_EQ(framesOf(back, 4), "1 2 3p 4p 5 8 11 12p 13i 14i 15 16 17 18 19");
        EXPECT_EQ(framesOf(back, 5), "3");
        EXPECT_EQ(framesOf(back, 6), framesOf(labels, 6));
        EXPECT_EQ(store.annotations().objects.at(4).last_frame, 19);
        EXPECT_EQ(store.annotations().objects.at(5).last_frame, 3);
        for (const auto& [frame, records] : labels.boxes) {
            ASSERT_EQ(back.boxes.at(frame).size(), records.size());
            for (std::size_t i = 0; i < records.size(); ++i)
                EXPECT_NEAR(back.boxes.at(frame)[i].box.centre.x, records[i].box.centre.x, 0.5) << frame;
        }
    }
}

TEST_F(LabelExchange, OverAGapAnObjectIsOutsideFromTheFrameBehindItsLastBoxOn) {
    LabelFile labels;
    addTo(labels, 4, 30, 1, 5);
    addTo(labels, 4, 40, 8, 19);
    AnnotationStore store(project_, sequence_.id);
    const LabelImport plan = planImport(labels, sequence_, {}, store, 0.5);
    std::vector<FrameIndex> outside;
    for (const Keyframe& keyframe : plan.edit.objects.at(0).after->keyframes)
        if (keyframe.outside) outside.push_back(keyframe.frame);
    EXPECT_THAT(outside, testing::ElementsAre(6));
}

TEST_F(LabelExchange, ObjectsAsTheFileKeepsThemStayUnlessTheVideoCutsThem) {
    LabelFile labels;
    addTo(labels, 4, 30, 0, 19);
    LabelledObject object;
    object.id = 4;
    object.object_class = "car";
    object.keyframes.resize(1);
    object.keyframes[0].box = labels.boxes[0][0].box;
    object.keyframes[0].heading_set = true;
    object.last_frame = 19;
    labels.objects = {object};
    AnnotationStore store(project_, sequence_.id);
    const LabelImport whole = planImport(labels, sequence_, {}, store, 0);
    ASSERT_EQ(whole.edit.objects.size(), 1U);
    EXPECT_EQ(whole.keyframes, 1) << "the file's own";
    EXPECT_TRUE(whole.notes.empty());
    addTo(labels, 4, 30, 20, 20);
    const LabelImport cut = planImport(labels, sequence_, {}, store, 0);
    EXPECT_EQ(cut.boxes, 20);
    EXPECT_EQ(cut.keyframes, 20) << "each box that is left";
    EXPECT_THAT(cut.notes, Contains(HasSubstr("1 boxes lie after the video's last frame, 19")));
    SequenceRecord unknown_length = sequence_;
    unknown_length.frame_count = 0;
    EXPECT_EQ(planImport(labels, unknown_length, {}, store, 0).boxes, 21);
}

TEST_F(LabelExchange, NumbersAndClassesThatAreThereStay) {
    AnnotationStore store(project_, sequence_.id);
    const auto call = [](LabelFile& labels, std::size_t which, const std::string& name) {
        for (auto& [frame, records] : labels.boxes) records[which].object_class = name;
    };
    LabelFile first;
    addTo(first, 4, 30, 0, 9);
    call(first, 0, "tram");
    EXPECT_EQ(planImport(first, sequence_, {}, store, 0.5).edit.name, "Import 1 object");
    store.apply(planImport(first, sequence_, {}, store, 0.5).edit);
    EXPECT_TRUE(store.annotations().objects.contains(4)) << "as in the file";
    LabelFile second;
    addTo(second, 2, 80, 0, 9);
    addTo(second, 3, 120, 0, 9);
    call(second, 0, "tram");
    call(second, 1, "ferry");
    const LabelImport plan = planImport(second, sequence_, {}, store, 0.5);
    EXPECT_EQ(plan.edit.name, "Import 2 objects");
    store.apply(plan.edit);
    std::vector<ObjectId> ids;
    for (const auto& [id, object] : store.annotations().objects) ids.push_back(id);
    EXPECT_THAT(ids, testing::ElementsAre(4, 5, 6)) << "the next free ones";
    std::vector<std::string> classes;
    for (const ObjectClass& entry : store.annotations().classes) classes.push_back(entry.name);
    EXPECT_THAT(classes, testing::ElementsAre("tram", "ferry"));
    LabelFile third;
    addTo(third, 1, 140, 0, 3);
    call(third, 0, "ferry");
    EXPECT_FALSE(planImport(third, sequence_, {}, store, 0.5).edit.classes) << "its class is known";
    EXPECT_TRUE(planImport(LabelFile{}, sequence_, {}, store, 0.5).edit.empty());
}

}  // namespace
}  // namespace eyrie::label_exchange_test
