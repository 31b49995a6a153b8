#include "store/health/project_repair.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <random>

#include "core/error.h"
#include "store/full_project.h"
#include "store/health/project_check.h"
#include "store/health/project_contents.h"
#include "store/labels/annotation_store.h"
#include "store/labels/label_samples.h"
#include "store/review/review_samples.h"
#include "store/review/review_store.h"
#include "store/review/seen_store.h"
#include "store/samples.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace eyrie::project_repair_test {
namespace {

using testing::HasSubstr;

constexpr std::size_t kPage = 8192;

class RepairTest : public testing::Test {
 protected:
    void SetUp() override {
        test::writeFullProject(path_);
        whole_ = test::bytesOf(path_);
    }
    /// Repairs a file of these bytes; the result must be healthy and the damaged file untouched.
    RepairReport repair(const std::string& bytes) {
        test::writeBytes(path_, bytes);
        std::filesystem::remove(fresh_);
        RepairReport report = repairProject(path_, fresh_);
        EXPECT_EQ(test::bytesOf(path_), bytes);
        for (const HealthItem& item : checkProject(fresh_).items) {
            EXPECT_EQ(item.health, Health::good) << item.subject << ": " << item.words;
        }
        return report;
    }
    /// The first page of a table's tree, and all its pages.
    std::vector<std::size_t> pagesOf(const std::string& table) {
        SQLite::Database database(path_.string(), SQLite::OPEN_READONLY);
        SQLite::Statement statement(database, "SELECT pageno FROM dbstat WHERE name = ? ORDER BY path");
        statement.bind(1, table);
        std::vector<std::size_t> pages;
        while (statement.executeStep()) pages.push_back(static_cast<std::size_t>(statement.getColumn(0).getInt()));
        return pages;
    }
    std::string withoutPage(std::size_t page) const {
        std::string bytes = whole_;
        bytes.replace((page - 1) * kPage, kPage, kPage, '\0');
        return bytes;
    }
    /// How many frames of run 1 came back to the bit.
    int framesSaved() {
        ProjectFile project = ProjectFile::open(fresh_);
        const RunStore store(project);
        int saved = 0;
        for (int frame = 0; frame < test::kFullFrames; ++frame) saved += store.frameResult(1, frame) ? 1 : 0;
        return saved;
    }
    std::size_t objectsSaved() {
        ProjectFile project = ProjectFile::open(fresh_);
        return readAnnotations(project, 1).objects.size();
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
    std::filesystem::path fresh_ = folder_ / "repaired.eyrie";
    std::string whole_;
};

TEST_F(RepairTest, OfAHealthyProjectNothingIsLost) {
    const RepairReport report = repair(whole_);
    EXPECT_THAT(report.lost, testing::IsEmpty());
    EXPECT_TRUE(differencesInWords(contentsOf(path_), contentsOf(fresh_)).empty());
    ProjectFile project = ProjectFile::open(fresh_);
    for (int frame = 0; frame < test::kFullFrames; ++frame) {
        test::expectSame(*RunStore(project).frameResult(1, frame),
                         test::sampleFrame(frame, {400, 100, 6, 7, 5, {768, 576}}));
    }
    AnnotationStore labels(project, 1);
    EXPECT_EQ(labels.undoCount(), test::kFullObjects);
    EXPECT_EQ(labels.redoCount(), 1);
    labels.redo();
    while (labels.undo()) {
    }
    EXPECT_TRUE(labels.annotations().objects.empty());
    ReviewStore review(project, 1);
    EXPECT_EQ(review.undoCount(), test::kFullVerdicts + test::kFullZones + test::kFullCorrections);
    EXPECT_EQ(review.review().zones.size(), static_cast<std::size_t>(test::kFullZones));
    EXPECT_EQ(review.review().corrections.at(3), test::sampleCorrection(3));
    EXPECT_EQ(review.redoCount(), 1);
    while (review.undo()) {
    }
    EXPECT_TRUE(review.review().verdicts.empty());
    EXPECT_TRUE(review.review().zones.empty());
    EXPECT_TRUE(review.review().corrections.empty());
    EXPECT_EQ(seenBy(project, 1).at("Ada").size(), 2U);
}

TEST_F(RepairTest, SentencesOfAnOlderProjectBecomeWords) {
    const auto old = folder_ / "old.eyrie";
    {
        SQLite::Database database(old.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        database.exec(test::bytesOf(test::sourceFolder() / "tests/data/schema_1.sql"));
        database.exec("UPDATE frame SET registration_state = 'failed', reason = 'too few corners (12 of 40)'");
    }
    const auto saved = folder_ / "saved.eyrie";
    repairProject(old, saved, {});
    SQLite::Database database(saved.string(), SQLite::OPEN_READONLY);
    EXPECT_EQ(database.execAndGet("SELECT reason || ' ' || reason_count || '/' || reason_of FROM frame").getString(),
              "too few corners 12/40");
}

TEST_F(RepairTest, AnOlderProjectTellsWhereItsScalesComeFromAsIfItHadBeenOpened) {
    const auto old = folder_ / "old.eyrie";
    test::writeRunsOfSchemaEleven(old);
    const RepairReport report = repairProject(old, fresh_);
    EXPECT_THAT(report.lost, testing::IsEmpty());
    ProjectFile project = ProjectFile::open(fresh_);
    test::expectOriginsOfSchemaEleven(project);
}

TEST_F(RepairTest, ADamagedOriginOfAScaleDoesNotCostTheRun) {
    for (const char* damage : {"scale_origin = 'perhaps'", "scale_uncertainty = 0.5", "scale_vehicles = -3",
                               "scale_uncertainty = 'wide'", "scale_origin = 'assumed'"}) {
        test::writeBytes(path_, whole_);
        SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).exec(std::string("UPDATE run SET ") + damage);
        const RepairReport report = repair(test::bytesOf(path_));
        EXPECT_THAT(report.lost, testing::Contains("where the scale of run 1 came from")) << damage;
        ProjectFile project = ProjectFile::open(fresh_);
        const auto run = RunStore(project).run(1);
        EXPECT_EQ(run->name, "first try") << damage;
        EXPECT_EQ(run->scale_basis, ScaleBasis{ScaleOrigin::given}) << damage;
    }
}

TEST_F(RepairTest, ADamagedSlopeOfAScaleDoesNotCostTheRun) {
    for (const char* damage : {"scale_growth_down = 2", "scale_growth_right = 'steep'"}) {
        test::writeBytes(path_, whole_);
        SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).exec(std::string("UPDATE run SET ") + damage);
        const RepairReport report = repair(test::bytesOf(path_));
        EXPECT_THAT(report.lost, testing::Contains("how the scale of run 1 changes over the picture")) << damage;
        ProjectFile project = ProjectFile::open(fresh_);
        const auto run = RunStore(project).run(1);
        EXPECT_EQ(run->name, "first try") << damage;
        EXPECT_TRUE(run->scale.slope.isFlat()) << damage;
    }
}

TEST_F(RepairTest, ADamagedStartCostsTheFractionOfItsSecondAndNotTheRun) {
    for (const char* damage : {"-1", "1000000", "'soon'"}) {
        test::writeBytes(path_, whole_);
        SQLite::Database(path_.string(), SQLite::OPEN_READWRITE)
            .exec(std::string("UPDATE run SET started_fraction_us = ") + damage);
        const RepairReport report = repair(test::bytesOf(path_));
        EXPECT_THAT(report.lost, testing::Contains("when in its second run 1 began")) << damage;
        ProjectFile project = ProjectFile::open(fresh_);
        const auto run = RunStore(project).run(1);
        EXPECT_EQ(run->name, "first try") << damage;
        EXPECT_FALSE(run->started_utc.empty()) << damage;
        EXPECT_EQ(run->started_us, std::nullopt) << damage;
    }
}

TEST_F(RepairTest, ADamagedCorrectionOfTracksCostsItselfAlone) {
    for (const char* damage : {"track = x'0102'", "other = track", "kind = 'guess'", "frame = 9999", "track = x'01'",
                               "frame = -1", "person = hex(zeroblob(40000))"}) {
        std::filesystem::remove(fresh_);
        std::filesystem::remove(path_);
        test::writeFullProject(path_);
        {
            SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
            database.exec(std::string("UPDATE correction SET ") + damage + " WHERE id = 2");
        }
        EXPECT_FALSE(checkProject(path_).healthy()) << damage;
        const RepairReport report = repairProject(path_, fresh_);
        EXPECT_FALSE(report.lost.empty()) << damage;
        EXPECT_TRUE(checkProject(fresh_).healthy()) << damage;
        ProjectFile project = ProjectFile::open(fresh_);
        const auto corrections = readReview(project, 1).corrections;
        EXPECT_EQ(corrections.size(), static_cast<std::size_t>(test::kFullCorrections - 1)) << damage;
        EXPECT_EQ(corrections.at(1), test::sampleCorrection(1)) << damage;
    }
}

TEST_F(RepairTest, AnythingAtTheBeginningOfTheFileCanBeLost) {
    for (const auto& [at, length] : std::vector<std::pair<std::size_t, std::size_t>>{{0, 16},
                                                                                     {16, 2},
                                                                                     {18, 2},
                                                                                     {20, 4},
                                                                                     {24, 4},
                                                                                     {28, 4},
                                                                                     {32, 8},
                                                                                     {40, 8},
                                                                                     {52, 8},
                                                                                     {60, 12},
                                                                                     {92, 8},
                                                                                     {0, 100}}) {
        std::string bytes = whole_;
        bytes.replace(at, length, length, '\xa7');
        const RepairReport report = repair(bytes);
        EXPECT_EQ(framesSaved(), test::kFullFrames) << at;
        EXPECT_EQ(objectsSaved(), test::kFullObjects) << at;
    }
}

TEST_F(RepairTest, TheListOfTablesCanBeLost) {
    repair(withoutPage(1));
    EXPECT_EQ(framesSaved(), test::kFullFrames);
    EXPECT_EQ(objectsSaved(), test::kFullObjects);
}

TEST_F(RepairTest, OneLostPageCostsOnlyWhatLayThere) {
    const int pages = static_cast<int>(whole_.size() / kPage);
    for (int page = 2; page <= pages; page += 7) {
        const RepairReport report = repair(withoutPage(static_cast<std::size_t>(page)));
        EXPECT_FALSE(report.saved.empty()) << page;
    }
}

TEST_F(RepairTest, TheScoreOfAFinishedTrackIsKeptEvenWhereItsRowIsLost) {
    {
        ProjectFile project = ProjectFile::open(path_);
        TracksOfRun tracks;
        tracks.states = [](const TracksOfRun::StateVisitor& visitor) {
            for (int age = 0; age < 3; ++age) {
                TrackState state;
                state.id = 7;
                state.status = TrackStatus::confirmed;
                state.age = age;
                state.score = 0.75;
                visitor(2 + age, state);
            }
        };
        tracks.evidence[7].score = 0.75;
        RunStore(project).replaceTracks(1, tracks);
    }
    whole_ = test::bytesOf(path_);
    for (const std::string& bytes : {whole_, withoutPage(pagesOf("track").front())}) {
        repair(bytes);
        ProjectFile project = ProjectFile::open(fresh_);
        const auto states = RunStore(project).trackStates(1, 7);
        ASSERT_EQ(states.size(), 3U);
        EXPECT_EQ(states[2].state.score, 0.75);
        EXPECT_EQ(states[2].state.age, 2);
    }
}

TEST_F(RepairTest, ALeafOfFramesCostsItsFramesAlone) {
    const auto pages = pagesOf("frame");
    ASSERT_GT(pages.size(), 2U) << "the table has several leaves";
    const RepairReport report = repair(withoutPage(pages[1]));
    EXPECT_THAT(report.lost, testing::Contains(HasSubstr("frame")));
    EXPECT_GT(framesSaved(), test::kFullFrames / 4);
    EXPECT_LT(framesSaved(), test::kFullFrames);
    EXPECT_EQ(objectsSaved(), test::kFullObjects);
    ProjectFile project = ProjectFile::open(fresh_);
    EXPECT_EQ(RunStore(project).run(1)->state, RunState::failed) << "it must not be taken for a whole run";
}

TEST_F(RepairTest, WithoutTheListOfRunsTheirFramesAreThere) {
    const RepairReport report = repair(withoutPage(pagesOf("run").front()));
    EXPECT_THAT(report.lost, testing::Contains(HasSubstr("the description of run 1")));
    EXPECT_EQ(framesSaved(), test::kFullFrames);
    EXPECT_EQ(objectsSaved(), test::kFullObjects);
}

TEST_F(RepairTest, WithoutTheListOfVideosTheLabelsAreThere) {
    repair(withoutPage(pagesOf("sequence").front()));
    EXPECT_EQ(framesSaved(), test::kFullFrames);
    EXPECT_EQ(objectsSaved(), test::kFullObjects);
}

TEST_F(RepairTest, WithoutTheStepsOfWorkTheLabelsAreThere) {
    const RepairReport report = repair(withoutPage(pagesOf("edit_journal").front()));
    EXPECT_EQ(objectsSaved(), test::kFullObjects);
    EXPECT_THAT(report.lost, testing::Contains(HasSubstr("edit_journal")));
}

TEST_F(RepairTest, ATruncatedFileGivesWhatIsLeft) {
    for (const double share : {0.999, 0.9, 0.7, 0.5, 0.3, 0.1}) {
        repair(whole_.substr(0, static_cast<std::size_t>(static_cast<double>(whole_.size()) * share)));
    }
    repair(whole_.substr(0, 5000));
    repair(whole_.substr(0, 60));
}

TEST_F(RepairTest, RandomDamageIsNeverTooMuch) {
    std::mt19937 dice(5);
    for (int trial = 0; trial < 12; ++trial) {
        std::string bytes = whole_;
        const std::size_t holes = 1 + dice() % 8;
        for (std::size_t hole = 0; hole < holes; ++hole) {
            const std::size_t length = std::size_t{1} << (dice() % 15);
            const std::size_t at = dice() % (bytes.size() - length);
            for (std::size_t i = 0; i < length; ++i) bytes[at + i] = static_cast<char>(dice());
        }
        repair(bytes);
    }
}

TEST_F(RepairTest, ALogOfAnotherFileIsLeftOut) {
    const auto other = folder_ / "other.eyrie";
    test::writeSampleProject(other, 3);
    {
        ProjectFile project = ProjectFile::open(other);
        AnnotationStore labels(project, 1);
        labels.apply(test::sampleEdit(labels.newObjectId()));
        std::filesystem::copy_file(other.string() + "-wal", path_.string() + "-wal");
    }
    const RepairReport report = repair(whole_);
    EXPECT_THAT(report.lost, testing::Contains(HasSubstr("log")));
    EXPECT_EQ(framesSaved(), test::kFullFrames);
}

TEST_F(RepairTest, ALogThatBelongsToTheProjectCounts) {
    {
        ProjectFile project = ProjectFile::open(path_);
        project.database().exec("UPDATE run SET name = 'later' WHERE id = 1");
        std::filesystem::copy_file(path_, folder_ / "killed.eyrie");
        std::filesystem::copy_file(path_.string() + "-wal", folder_ / "killed.eyrie-wal");
    }
    const RepairReport report = repairProject(folder_ / "killed.eyrie", fresh_);
    EXPECT_THAT(report.lost, testing::IsEmpty());
    ProjectFile project = ProjectFile::open(fresh_);
    EXPECT_EQ(RunStore(project).run(1)->name, "later");
}

TEST_F(RepairTest, AnOlderProjectIsSavedAsANewOne) {
    const auto old = folder_ / "old.eyrie";
    SQLite::Database(old.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
        .exec(test::bytesOf(test::sourceFolder() / "tests/data/schema_1.sql"));
    repairProject(old, fresh_);
    ProjectFile project = ProjectFile::open(fresh_);
    EXPECT_TRUE(RunStore(project).frameResult(1, 7).has_value());
}

TEST_F(RepairTest, NothingIsReplacedAndNothingStaysBehind) {
    test::writeBytes(fresh_, "mine");
    EXPECT_THROW(repairProject(path_, fresh_), Error);
    EXPECT_THROW(repairProject(path_, path_), Error);
    EXPECT_EQ(test::bytesOf(fresh_), "mine");
    std::filesystem::remove(fresh_);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_TRUE(repairProject(path_, fresh_, {{}, stop.get_token()}).stopped);
    int entries = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_.path())) ++entries;
    EXPECT_EQ(entries, 1);
}

}  // namespace
}  // namespace eyrie::project_repair_test
