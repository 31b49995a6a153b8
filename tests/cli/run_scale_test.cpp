#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "cli/loaded_program.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

/// Where the scale of a run comes from, as `run` and `info` tell it.
namespace eyrie::run_scale_test {
namespace {

using testing::HasSubstr;

class RunScale : public testing::Test {
 protected:
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    static test::ProcessResult call(const std::vector<std::string>& arguments) { return test::runLoaded(arguments); }
    nlohmann::json runOf(const std::string& project) const {
        return nlohmann::json::parse(call({"info", at(project), "--json"}).output)["runs"][0];
    }
    /// Pictures without anything on them.
    std::string blank() const {
        std::filesystem::create_directories(folder_ / "blank");
        for (int i = 0; i < 6; ++i)
            cv::imwrite(at("blank/" + std::to_string(10 + i) + ".png"), cv::Mat(120, 160, CV_8U, cv::Scalar(i)));
        return at("blank");
    }
    test::TemporaryFolder folder_;
};

}  // namespace

TEST_F(RunScale, anEstimateIsKeptWithHowSureItIs) {
    EYRIE_NEED_SHARED_DATA("collage_day");
    const auto result = call({"run", test::sharedData("collage_day/frames").string(), "--frames", "0:29", "--quiet",
                              "--project", at("p.eyrie")});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("GSD unknown: worked with 0."));
    EXPECT_THAT(result.output, HasSubstr(" vehicles, right to within a factor of 1."));
    const auto run = runOf("p.eyrie");
    EXPECT_EQ(run["scale_origin"], "estimated");
    EXPECT_GT(run["scale_uncertainty"].get<double>(), 1.1);
    EXPECT_LT(run["scale_uncertainty"].get<double>(), 1.3) << "many cars drive there";
    EXPECT_GE(run["scale_vehicles"].get<int>(), 10);
    EXPECT_TRUE(run["gsd_m_per_px"].is_null()) << "a guess is no knowledge";
    EXPECT_FALSE(run["scale_is_fallback"].get<bool>());
    EXPECT_THAT(call({"info", at("p.eyrie")}).output, HasSubstr("scale unknown, worked with 0."));
}

TEST_F(RunScale, withoutTrafficItIsAssumedAndSaysSo) {
    const auto result = call({"run", blank(), "--quiet", "--project", at("p.eyrie")});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("the traffic shows none: worked with 0.25 m/px, assumed, may be far off"));
    const auto run = runOf("p.eyrie");
    EXPECT_EQ(run["scale_origin"], "assumed");
    EXPECT_TRUE(run["scale_uncertainty"].is_null());
    EXPECT_TRUE(run["scale_is_fallback"].get<bool>());
}

TEST_F(RunScale, aGivenOneIsGivenEvenIfItIsWhatWouldBeAssumed) {
    const auto result = call({"run", blank(), "--gsd", "0.25", "--quiet", "--project", at("p.eyrie")});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("0.25 m/px, as given"));
    EXPECT_EQ(runOf("p.eyrie")["scale_origin"], "given");
    EXPECT_THAT(call({"info", at("p.eyrie")}).output, HasSubstr("preset default, 0.25 m/px, as given"));
}

}  // namespace eyrie::run_scale_test
