#include "learning/training/sample_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "learning/drawn_windows.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

namespace eyrie::sample_set_test {
namespace {

using testing::HasSubstr;

const std::string header = "kind,index,row,column,file,group,duplicate\n";

class PatchSheets : public testing::Test {
 protected:
    PatchSheets() {
        cv::Mat vehicles(16, 64, CV_8UC1, cv::Scalar(50));
        vehicles.at<uchar>(3, 32 + 30) = 200;  // second cell: near its right end, above the middle
        cv::imwrite((folder / "pos.png").string(), vehicles);
        cv::imwrite((folder / "neg.png").string(), cv::Mat(32, 32, CV_8UC1, cv::Scalar(90)));
    }
    void table(const std::string& text) const { std::ofstream(folder / "patches.csv") << text; }
    std::string messageOf() const {
        try {
            readPatchSheets(folder.path());
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            return error.what();
        }
        return "";
    }
    const test::TemporaryFolder folder;
};

double overlapWithAll(const cv::Mat& window, int tone) {
    return static_cast<double>(cv::countNonZero(window == tone)) / static_cast<double>(window.total());
}

}  // namespace

TEST_F(PatchSheets, areReadAndTurnedUpright) {
    table(header + "pos,0,0,0,a,g1,0\r\npos,1,0,1,a,g1,1\n\nneg,0,1,0,b,g2,0\n");
    const SampleSet samples = readPatchSheets(folder.path());
    ASSERT_EQ(samples.size(), 3U);
    EXPECT_EQ(countOf(samples, true), 2);
    EXPECT_TRUE(samples[1].duplicate);
    EXPECT_EQ(samples[1].group, "g1");
    EXPECT_EQ(samples[0].source, folder.path().filename().string());
    EXPECT_EQ(samples[1].window.size(), cv::Size(16, 32));
    EXPECT_EQ(samples[1].window.at<uchar>(1, 3), 200) << "right becomes up";
    EXPECT_EQ(samples[2].window.at<uchar>(0, 0), 90);
    EXPECT_EQ(readPatchSheets(folder.path() / "").front().source, samples[0].source);
}

TEST_F(PatchSheets, areCutSoThatAVehicleFillsItsWindow) {
    cv::Mat vehicles(16, 96, CV_8UC1, cv::Scalar(50));
    vehicles(cv::Rect(4, 4, 24, 8)).setTo(200);        // a vehicle of 24×8 px in the middle of the first cell
    vehicles(cv::Rect(32 + 8, 2, 16, 12)).setTo(200);  // a shorter, wider one in the second
    cv::imwrite((folder / "pos.png").string(), vehicles);
    cv::Mat other(16, 32, CV_8UC1, cv::Scalar(90));
    other(cv::Rect(5, 2, 22, 12)).setTo(120);  // a little more than a median car takes
    cv::imwrite((folder / "neg.png").string(), other);
    const std::string rows =
        "pos,0,0,0,a,g1,0,24,8\npos,1,0,1,a,g2,1,16.0,12\npos,2,0,2,a,g3,0,36,9\nneg,0,0,0,b,g4,0,,\n";
    table("kind,index,row,column,file,group,duplicate,length_px,width_px\n" + rows);

    const SampleSet filled = readPatchSheets(folder.path(), WindowFit::filled());
    ASSERT_EQ(filled.size(), 3U) << "the third is longer than its cell";
    const cv::Rect inside(1, 2, 14, 28);  // off the box's own edge, which lies between two pixels
    for (const int vehicle : {0, 1}) {
        const Sample& sample = filled[static_cast<std::size_t>(vehicle)];
        EXPECT_EQ(sample.window.size(), cv::Size(16, 32));
        EXPECT_TRUE(sample.vehicle);
        EXPECT_EQ(overlapWithAll(sample.window(inside), 200), 1) << vehicle;
        EXPECT_GT(cv::mean(sample.window)[0], 185) << vehicle;
    }
    EXPECT_EQ(filled[0].group, "g1");
    EXPECT_TRUE(filled[1].duplicate);
    EXPECT_FALSE(filled[2].vehicle);
    EXPECT_EQ(overlapWithAll(filled[2].window, 120), 1) << "others as a median car: 21.5 × 10 px";

    const SampleSet whole = readPatchSheets(folder.path());
    ASSERT_EQ(whole.size(), 4U);
    EXPECT_EQ(whole[0].window.at<uchar>(1, 8), 50) << "with the ground around it";
}

TEST_F(PatchSheets, withoutSizesAreTakenAsCutAlready) {
    table(header + "pos,0,0,1,a,g1,1\n");
    const SampleSet samples = readPatchSheets(folder.path(), WindowFit::filled());
    EXPECT_EQ(samples.at(0).window.at<uchar>(1, 3), 200);
}

TEST_F(PatchSheets, withWrongSizesAreRefusedWhereTheyAreNeeded) {
    const std::string sized = "kind,index,row,column,file,group,duplicate,length_px,width_px\n";
    for (const char* size : {"", "x", "0", "-3", "nan", "inf", "1e6", "20px"}) {
        table(sized + "pos,0,0,0,a,g,0," + size + ",9\n");
        EXPECT_EQ(readPatchSheets(folder.path()).size(), 1U);
        try {
            readPatchSheets(folder.path(), WindowFit::filled());
            ADD_FAILURE() << size;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            EXPECT_THAT(error.what(), HasSubstr("line 2: length_px is \"" + std::string(size) + "\", not a size"));
        }
    }
}

TEST_F(PatchSheets, thatAreDamagedAreRefusedNamingThePlace) {
    EXPECT_THAT(messageOf(), HasSubstr("patches.csv"));
    table("");
    EXPECT_THAT(messageOf(), HasSubstr("empty"));
    table("kind,row,column,duplicate\npos,0,0,0\n");
    EXPECT_THAT(messageOf(), HasSubstr("\"group\" is missing"));
    table(header);
    EXPECT_THAT(messageOf(), HasSubstr("no sample"));
    table(header + "pos,0,0,0,a,g\n");
    EXPECT_THAT(messageOf(), HasSubstr("line 2: 6 fields"));
    table(header + "pos,0,0,0,a,g,0\ncar,0,0,0,a,g,0\n");
    EXPECT_THAT(messageOf(), HasSubstr("line 3: kind is \"car\""));
    for (const char* row : {"x", "", "-1", "1", "99999999999999", "0.5"}) {
        table(header + "pos,0," + row + ",0,a,g,0\n");
        EXPECT_THAT(messageOf(), HasSubstr("line 2")) << row;
    }
    table(header + "pos,0,0,2,a,g,0\n");
    EXPECT_THAT(messageOf(), HasSubstr("outside"));
    table(header + "pos,0,0,0,a,g,0\n");
    std::ofstream(folder / "neg.png") << "no image";
    EXPECT_THAT(messageOf(), HasSubstr("neg.png"));
    cv::imwrite((folder / "neg.png").string(), cv::Mat(33, 32, CV_8UC1, cv::Scalar(0)));
    EXPECT_THAT(messageOf(), HasSubstr("is not a sheet"));
    std::filesystem::remove(folder / "pos.png");
    EXPECT_THAT(messageOf(), HasSubstr("pos.png"));
}

TEST(WindowCutting, turnsAndScalesAVehicleToTheSheetsSize) {
    for (const double heading : {0.0, 0.4, 1.9, -2.5}) {
        for (const double size : {0.5, 1.0, 3.7}) {
            cv::Mat image(400, 400, CV_8UC1, cv::Scalar(50));
            OrientedBox box;
            box.centre = {180.3, 201.8};
            box.length = 21.5 * size;
            box.width = 10 * size;
            box.heading = heading;
            for (int y = 0; y < image.rows; ++y) {
                for (int x = 0; x < image.cols; ++x) {
                    const cv::Point2d p = box.toBox({double(x), double(y)});
                    if (!box.contains({double(x), double(y)})) continue;
                    image.at<uchar>(y, x) = p.x > 0 ? 250 : 150;  // the front half is brighter
                }
            }
            const cv::Mat window = cutWindow(image, box);
            ASSERT_EQ(window.size(), cv::Size(16, 32));
            cv::Mat1d expected(32, 16);
            double error = 0;
            for (int y = 0; y < 32; ++y) {
                for (int x = 0; x < 16; ++x) {
                    const bool inside = std::abs(x - 7.5) < 5 && std::abs(y - 15.5) < 10.75;
                    expected(y, x) = inside ? (y < 15.5 ? 250 : 150) : 50;
                    error += std::abs(expected(y, x) - window.at<uchar>(y, x)) / 512;
                }
            }
            EXPECT_LT(error, 14) << "heading " << heading << ", size " << size << ": only edges may differ";
            EXPECT_NEAR(window.at<uchar>(10, 8), 250, 2) << "the front is up";
            EXPECT_NEAR(window.at<uchar>(21, 7), 150, 2);
            EXPECT_NEAR(window.at<uchar>(1, 1), 50, 2);
        }
    }
}

TEST(WindowCutting, repeatsTheImageBorderAndRefusesBoxesWithoutArea) {
    const cv::Mat image(40, 40, CV_8UC1, cv::Scalar(77));
    OrientedBox box{{-3, 2}, 20, 9, 0.3};
    EXPECT_EQ(overlapWithAll(cutWindow(image, box), 77), 1);
    box.width = 0;
    EXPECT_THROW(cutWindow(image, box), Error);
    EXPECT_THROW(cutWindow(image, {{1, 1}, std::nan(""), 3, 0}), Error);
    EXPECT_THROW(cutWindow(image, {{1e9, 1}, 5, 3, 0}), Error);
}

TEST(WindowCutting, takesBackgroundOnlyWhereNoVehicleIs) {
    LabelledImage image;
    image.gray = cv::Mat(200, 300, CV_8UC1, cv::Scalar(60));
    image.vehicles = {{{80, 90}, 20, 9, 0}, {{200, 60}, 22, 10, 1.2}, {{-5, 20}, 20, 9, 0}};
    image.unclear = {{{150, 150}, 80, 60, 0}};
    for (const OrientedBox& box : image.vehicles) {
        std::vector<cv::Point> corners;
        for (const cv::Point2d c : box.corners()) corners.emplace_back(cvRound(c.x), cvRound(c.y));
        cv::fillConvexPoly(image.gray, corners, cv::Scalar(220));
    }
    cv::rectangle(image.gray, cv::Rect(112, 122, 76, 56), cv::Scalar(140), cv::FILLED);
    image.source = "drawn";
    image.group = "one";
    const SampleSet samples = samplesFromImage(image, 40, {}, 3);
    EXPECT_EQ(countOf(samples, true), 2) << "the third vehicle is cut by the border";
    EXPECT_EQ(countOf(samples, false), 40);
    int beside = 0;
    for (const Sample& sample : samples) {
        EXPECT_EQ(sample.group, "one");
        // The middle of the window, where the vehicle would be.
        const cv::Mat middle = sample.window(cv::Rect(5, 8, 6, 16));
        const double bright = overlapWithAll(middle, 220);
        if (sample.vehicle) {
            EXPECT_GT(bright, 0.95);
        } else {
            EXPECT_LT(bright, 0.6);
            EXPECT_LT(overlapWithAll(middle, 140), 0.2) << "unclear areas are avoided";
            beside += overlapWithAll(sample.window, 220) > 0.05 ? 1 : 0;
        }
    }
    EXPECT_GE(beside, 5) << "some lie beside a vehicle";
    const SampleSet again = samplesFromImage(image, 40, {}, 3);
    EXPECT_EQ(cv::norm(again.back().window, samples.back().window, cv::NORM_INF), 0);
}

TEST(WindowCutting, endsWhereAnImageIsFullOfVehicles) {
    LabelledImage image;
    image.gray = cv::Mat(60, 60, CV_8UC1, cv::Scalar(60));
    image.vehicles = {{{30, 30}, 60, 60, 0}};
    EXPECT_LT(countOf(samplesFromImage(image, 10, {}, 1), false), 10);
}

TEST(SampleSet, realSheetsHaveTheirDocumentedSizes) {
    EYRIE_NEED_SHARED_DATA("patches");
    const SampleSet kit = readPatchSheets(test::sharedData("patches/kit_ais"));
    EXPECT_EQ(countOf(kit, true), 2462);
    EXPECT_EQ(countOf(kit, false), 2600);
    EXPECT_EQ(readPatchSheets(test::sharedData("patches/kit_ais"), WindowFit::filled()).size(), kit.size())
        << "every vehicle lies in its cell";
    const SampleSet minsk = readPatchSheets(test::sharedData("patches/minsk_dji"));
    EXPECT_EQ(countOf(minsk, true), 780);
    EXPECT_EQ(countOf(minsk, false), 5200);
}

}  // namespace eyrie::sample_set_test
