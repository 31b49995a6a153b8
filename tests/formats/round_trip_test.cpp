#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "formats/frame_offset.h"
#include "formats/sample_labels.h"
#include "support/shared_data.h"

namespace eyrie::round_trip_test {
namespace {

using test::sampleLabels;
using testing::Contains;
using testing::HasSubstr;

/// How exactly a format brings boxes back; 0 degrees tolerance means that it carries headings.
struct Trip {
    const char* format;
    double px;       ///< largest error of centre and size
    double degrees;  ///< largest error of headings; below 0: upright boxes come back
};

class RoundTrip : public testing::TestWithParam<Trip> {
 protected:
    std::filesystem::path target(const LabelFormatInfo& info) const {
        if (info.folder) return folder_ / "labels_of_it";
        return folder_ / ("boxes." + (info.extensions.empty() ? "txt" : info.extensions.front()));
    }
    test::TemporaryFolder folder_;
};

const LabelFormatInfo& infoOf(const std::string& name) {
    const auto& all = labelFormats();
    return *std::find_if(all.begin(), all.end(), [&](const LabelFormatInfo& info) { return info.name == name; });
}

ExportOptions exportOptions() {
    ExportOptions options;
    options.columns = "frame,id,cname,x1,y1,w,h,heading,score,ignore,occluded";
    return options;
}

const LabelBox* find(const LabelBoxes& boxes, const LabelBox& wanted, bool has_id) {
    const auto frame = boxes.find(wanted.frame);
    if (frame == boxes.end()) return nullptr;
    const LabelBox* nearest = nullptr;
    for (const LabelBox& box : frame->second) {
        if (has_id && box.id != wanted.id) continue;
        if (nearest == nullptr ||
            cv::norm(box.box.centre - wanted.box.centre) < cv::norm(nearest->box.centre - wanted.box.centre)) {
            nearest = &box;
        }
    }
    return nearest;
}

TEST_P(RoundTrip, BoxesComeBackAsFarAsTheFormatCarriesThem) {
    const Trip trip = GetParam();
    const LabelFormatInfo& info = infoOf(trip.format);
    Carries carries = info.carries;
    if (info.name == "columns") carries = {true, true, true, true, true, true};
    const LabelFile before = sampleLabels();
    writeLabels(before, target(info), info.name, exportOptions());
    ImportOptions options;
    if (info.name == "columns") options.columns = exportOptions().columns;
    const std::filesystem::path file = info.name == "uavdt" ? folder_ / "boxes_gt.txt" : target(info);
    const LabelFile after = readLabels(file, "auto", options);
    EXPECT_EQ(after.format, info.name) << "found by itself";

    const bool renumbered = info.name == "trackeval";
    std::size_t boxes = 0;
    for (const auto& [frame, records] : after.boxes) boxes += records.size();
    EXPECT_EQ(boxes, 32u);
    for (const auto& [frame, records] : before.boxes) {
        for (const LabelBox& a : records) {
            // ignored areas have neither id nor class
            const bool anonymous = (info.name == "uavdt" || info.name == "visdrone") && a.ignore;
            const LabelBox* found = find(after.boxes, a, carries.id && !anonymous && !renumbered);
            ASSERT_TRUE(found) << "frame " << frame << " id " << *a.id;
            const LabelBox& b = *found;
            const OrientedBox box = trip.degrees < 0 ? a.box.upright() : a.box;
            EXPECT_NEAR(box.centre.x, b.box.centre.x, trip.px);
            EXPECT_NEAR(box.centre.y, b.box.centre.y, trip.px);
            EXPECT_NEAR(box.length, b.box.length, 2 * trip.px);
            EXPECT_NEAR(box.width, b.box.width, 2 * trip.px);
            if (trip.degrees >= 0) {
                EXPECT_NEAR(std::abs(turnBetween(box.heading, b.box.heading)), 0, radiansFromDegrees(trip.degrees));
            }
            if (carries.ignore) {
                EXPECT_EQ(a.ignore, b.ignore);
            }
            const bool knows_degrees = info.name != "uavdt" && info.name != "mot-cvat";
            if (carries.occlusion && knows_degrees && !anonymous) {
                EXPECT_EQ(a.occlusion, b.occlusion);
            }
            if (info.name == "mot-cvat") {
                EXPECT_EQ(a.occlusion == Occlusion::none, b.occlusion == Occlusion::none);
            }
            const bool knows_vans =
                info.name != "mot" && info.name != "trackeval" && info.name != "uavdt" && info.name != "virat";
            if (carries.object_class && knows_vans && !anonymous) {
                EXPECT_EQ(a.object_class, b.object_class);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         testing::Values(Trip{"native", 1e-4, 1e-3}, Trip{"native-result", 1e-4, 1e-3},
                                         Trip{"mot", 2e-3, -1}, Trip{"mot-cvat", 2e-3, -1},
                                         Trip{"mot-result", 2e-3, -1}, Trip{"trackeval", 2e-3, -1},
                                         Trip{"cvat", 0.03, 0.03}, Trip{"coco", 1e-3, 1e-3}, Trip{"kwcoco", 1e-3, 1e-3},
                                         Trip{"dota", 2e-3, 0.02}, Trip{"yolo-obb", 1e-4, 1e-3},
                                         Trip{"visdrone", 1.0, -1}, Trip{"uavdt", 1.0, -1}, Trip{"kw18", 1e-3, -1},
                                         Trip{"virat", 2e-3, -1}, Trip{"viame", 1e-3, 1e-3}, Trip{"vivid", 2e-3, -1},
                                         Trip{"columns", 1e-3, 1e-3}),
                         [](const auto& entry) {
                             std::string name = entry.param.format;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(RoundTrips, CoverEveryFormat) {
    const auto& all = labelFormats();
    EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const LabelFormatInfo& info) { return info.reads; }), 18);
}

/// Writing what was read must say the same bytes: nothing drifts by half a pixel or a frame.
TEST_P(RoundTrip, WritingAgainChangesNothing) {
    const LabelFormatInfo& info = infoOf(GetParam().format);
    const ExportOptions options = exportOptions();
    ImportOptions import;
    if (info.name == "columns") import.columns = options.columns;
    writeLabels(sampleLabels(), target(info), info.name, options);
    const auto written = [&](const char* name) {
        return info.name == "uavdt" ? folder_ / (std::string(name) + "_gt.txt") : folder_ / name;
    };
    LabelFile once = readLabels(info.name == "uavdt" ? written("boxes") : target(info), info.name, import);
    once.image_size = cv::Size(320, 240);
    once.frame_count = 14;
    once.frame_rate_hz = 25;
    writeLabels(once, written("again"), info.name, options);
    LabelFile twice = readLabels(written("again"), info.name, import);
    EXPECT_EQ(once.boxes.size(), twice.boxes.size());
    for (const auto& [frame, records] : once.boxes) {
        ASSERT_EQ(records.size(), twice.boxes[frame].size());
        for (std::size_t i = 0; i < records.size(); ++i) {
            const LabelBox* same = find(twice.boxes, records[i], records[i].id.has_value());
            ASSERT_TRUE(same);
            EXPECT_NEAR(cv::norm(records[i].box.centre - same->box.centre), 0,
                        GetParam().format == std::string("cvat") ? 0.04 : 2e-3);
        }
    }
}

struct RoundTripLosses : testing::Test {
    test::TemporaryFolder folder_;
};

TEST_F(RoundTripLosses, AreToldInNumbers) {
    const LabelFile labels = sampleLabels();
    const ExportReport mot = writeLabels(labels, folder_ / "gt.txt", "mot");
    EXPECT_EQ(mot.boxes, 32);
    EXPECT_GE(mot.lost(LossKind::rotation), 20);
    EXPECT_EQ(mot.lost(LossKind::class_name), 20);  // vans and trucks have no number of their own
    EXPECT_TRUE(std::filesystem::exists(folder_ / "gt.oriented.csv"));
    const ExportReport kw18 = writeLabels(labels, folder_ / "t.kw18", "kw18");
    EXPECT_EQ(kw18.lost(LossKind::ignore), 6);
    EXPECT_EQ(kw18.lost(LossKind::occlusion), 3);
    EXPECT_EQ(kw18.lost(LossKind::class_name), 32);
    EXPECT_THAT(kw18.losses.front().remark,
                HasSubstr("boxes lost their rotation: the enclosing upright boxes were written"));
    const ExportReport dota = writeLabels(labels, folder_ / "dota", "dota");
    EXPECT_EQ(dota.lost(LossKind::id), 32);
    EXPECT_EQ(dota.lost(LossKind::rotation), 0);
    const ExportReport native = writeLabels(labels, folder_ / "n.csv", "native");
    EXPECT_EQ(native.lost(LossKind::occlusion), 3);
    EXPECT_EQ(native.losses.size(), 1u);
    const ExportReport visdrone = writeLabels(labels, folder_ / "v.txt", "visdrone");
    EXPECT_GT(visdrone.lost(LossKind::rounded), 10);
}

TEST_F(RoundTripLosses, ClassesOfTracksBecomeTheNearestOfFixedLists) {
    LabelFile labels;
    labels.image_size = cv::Size(640, 480);
    for (const char* word : {"vehicle", "two_wheeler", "person", ""}) {
        LabelBox box;
        box.id = static_cast<int>(labels.boxes[0].size()) + 1;
        box.box = {{100.0 * *box.id, 100}, 20, 10, 0};
        box.object_class = word;
        labels.boxes[0].push_back(box);
    }
    const auto readBack = [&](const char* name, const char* format) {
        writeLabels(labels, folder_ / name, format, exportOptions());
        std::map<int, std::string> classes;
        const LabelFile read = readLabels(folder_ / name, format);
        for (const LabelBox& box : read.boxes.at(0)) classes[*box.id] = box.object_class;
        return std::vector<std::string>{classes[1], classes[2], classes[3], classes[4]};
    };
    using Words = std::vector<std::string>;
    EXPECT_EQ(readBack("gt.txt", "mot"), (Words{"vehicle", "motorcycle", "person", ""}));
    EXPECT_EQ(readBack("v.txt", "visdrone"), (Words{"car", "motorcycle", "person", "other"}));
    EXPECT_EQ(readBack("o.txt", "virat"), (Words{"vehicle", "bicycle", "person", ""}));
    EXPECT_EQ(readBack("r.csv", "native-result"), (Words{"vehicle", "two_wheeler", "person", ""}));
}

TEST_F(RoundTripLosses, ClippingIsByOptionAndCounted) {
    LabelFile labels = sampleLabels(false);
    labels.boxes[0][0].box.centre = {2, 60};  // sticks out by 7.75 px on the left
    const ExportReport kept = writeLabels(labels, folder_ / "a.txt", "mot");
    EXPECT_EQ(kept.lost(LossKind::clipped), 0);
    ExportOptions clip;
    clip.clip = true;
    const ExportReport cut = writeLabels(labels, folder_ / "b.txt", "mot", clip);
    EXPECT_EQ(cut.lost(LossKind::clipped), 1);
    const OrientedBox box = readLabels(folder_ / "b.txt").boxes.at(0)[0].box;
    EXPECT_NEAR(box.centre.x - box.length / 2, -0.5, 2e-3);
    EXPECT_NEAR(box.centre.x + box.length / 2, 2 + 20.5 / 2, 2e-3);
    // YOLO must have corners inside the image or trainers drop the whole image.
    EXPECT_EQ(writeLabels(labels, folder_ / "yolo", "yolo-obb").lost(LossKind::clipped), 1);
    ExportOptions keep;
    keep.clip = false;
    EXPECT_EQ(writeLabels(labels, folder_ / "yolo_kept", "yolo-obb", keep).lost(LossKind::clipped), 0);
}

TEST_F(RoundTripLosses, BoxesWithoutIdAreNumberedWhereAFormatNeedsIds) {
    LabelFile labels = sampleLabels(false);
    labels.boxes[2][0].id.reset();
    const ExportReport report = writeLabels(labels, folder_ / "v.kw18", "kw18");
    EXPECT_EQ(report.lost(LossKind::id), 1);
    EXPECT_EQ(reportOn(readLabels(folder_ / "v.kw18")).highest_id, 13);
}

TEST_F(RoundTripLosses, FoldersOfLabelsAreNeverMixed) {
    writeLabels(sampleLabels(), folder_ / "dota", "dota");
    EXPECT_THAT(test::messageOf([&] { writeLabels(sampleLabels(), folder_ / "dota", "dota"); }),
                HasSubstr("would mix"));
    EXPECT_THAT(test::messageOf([&] { writeLabels(sampleLabels(), folder_ / "absent" / "x.csv", "native"); }),
                HasSubstr("x.csv"));
    EXPECT_THAT(test::messageOf([&] { writeLabels(sampleLabels(), folder_ / "x", "jpeg"); }),
                HasSubstr("cannot be written"));
}

TEST_F(RoundTripLosses, ImportMapsShiftsAndScales) {
    writeLabels(sampleLabels(), folder_ / "n.csv", "native");
    ImportOptions options;
    options.class_map = {{"van", "truck"}, {"tank", "other"}};
    options.frame_shift = 5;
    options.scale = 2;
    const LabelFile labels = readLabels(folder_ / "n.csv", "auto", options);
    const LabelBox& car = labels.boxes.at(5)[0];
    // the first pixel's corner stays: (40.25 + 0.5)·2 − 0.5
    EXPECT_NEAR(car.box.centre.x, 81, 1e-3);
    EXPECT_NEAR(car.box.length, 41, 1e-3);
    EXPECT_EQ(car.frame, 5);
    EXPECT_EQ(labels.boxes.at(5)[1].object_class, "truck");
    EXPECT_THAT(labels.notes, Contains(HasSubstr("\"tank\"")));
    options.frame_shift = -1;
    EXPECT_THAT(test::messageOf([&] { readLabels(folder_ / "n.csv", "auto", options); }),
                HasSubstr("moves frame 0 out of the video"));
    options.frame_shift = 0;
    options.scale = 0;
    EXPECT_THAT(test::messageOf([&] { readLabels(folder_ / "n.csv", "auto", options); }), HasSubstr("scale"));
}

TEST_F(RoundTripLosses, ReportTellsWhatIsThere) {
    writeLabels(sampleLabels(), folder_ / "c.xml", "cvat");
    const LabelReport report = reportOn(readLabels(folder_ / "c.xml"));
    EXPECT_EQ(report.boxes, 32);
    EXPECT_EQ(report.frames, 12);
    EXPECT_EQ(report.first_frame, 0);
    EXPECT_EQ(report.last_frame, 11);
    EXPECT_EQ(report.ids, 3);
    EXPECT_EQ(report.lowest_id, 3);
    EXPECT_EQ(report.highest_id, 12);
    EXPECT_EQ(report.frame_count, 14);
    EXPECT_EQ(report.image_size, cv::Size(320, 240));
    EXPECT_EQ(report.boxes_of_class.at("truck"), 12);
    EXPECT_EQ(report.ignored, 6);
    EXPECT_EQ(report.occluded, 3);
    EXPECT_GT(report.keyframes, 0);
}

TEST_F(RoundTripLosses, ObjectsOfDenseBoxesGoOutsideOverGaps) {
    const ImportedLabels imported = annotationsOf(sampleLabels());
    ASSERT_EQ(imported.annotations.objects.size(), 3u);
    const LabelledObject& van = imported.annotations.objects.at(7);
    ASSERT_EQ(van.keyframes.size(), 9u);  // 8 boxes and the gap
    EXPECT_TRUE(van.keyframes[4].outside);
    EXPECT_EQ(van.keyframes[4].frame, 4);
    EXPECT_FALSE(van.keyframes[5].outside);
    EXPECT_EQ(van.last_frame, 11);
    EXPECT_TRUE(van.keyframes[0].heading_set);
    EXPECT_EQ(van.origin, ObjectOrigin::imported);
    EXPECT_TRUE(imported.annotations.classes.empty());
    EXPECT_EQ(imported.left_out, 0);
}

TEST_F(RoundTripLosses, IgnoredAreasBecomeRegions) {
    LabelFile labels;
    for (int frame = 0; frame < 6; ++frame) {
        LabelBox area;
        area.frame = frame;
        area.ignore = true;
        area.box = {{frame < 4 ? 20.0 : 30.0, 20}, 10, 10, 0};
        labels.boxes[frame].push_back(area);
        LabelBox detection = area;
        detection.ignore = false;
        labels.boxes[frame].push_back(detection);
    }
    const ImportedLabels imported = annotationsOf(labels);
    ASSERT_EQ(imported.annotations.regions.size(), 2u);
    EXPECT_EQ(imported.annotations.regions.at(1).last_frame, 3);
    EXPECT_EQ(imported.annotations.regions.at(2).first_frame, 4);
    EXPECT_EQ(imported.left_out, 6);
}

TEST_F(RoundTripLosses, AShiftInTimeIsFoundAgainstTracks) {
    const BoxesByFrame tracks = plainBoxes(sampleLabels().boxes);
    BoxesByFrame late;
    for (const auto& [frame, records] : tracks) late[frame + 2] = records;
    const auto guess = guessFrameOffset(late, tracks);
    ASSERT_TRUE(guess);
    EXPECT_EQ(guess->shift, -2);
    EXPECT_NEAR(guess->overlap, 1, 1e-6);
    EXPECT_LT(guess->overlap_as_is, 0.9);
    EXPECT_EQ(guessFrameOffset(tracks, tracks)->shift, 0);
    EXPECT_FALSE(guessFrameOffset({}, tracks));
    EXPECT_FALSE(guessFrameOffset(tracks, {}));
}

TEST_F(RoundTripLosses, RealUavdtIsReadWithClassesAndIgnoredAreas) {
    EYRIE_NEED_SHARED_DATA("uavdt_m1303");
    const auto path = test::sharedData("uavdt_m1303") / "gt" / "M1303_gt.txt";
    const LabelFile labels = readLabels(path);
    EXPECT_EQ(labels.format, "uavdt");
    EXPECT_EQ(labels.further_files.size(), 2u);
    const LabelReport report = reportOn(labels);
    EXPECT_EQ(report.first_frame, 0);
    EXPECT_GT(report.boxes_of_class.at("car"), 1000);
    EXPECT_GT(report.ignored, 100);
    EXPECT_EQ(labels.boxes.at(0)[0].box.centre, cv::Point2d(251, 274.5));
}

TEST(Export, TheHighestIdLeavesNumbersForBoxesWithoutOne) {
    const test::TemporaryFolder folder;
    LabelFile labels;
    for (const std::optional<int> id : std::vector<std::optional<int>>{2147483647, std::nullopt, 1, std::nullopt}) {
        LabelBox box;
        box.id = id;
        box.box = {{20.0 + 30 * static_cast<double>(labels.boxes[0].size()), 20}, 20, 10, 0};
        labels.boxes[0].push_back(box);
    }
    writeLabels(labels, folder / "x.txt", "mot");
    std::set<int> ids;
    const LabelFile read = readLabels(folder / "x.txt", "mot");
    for (const LabelBox& box : read.boxes.at(0)) ids.insert(box.id.value());
    EXPECT_EQ(ids, (std::set<int>{1, 2, 3, 2147483647}));
}

TEST(Export, NamesThatAreNotUtf8GiveWholeFiles) {
    const test::TemporaryFolder folder;
    ExportOptions options;
    options.sequence = "clip\xFF";
    for (const LabelFormatInfo& info : labelFormats()) {
        if (!info.writes || !info.reads || info.name == "columns") continue;
        const auto target = folder / info.name;
        writeLabels(test::sampleLabels(), target, info.name, options);
        EXPECT_NO_THROW(readLabels(target.filename() == "uavdt" ? folder / "uavdt_gt.txt" : target, info.name))
            << info.name;
    }
}

TEST(Export, EveryFileThatIsWrittenIsToldBefore) {
    for (const LabelFormatInfo& info : labelFormats()) {
        if (!info.writes || !info.reads || info.name == "columns") continue;
        const test::TemporaryFolder folder;
        const auto target = folder / "target";
        const auto told = filesToWrite(target, info.name);
        writeLabels(test::sampleLabels(), target, info.name);
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
            if (!entry.is_regular_file() ||
                (info.folder && entry.path().parent_path().filename() != "target" && info.name != "trackeval"))
                continue;
            const bool named = std::any_of(told.begin(), told.end(),
                                           [&](const ExportFile& file) { return file.path == entry.path(); });
            EXPECT_TRUE(named) << info.name << " wrote " << entry.path();
        }
    }
}

}  // namespace
}  // namespace eyrie::round_trip_test
