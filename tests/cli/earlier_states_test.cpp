#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/loaded_program.h"
#include "store/backup/project_backup.h"
#include "store/labels/annotation_store.h"
#include "store/project/project_presets.h"

namespace eyrie::earlier_states_test {
namespace {

using testing::HasSubstr;

class EarlierStates : public testing::Test {
 protected:
    void SetUp() override {
        ProjectFile project = ProjectFile::create(at("p.eyrie"));
        ensureSequence(project, {0, "/videos/street.mp4", {768, 576}, 100, 25});
        std::ofstream(at("truth.csv")) << "frame,id,x,y,length,width,heading,class,ignore\n0,1,100,100,20,10,0,car,0\n";
    }
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    static test::ProcessResult cli(const std::vector<std::string>& arguments) { return test::runLoaded(arguments); }
    test::ProcessResult import() const { return cli({"import", at("truth.csv"), "--project", at("p.eyrie")}); }
    nlohmann::json backups() const {
        const auto result = cli({"backups", at("p.eyrie"), "--json"});
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        return nlohmann::json::parse(result.output);
    }
    std::size_t objects(const std::string& name) const {
        ProjectFile project = ProjectFile::open(at(name));
        return readAnnotations(project, 1).objects.size();
    }
    /// Overwrites a part of a file that nobody has open.
    void damage(std::streamoff from, std::size_t bytes) const {
        std::fstream file(at("p.eyrie"), std::ios::binary | std::ios::in | std::ios::out);
        file.seekp(from);
        file << std::string(bytes, '\x5a');
    }
    test::TemporaryFolder folder_;
};

TEST_F(EarlierStates, OneIsKeptBeforeTheFirstCommandOfTheDayWrites) {
    EXPECT_TRUE(backups().empty());
    ASSERT_EQ(import().exit_code, 0);
    ASSERT_EQ(backups().size(), 1U);
    ASSERT_EQ(cli({"import", at("truth.csv"), "--project", at("p.eyrie"), "--add-doubles"}).exit_code, 0);
    EXPECT_EQ(backups().size(), 1U);
    EXPECT_THAT(backups()[0]["differences"].dump(), HasSubstr("2 labelled objects would be gone"));
    EXPECT_THAT(cli({"backups", at("p.eyrie")}).output, HasSubstr("first use that day"));
}

TEST_F(EarlierStates, CanBeRestoredInPlaceAndBack) {
    ASSERT_EQ(import().exit_code, 0);
    const std::string name = backups()[0]["name"];
    const auto result = cli({"restore", at("p.eyrie"), "--backup", name});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(objects("p.eyrie"), 0U);
    const auto kept = backups();
    ASSERT_EQ(kept.size(), 2U);
    EXPECT_THAT(result.output, HasSubstr(kept[0]["name"].get<std::string>()));
    ASSERT_EQ(cli({"restore", at("p.eyrie"), "--backup", kept[0]["name"]}).exit_code, 0);
    EXPECT_EQ(objects("p.eyrie"), 1U);
}

TEST_F(EarlierStates, CanBecomeANewProjectThatReplacesNothing) {
    ASSERT_EQ(import().exit_code, 0);
    const std::string name = backups()[0]["name"];
    ASSERT_EQ(cli({"restore", at("p.eyrie"), "--backup", name, "--out", at("old.eyrie")}).exit_code, 0);
    EXPECT_EQ(objects("old.eyrie"), 0U);
    EXPECT_EQ(objects("p.eyrie"), 1U);
    EXPECT_EQ(cli({"restore", at("p.eyrie"), "--backup", name, "--out", at("truth.csv")}).exit_code, 4);
}

TEST_F(EarlierStates, OfADeletedProjectAreThere) {
    ASSERT_EQ(import().exit_code, 0);
    std::filesystem::remove(at("p.eyrie"));
    const std::string name = backups()[0]["name"];
    ASSERT_EQ(cli({"restore", at("p.eyrie"), "--backup", name}).exit_code, 0);
    EXPECT_EQ(objects("p.eyrie"), 0U);
}

TEST_F(EarlierStates, AreNotRestoredOverAnOpenProject) {
    ASSERT_EQ(import().exit_code, 0);
    ProjectFile open = ProjectFile::open(at("p.eyrie"));
    const auto result = cli({"restore", at("p.eyrie"), "--backup", backups()[0]["name"]});
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_THAT(result.errors, HasSubstr("open in another program"));
    EXPECT_EQ(readAnnotations(open, 1).objects.size(), 1U);
}

TEST_F(EarlierStates, AreNamed) {
    EXPECT_EQ(cli({"restore", at("p.eyrie"), "--backup", "yesterday"}).exit_code, 2);
    ASSERT_EQ(import().exit_code, 0);
    const auto result = cli({"restore", at("p.eyrie"), "--backup", "yesterday"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.errors, HasSubstr(backups()[0]["name"].get<std::string>()));
    EXPECT_EQ(cli({"backups", at("none.eyrie")}).exit_code, 5);
}

TEST_F(EarlierStates, ACommandGoesOnWhenNoneCanBeKept) {
    std::ofstream(at(".eyrie-backups")) << "in the way";
    const auto result = import();
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.errors, HasSubstr("no copy of the present state"));
    EXPECT_EQ(objects("p.eyrie"), 1U);
}

TEST_F(EarlierStates, TheHealthOfAProjectIsTold) {
    auto result = cli({"check", at("p.eyrie")});
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("is healthy"));
    ASSERT_EQ(import().exit_code, 0);
    damage(0, 200);
    result = cli({"check", at("p.eyrie")});
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_THAT(result.output, HasSubstr("is damaged"));
    EXPECT_THAT(result.output, HasSubstr("--repair"));
    EXPECT_THAT(result.output, HasSubstr("eyrie-cli backups"));
    EXPECT_FALSE(nlohmann::json::parse(cli({"check", at("p.eyrie"), "--json"}).output)["healthy"].get<bool>());
    EXPECT_EQ(cli({"check", at("none.eyrie")}).exit_code, 5);
}

TEST_F(EarlierStates, ADamagedProjectIsSavedIntoANewOne) {
    ASSERT_EQ(import().exit_code, 0);
    damage(0, 200);
    const auto size = std::filesystem::file_size(at("p.eyrie"));
    const auto result = cli({"check", at("p.eyrie"), "--repair", at("new.eyrie")});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("1 labelled object"));
    EXPECT_THAT(result.output, HasSubstr("lost, or assumed"));
    EXPECT_EQ(cli({"check", at("new.eyrie")}).exit_code, 0);
    EXPECT_EQ(objects("new.eyrie"), 1U);
    EXPECT_EQ(std::filesystem::file_size(at("p.eyrie")), size);
    EXPECT_EQ(cli({"check", at("p.eyrie"), "--repair", at("new.eyrie")}).exit_code, 4) << "it is there already";
    EXPECT_EQ(cli({"check", at("p.eyrie"), "--repair", at("p.eyrie")}).exit_code, 4);
}

}  // namespace
}  // namespace eyrie::earlier_states_test
