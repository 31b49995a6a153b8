#include "cli/arguments/run_choice.h"

#include <gmock/gmock.h>

#include "chain/chain_options.h"
#include "chain/recording/run_recorder.h"
#include "store/project/project_file.h"
#include "support/temporary_folder.h"
#include "support/written_run.h"

namespace eyrie::run_choice_test {
namespace {

using cli::checkNotBegun;
using cli::FinishedMeanwhile;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Two commands found nothing to resume, and this one comes second.
class BegunMeanwhile : public testing::Test {
 protected:
    void SetUp() override { ProjectFile::openOrCreate(project_); }
    void check() const {
        ProjectFile file = ProjectFile::open(project_, ProjectFile::Mode::read_only);
        cli::ResumeWishes wishes;
        wishes.video = kVideo;
        checkNotBegun(RunStore(file), project_.string(), wishes);
    }
    /// Empty when a run may be begun.
    std::string told() const {
        try {
            check();
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::project);
            return error.what();
        }
        return {};
    }
    static RunRecord planned() {
        RunRecord run;
        run.sequence = {.path = kVideo, .size = {320, 240}, .frame_count = 3, .frame_rate_hz = 25};
        run.engine_version = engineVersion();
        run.last_frame = 2;
        return run;
    }
    static constexpr const char* kVideo = "/nowhere/clip.mp4";
    test::TemporaryFolder folder_;
    const std::filesystem::path project_ = folder_ / "p.eyrie";
};

TEST_F(BegunMeanwhile, WhereNobodyDidARunMayBegin) {
    EXPECT_NO_THROW(check());
    RunRecord other = planned();
    other.sequence.path = "/nowhere/other.mp4";
    const ResultWriter writer(project_, other, parameterValues(ChainOptions()));
    EXPECT_NO_THROW(check()) << "of another video";
}

TEST_F(BegunMeanwhile, OneThatIsAtWorkIsToBeLeftToIt) {
    const ResultWriter writer(project_, planned(), parameterValues(ChainOptions()));
    EXPECT_THAT(told(), AllOf(HasSubstr("run 1 of " + project_.string()), HasSubstr("by process "),
                              HasSubstr("let it end there")));
}

TEST_F(BegunMeanwhile, OneThatWasStoppedIsGoneOnWithByTheSameCommand) {
    {
        ResultWriter writer(project_, planned(), parameterValues(ChainOptions()));
        writer.finish(RunState::stopped, "");
    }
    EXPECT_THAT(told(),
                AllOf(HasSubstr("and stopped; the same command goes on with it"), Not(HasSubstr("let it end"))));
}

TEST_F(BegunMeanwhile, OfOneThatWasFinishedNothingIsLeftToDo) {
    const RunRecord finished = test::writeRun(project_, planned(), [](int, FrameResult&) {});
    try {
        check();
        FAIL() << "it would be done twice";
    } catch (const FinishedMeanwhile& other) {
        EXPECT_EQ(other.run.id, finished.id);
        EXPECT_THAT(other.what(), AllOf(HasSubstr("was finished by another program"), Not(HasSubstr("let it end"))));
    }
}

}  // namespace
}  // namespace eyrie::run_choice_test
