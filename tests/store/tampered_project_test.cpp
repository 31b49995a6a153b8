#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <set>

#include "core/error.h"
#include "store/labels/annotation_store.h"
#include "store/labels/label_samples.h"
#include "store/review/review_samples.h"
#include "store/review/review_store.h"
#include "store/runs/result_writer.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

/// Projects that somebody edited with other tools, for ill or by accident.
namespace eyrie::tampered_project_test {
namespace {

using testing::HasSubstr;

class TamperedProject : public testing::Test {
 protected:
    void SetUp() override { test::writeSampleProject(path_, 3); }
    void tamper(const std::string& commands) {
        SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
        database.exec(commands);
    }
    void expectDamaged(const std::string& words) {
        try {
            test::readEverything(path_);
            ADD_FAILURE() << "expected an error with " << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::project) << error.what();
            EXPECT_THAT(error.what(), HasSubstr(path_.string()));
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    }
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
};

TEST_F(TamperedProject, ItsTriggersDoNotRun) {
    test::writeSampleProject(path_, 2);
    tamper("CREATE TRIGGER trap AFTER UPDATE ON run BEGIN DELETE FROM run WHERE id = 1; END");
    ProjectFile project = ProjectFile::open(path_);
    RunStore(project).rename(2, "harmless");
    EXPECT_TRUE(RunStore(project).run(1).has_value());
}

TEST_F(TamperedProject, AViewIsNoTable) {
    tamper("ALTER TABLE track RENAME TO hidden; CREATE VIEW track AS SELECT * FROM hidden");
    expectDamaged("no table track");
}

TEST_F(TamperedProject, AMissingTableOrColumnIsNamed) {
    tamper("DROP VIEW v_tracks; ALTER TABLE track DROP COLUMN frames");
    expectDamaged("track has no column frames");
    tamper("DROP TABLE track");
    expectDamaged("no table track");
}

TEST_F(TamperedProject, FurtherTablesAndViewsDoNoHarm) {
    tamper("CREATE TABLE notes (text); CREATE VIEW fast AS SELECT * FROM track WHERE speed_sum > 5");
    EXPECT_NO_THROW(test::readEverything(path_));
}

TEST_F(TamperedProject, NumbersThatCannotBeAreRefused) {
    const std::pair<const char*, const char*> cases[] = {
        {"UPDATE run SET gsd_m_per_px = 0", "scale"},
        {"UPDATE run SET gsd_m_per_px = 'wide'", "scale"},
        {"UPDATE run SET scale_origin = 'perhaps'", "unknown word \"perhaps\""},
        {"UPDATE run SET gsd_known = 0, scale_origin = 'estimated', scale_uncertainty = 0.5",
         "uncertainty of its scale"},
        {"UPDATE run SET gsd_known = 0, scale_origin = 'estimated', scale_uncertainty = 9e999",
         "uncertainty of its scale"},
        {"UPDATE run SET gsd_known = 0, scale_origin = 'estimated', scale_vehicles = -3", "number of vehicles"},
        {"UPDATE run SET scale_growth_down = 1.5", "slope of its scale"},
        {"UPDATE run SET scale_growth_right = 9e999", "slope of its scale"},
        {"UPDATE run SET started_fraction_us = -1", "an impossible start"},
        {"UPDATE run SET started_fraction_us = 1000000", "an impossible start"},
        {"UPDATE run SET frame_rate_hz = -25", "frame rate"},
        {"UPDATE run SET frame_rate_hz = 9e999", "frame rate"},
        {"UPDATE run SET last_frame = 2147483647", "frames outside"},
        {"UPDATE run SET first_frame = -5", "frames outside"},
        {"UPDATE sequence SET frame_count = 2147483647", "number of frames"},
        {"UPDATE sequence SET width = 0", "size"},
        {"UPDATE sequence SET height = 2000000000", "size"},
        {"UPDATE run SET name = hex(zeroblob(3000000))", "a text of 6000000"}};
    for (const auto& [command, words] : cases) {
        std::filesystem::remove(path_);
        test::writeSampleProject(path_, 1);
        tamper(command);
        expectDamaged(words);
    }
}

TEST_F(TamperedProject, NewObjectsGetNumbersOfTheirOwnWhateverTheCounterSays) {
    for (const char* value : {"-1e308", "0", "2147483647", "9e18", "'many'"}) {
        std::filesystem::remove(path_);
        test::writeSampleProject(path_, 1);
        ProjectFile project = ProjectFile::open(path_);
        std::set<ObjectId> known;
        for (int round = 0; round < 3; ++round) {
            AnnotationStore store(project, 1);
            const ObjectId id = store.newObjectId();
            EXPECT_GT(id, 0);
            EXPECT_TRUE(known.insert(id).second) << value;
            EXPECT_NO_THROW(store.apply(test::sampleEdit(id))) << value;
            tamper(std::string("UPDATE label_counter SET value = ") + value + " WHERE kind = 'object'");
        }
    }
}

TEST_F(TamperedProject, NewVerdictsGetNumbersOfTheirOwnWhateverTheCounterSays) {
    for (const char* value : {"-5", "0", "2147483647", "3000000000"}) {
        std::filesystem::remove(path_);
        test::writeSampleProject(path_, 1);
        ProjectFile project = ProjectFile::open(path_);
        for (int round = 0; round < 3; ++round) {
            ReviewStore store(project, 1);
            const int id = store.newVerdictId();
            ReviewEdit edit;
            edit.name = "judge";
            edit.verdicts.push_back({std::nullopt, test::sampleVerdict(1)});
            edit.verdicts.back().after->id = id;
            EXPECT_NO_THROW(store.apply(edit)) << value;
            EXPECT_EQ(store.review().verdicts.size(), static_cast<std::size_t>(round + 1)) << value;
            tamper(std::string("UPDATE label_counter SET value = ") + value + " WHERE kind = 'verdict'");
        }
    }
}

TEST_F(TamperedProject, CorrectionsOfTracksThatNobodyMadeAreRefusedWithTheirNumber) {
    ProjectFile project = ProjectFile::open(path_);
    ReviewStore(project, 1).apply(test::sampleCorrecting(2));
    for (const char* change : {"kind = 'guess'", "kind = 'join'", "frame = 12", "frame = 3000000000", "track = x''",
                               "track = x'01'", "other = x''", "track = zeroblob(45)"}) {
        tamper(std::string("CREATE TABLE kept AS SELECT * FROM correction; UPDATE correction SET ") + change);
        try {
            readReview(project, 1);
            ADD_FAILURE() << change;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::project) << error.what();
            EXPECT_THAT(error.what(), HasSubstr("correction 2")) << change;
        }
        tamper("DELETE FROM correction; INSERT INTO correction SELECT * FROM kept; DROP TABLE kept");
    }
    EXPECT_EQ(readReview(project, 1).corrections.at(2), test::sampleCorrection(2));
}

TEST_F(TamperedProject, LabelsBeyondEveryVideoOrReasonAreRefused) {
    ProjectFile project = ProjectFile::open(path_);
    {
        AnnotationStore store(project, 1);
        store.apply(test::sampleEdit(store.newObjectId()));
    }
    for (const auto& [command, words] :
         {std::pair{"UPDATE labelled_object SET class = hex(zeroblob(2500000))", "a text of 5000000"},
          std::pair{"UPDATE labelled_object SET class = 'car', last_frame = 2147483647", "beyond every video"}}) {
        tamper(command);
        try {
            readAnnotations(project, 1);
            ADD_FAILURE() << "expected an error with " << words;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    }
}

}  // namespace
}  // namespace eyrie::tampered_project_test
