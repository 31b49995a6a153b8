#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/loaded_program.h"
#include "support/klv_writer.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

namespace eyrie::metadata_command_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class MetadataCommand : public testing::Test {
 protected:
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    std::string textOf(const std::string& name) const {
        std::stringstream text;
        text << std::ifstream(folder_ / name).rdbuf();
        return text.str();
    }
    static std::string shared(const std::string& name) { return (test::sharedData("klv") / name).string(); }
    test::ProcessResult call(const std::vector<std::string>& arguments) const { return test::runLoaded(arguments); }
    test::TemporaryFolder folder_;
};

}  // namespace

TEST_F(MetadataCommand, tellsWhatARawFileHoldsAndWhatIsDamaged) {
    test::KlvBytes klv;
    for (unsigned i = 0; i < 3; ++i) {
        test::KlvBytes set = test::LocalSetWriter().time(1'000'000U * i).item(3, {'m'}).angle(13, 50 + i, 90).bytes();
        if (i == 1) set[30] ^= 1;
        test::append(klv, set);
    }
    std::ofstream(at("sets.klv"), std::ios::binary) << std::string(klv.begin(), klv.end());
    const auto result = call({"metadata", at("sets.klv"), "--csv", at("sets.csv"), "--json", at("sets.json")});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, AllOf(HasSubstr("2 sets"), HasSubstr("checksum differs 1×"), HasSubstr("mission"),
                                     HasSubstr("50 … 52 deg"), HasSubstr("1970-01-01T00:00:02")));
    EXPECT_THAT(textOf("sets.csv"), HasSubstr("sensor_latitude_deg"));
    const auto facts = nlohmann::json::parse(textOf("sets.json"));
    EXPECT_EQ(facts["streams"][0]["damaged"], 1);
    EXPECT_EQ(facts["streams"][0]["packets"], 2);
    EXPECT_EQ(call({"metadata", at("sets.klv"), "--frame", "1"}).exit_code, 2);
    EXPECT_EQ(call({"metadata", at("sets.klv"), "--stream", "4"}).exit_code, 2);
    EXPECT_EQ(call({"metadata", at("absent.ts")}).exit_code, 3);
}

TEST_F(MetadataCommand, tellsScaleNorthAndFootprintOfAFrame) {
    EYRIE_NEED_SHARED_DATA("klv");
    const auto result = call({"metadata", shared("aphill_short.ts"), "--frame", "20", "--json", at("f.json")});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output,
                AllOf(HasSubstr("Frame 20"), HasSubstr("from the frame corners"), HasSubstr("upper left")));
    const auto frame = nlohmann::json::parse(textOf("f.json"))["frame"]["ground"];
    EXPECT_NEAR(frame["gsd_x_m_per_px"].get<double>(), 0.0335, 0.002);
    EXPECT_EQ(frame["footprint"].size(), 4U);
    const auto none = call({"metadata", shared("h264_no_klv.ts")});
    EXPECT_EQ(none.exit_code, 0);
    EXPECT_THAT(none.output, HasSubstr("No metadata"));
}

TEST_F(MetadataCommand, aComparisonTakesItsScaleFromThemAsARunDoes) {
    EYRIE_NEED_SHARED_DATA("klv");
    std::ofstream(at("truth.csv")) << "frame,id,x,y,length,width,heading,class,ignore\n0,1,50,50,20,10,0,car,0\n";
    const auto compared = call({"compare", "--sequence", shared("aphill_short.ts"), "--frames", "0:5", "--methods",
                                "clusters", "--ground-truth", at("truth.csv"), "--project", at("p.eyrie")});
    EXPECT_EQ(compared.exit_code, 0) << compared.errors;
    EXPECT_THAT(compared.output + compared.errors, HasSubstr("from the video's metadata (the frame corners)"));
    const auto told = nlohmann::json::parse(call({"info", at("p.eyrie"), "--json"}).output);
    EXPECT_EQ(told["runs"][0]["scale_origin"], "metadata");
}

TEST_F(MetadataCommand, aRunTakesItsScaleFromThemUnlessOneIsGiven) {
    EYRIE_NEED_SHARED_DATA("klv");
    const auto run = call({"run", shared("aphill_short.ts"), "--frames", "0:5", "--project", at("p.eyrie")});
    EXPECT_EQ(run.exit_code, 0) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr("from the video's metadata (the frame corners)"));
    EXPECT_THAT(run.output, Not(HasSubstr("GSD unknown")));
    const auto given =
        call({"run", shared("aphill_short.ts"), "--frames", "0:5", "--gsd", "0.05", "--project", at("q.eyrie")});
    EXPECT_EQ(given.exit_code, 0) << given.errors;
    EXPECT_THAT(given.errors, Not(HasSubstr("metadata")));
    EXPECT_THAT(given.output, HasSubstr("0.05 m/px, as given"));
    EXPECT_THAT(run.output, HasSubstr("m/px, from the video's metadata"));
    const auto origin = [&](const std::string& project) {
        return nlohmann::json::parse(call({"info", at(project), "--json"}).output)["runs"][0]["scale_origin"];
    };
    EXPECT_EQ(origin("p.eyrie"), "metadata");
    EXPECT_EQ(origin("q.eyrie"), "given");
    const auto report =
        call({"report", "--project", at("p.eyrie"), "--events", "--verdict", "all", "--out", at("e.html")});
    EXPECT_EQ(report.exit_code, 0) << report.errors;
    EXPECT_THAT(textOf("e.html"), HasSubstr("m/px, from the video's metadata</td>"));
    const auto other =
        call({"report", "--project", at("q.eyrie"), "--events", "--verdict", "all", "--out", at("f.html")});
    EXPECT_EQ(other.exit_code, 0) << other.errors;
    EXPECT_THAT(textOf("f.html"), HasSubstr("0.05 m/px, as given; the video's metadata (the frame corners) say 0.04"));
}

}  // namespace eyrie::metadata_command_test
