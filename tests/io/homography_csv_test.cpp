#include "io/tables/homography_csv.h"

#include <gmock/gmock.h>

#include "io/numbered_video.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

namespace eyrie::homography_csv_test {
namespace {

using testing::HasSubstr;

class HomographyCsv : public testing::Test {
 protected:
    std::vector<Homography> read(const std::string& rows) {
        test::writeBytes(folder_ / "h.csv", "frame,h00,h01,h02,h10,h11,h12,h20,h21,h22\n" + rows);
        return readHomographyCsv(folder_ / "h.csv");
    }
    std::string refusal(const std::string& rows) {
        return test::messageOf(ErrorKind::input, [&] { read(rows); });
    }
    test::TemporaryFolder folder_;
};

TEST_F(HomographyCsv, SurvivesTheRoundTripExactly) {
    Homography homography;
    homography.from_frame = 5;
    homography.matrix = {1.0 / 3, 1e-17, -123.456789012345, 2, 0.1, 7, 1e-6, -2e-9, 1};
    writeHomographyCsv(folder_ / "h.csv", {homography});
    const auto back = readHomographyCsv(folder_ / "h.csv");
    ASSERT_EQ(back.size(), 1U);
    EXPECT_EQ(back[0].matrix, homography.matrix);
    EXPECT_EQ(back[0].from_frame, 5);
    EXPECT_EQ(back[0].to_frame, 0);
}

TEST_F(HomographyCsv, IsSortedAndNormalised) {
    const auto homographies = read("3,2,0,4,0,2,6,0,0,2\n1,1,0,0,0,1,0,0,0,1\n");
    ASSERT_EQ(homographies.size(), 2U);
    EXPECT_EQ(homographies[0].from_frame, 1);
    EXPECT_EQ(homographies[1].matrix, cv::Matx33d(1, 0, 2, 0, 1, 3, 0, 0, 1));
}

TEST_F(HomographyCsv, RefusesWhatIsNoMap) {
    EXPECT_THAT(refusal("0,1,0,0,0,1,x,0,0,1\n"), HasSubstr("h.csv:2: column h12 = x"));
    EXPECT_THAT(refusal("0,1,0,0,0,1,0,0,0,0\n"), HasSubstr("column h22 = 0"));
    EXPECT_THAT(refusal("0,0,0,0,0,0,0,0,0,1\n"), HasSubstr("inverted"));
    EXPECT_THAT(refusal("-1,1,0,0,0,1,0,0,0,1\n"), HasSubstr("column frame = -1"));
    EXPECT_THAT(refusal("0,1,0,0,0,1,0,0,0,1\n0,1,0,0,0,1,0,0,0,1\n"), HasSubstr("h.csv:3: column frame = 0"));
    EXPECT_THAT(refusal("0,1,0,0,0,1,0,0,0\n"), HasSubstr("9 fields"));
}

TEST(RealHomographyCsv, IsRead) {
    EYRIE_NEED_SHARED_DATA("collage_day");
    const auto homographies = readHomographyCsv(test::sharedData("collage_day/homography.csv"));
    ASSERT_EQ(homographies.size(), 250U);
    EXPECT_NEAR(homographies[1].matrix(0, 2), -0.5036807, 1e-6);
}

}  // namespace
}  // namespace eyrie::homography_csv_test
