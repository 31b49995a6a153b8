#include <opencv2/imgproc.hpp>
#include <set>

#include "imaging/contours/boundary_cues.h"
#include "imaging/contours/contour_hierarchy.h"
#include "imaging/contours/spectral_contours.h"

namespace eyrie::contours_test {
namespace {

constexpr int kUpright = kContourDirections / 2;  // direction of a vertical line

int countOf(const cv::Mat& labels) {
    return static_cast<int>(std::set<int>(labels.begin<int>(), labels.end<int>()).size());
}

cv::Mat brightRightHalf(int side, uchar dark = 40, uchar bright = 200) {
    cv::Mat gray(side, side, CV_8UC1, cv::Scalar(dark));
    gray.colRange(side / 2, side) = cv::Scalar(bright);
    return gray;
}

DirectedPictures none(cv::Size size) {
    DirectedPictures pictures;
    for (cv::Mat& picture : pictures) picture = cv::Mat::zeros(size, CV_32F);
    return pictures;
}

TEST(Contours, HalvesOfADiscDifferAcrossAnEdgeAndAgreeAlongIt) {
    const cv::Mat values = brightRightHalf(41, 1, 9);
    const cv::Mat along = halfDiscDifference(values, 10, 0, 5, kUpright);
    const cv::Mat across = halfDiscDifference(values, 10, 0, 5, 0);
    EXPECT_GT(along.at<float>(20, 20), 0.7F);
    EXPECT_LE(along.at<float>(20, 20), 1.05F);
    EXPECT_NEAR(across.at<float>(20, 20), 0, 0.02);
    EXPECT_NEAR(along.at<float>(20, 8), 0, 1e-5);
    // The peak lies on the edge.
    cv::Point peak;
    cv::minMaxLoc(along.row(20), nullptr, nullptr, nullptr, &peak);
    EXPECT_NEAR(peak.x, 20, 1);
}

TEST(Contours, ADiagonalEdgeHasADiagonalDirection) {
    cv::Mat gray(41, 41, CV_8UC1);
    for (int y = 0; y < 41; ++y) {
        for (int x = 0; x < 41; ++x) gray.at<uchar>(y, x) = x > y ? 200 : 40;  // the edge runs down to the right: 45°
    }
    const DirectedPictures cues = boundaryCues(gray);
    for (int k = 0; k < kContourDirections; ++k) {
        if (k == kContourDirections / 4) continue;
        EXPECT_LT(cues[static_cast<std::size_t>(k)].at<float>(20, 20), cues[kContourDirections / 4].at<float>(20, 20))
            << k;
    }
}

TEST(Contours, TexturesPartWhatBrightnessDoesNot) {
    cv::Mat gray(48, 48, CV_8UC1);
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 48; ++x) gray.at<uchar>(y, x) = ((x < 24 ? x : y) / 3) % 2 == 0 ? 60 : 180;
    }
    const cv::Mat difference = halfDiscDifference(textures(gray, 8), 8, 0, 10, kUpright);
    EXPECT_GT(difference.at<float>(24, 24), 2 * difference.at<float>(24, 10));
    EXPECT_EQ(cv::norm(textures(gray, 8), textures(gray, 8), cv::NORM_INF), 0);
}

TEST(Contours, TheSlowestVibrationPartsThePictureAtItsContour) {
    cv::Mat contours = cv::Mat::zeros(20, 30, CV_32F);
    contours.col(12) = 0.9;
    const std::vector<Vibration> vibrations = slowestVibrations(contours, 4);
    ASSERT_EQ(vibrations.size(), 4U);
    const cv::Mat& first = vibrations[0].picture;
    EXPECT_LT(first.at<float>(3, 5) * first.at<float>(3, 20), 0);
    EXPECT_GT(first.at<float>(3, 5) * first.at<float>(17, 5), 0);
    EXPECT_NEAR(first.at<float>(3, 5), first.at<float>(17, 9), 0.1 * std::abs(first.at<float>(3, 5)));
    EXPECT_NEAR(cv::norm(first), 1, 1e-5);
    EXPECT_GT(vibrations[0].eigenvalue, 0);
    EXPECT_LT(vibrations[0].eigenvalue, 0.1 * vibrations[1].eigenvalue);
    for (std::size_t i = 1; i < vibrations.size(); ++i)
        EXPECT_GE(vibrations[i].eigenvalue, vibrations[i - 1].eigenvalue);
}

TEST(Contours, ACrossedContourDoesNotStrengthenTheArcThatMeetsIt) {
    // A strong upright line and a weak level one in every pixel of their own direction alone.
    DirectedPictures contours = none({21, 21});
    contours[kUpright].col(10) = 1;
    contours[0].row(10) = 0.2;
    const ContourHierarchy hierarchy(contours);
    EXPECT_EQ(countOf(hierarchy.segmentsAt(0.1)), 4);
    const cv::Mat halves = hierarchy.segmentsAt(0.5);
    EXPECT_EQ(countOf(halves), 2);
    EXPECT_EQ(halves.at<int>(2, 2), halves.at<int>(18, 2));
    EXPECT_NE(halves.at<int>(2, 2), halves.at<int>(2, 18));
    EXPECT_EQ(countOf(hierarchy.segmentsAt(2)), 1);
}

TEST(Contours, SegmentsOfAHigherLevelAreUnionsOfThoseBelow) {
    cv::Mat gray(48, 64, CV_8UC1, cv::Scalar(90));
    cv::rectangle(gray, {10, 10, 24, 12}, 190, cv::FILLED);
    cv::rectangle(gray, {16, 12, 6, 8}, 150, cv::FILLED);
    cv::rectangle(gray, {44, 20, 10, 20}, 30, cv::FILLED);
    const ContourHierarchy hierarchy(probabilityOfBoundary(gray));
    const cv::Mat map = hierarchy.contourMap();
    cv::Mat below = hierarchy.segmentsAt(0);
    for (const double level : {0.02, 0.05, 0.1, 0.2, 0.3}) {
        const cv::Mat segments = hierarchy.segmentsAt(level);
        std::map<int, int> within;
        for (int y = 0; y < gray.rows; ++y) {
            for (int x = 0; x < gray.cols; ++x) {
                const int own = segments.at<int>(y, x);
                EXPECT_EQ(within.try_emplace(below.at<int>(y, x), own).first->second, own);
                const bool border = (x + 1 < gray.cols && segments.at<int>(y, x + 1) != own) ||
                                    (y + 1 < gray.rows && segments.at<int>(y + 1, x) != own);
                EXPECT_EQ(border, map.at<float>(y, x) > static_cast<float>(level)) << x << ' ' << y << ' ' << level;
            }
        }
        below = segments;
    }
    // At a middling level the two blocks are segments of their own on one ground.
    const cv::Mat segments = hierarchy.segmentsAt(0.35);
    EXPECT_EQ(countOf(segments), 3);
    EXPECT_NE(segments.at<int>(13, 30), segments.at<int>(5, 30));
    EXPECT_NE(segments.at<int>(30, 49), segments.at<int>(5, 30));
    EXPECT_EQ(segments.at<int>(44, 4), segments.at<int>(4, 60));
}

TEST(Contours, PlainAndTinyPicturesAreOneSegment) {
    EXPECT_EQ(countOf(ContourHierarchy(probabilityOfBoundary(cv::Mat(30, 20, CV_8UC1, cv::Scalar(7)))).segmentsAt(0)),
              1);
    for (const cv::Size size : {cv::Size(1, 1), cv::Size(2, 1), cv::Size(3, 40)}) {
        const ContourHierarchy hierarchy(probabilityOfBoundary(cv::Mat(size, CV_8UC1, cv::Scalar(7))));
        EXPECT_EQ(hierarchy.segmentsAt(0).size(), size);
        EXPECT_EQ(hierarchy.contourMap().size(), size);
    }
}

TEST(Contours, WhereNothingVibratesTheLocalCuesAreLeft) {
    // Two pixels have no slow vibrations.
    cv::Mat gray(1, 2, CV_8UC1, cv::Scalar(0));
    gray.at<uchar>(0, 1) = 255;
    const DirectedPictures local = boundaryCues(gray);
    const DirectedPictures both = probabilityOfBoundary(gray);
    double strongest = 0;
    for (std::size_t k = 0; k < both.size(); ++k) {
        EXPECT_LT(cv::norm(both[k], local[k] * 0.5, cv::NORM_INF), 0.01) << k << ": faint ones are no contours";
        strongest = std::max(strongest, cv::norm(both[k], cv::NORM_INF));
    }
    EXPECT_GT(strongest, 0.05);
}

}  // namespace
}  // namespace eyrie::contours_test
