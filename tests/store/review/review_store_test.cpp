#include "store/review/review_store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include "store/following.h"
#include "store/health/project_check.h"
#include "store/labels/annotation_store.h"
#include "store/review/packed_review.h"
#include "store/review/review_samples.h"
#include "store/samples.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace eyrie::review_store_test {
namespace {

using test::messageOf;
using testing::HasSubstr;

class ReviewStoreTest : public testing::Test {
 protected:
    void SetUp() override { ensureSequence(project_, test::sampleRun().sequence); }
    void tamper(const std::string& command) {
        SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
        database.exec(command);
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
    ProjectFile project_ = ProjectFile::create(path_);
};

TEST_F(ReviewStoreTest, WhatWasSaidIsThereAfterARestartToTheBit) {
    {
        ReviewStore store(project_, 1);
        for (int id = 1; id <= 20; ++id) store.apply(test::sampleJudging(id));
        store.apply(test::sampleBookmarking(1));
        Bookmark nowhere = test::sampleBookmark(2);
        nowhere.place.reset();
        store.apply({"Add bookmark", {}, {{std::nullopt, nowhere}}});
    }
    const ReviewSet read = readReview(project_, 1);
    ASSERT_EQ(read.verdicts.size(), 20U);
    for (int id = 1; id <= 20; ++id) EXPECT_EQ(read.verdicts.at(id), test::sampleVerdict(id)) << id;
    EXPECT_EQ(read.bookmarks.at(1), test::sampleBookmark(1));
    EXPECT_FALSE(read.bookmarks.at(2).place.has_value());
    EXPECT_TRUE(checkProject(path_).healthy());
}

TEST_F(ReviewStoreTest, StepsAreTakenBackAndDoneAgainOverRestarts) {
    {
        ReviewStore store(project_, 1);
        store.apply(test::sampleJudging(store.newVerdictId()));
        Verdict other = test::sampleVerdict(1);
        other.judgement = Judgement::unsure;
        other.note.clear();
        store.apply({"Judge again", {{test::sampleVerdict(1), other}}, {}});
    }
    {
        ReviewStore store(project_, 1);
        EXPECT_EQ(store.undoName(), "Judge again");
        EXPECT_EQ(store.undo()->name, "Judge again");
        EXPECT_EQ(store.review().verdicts.at(1), test::sampleVerdict(1));
        store.undo();
        EXPECT_TRUE(store.review().verdicts.empty());
        EXPECT_FALSE(store.canUndo());
        EXPECT_FALSE(store.undo().has_value());
    }
    ReviewStore store(project_, 1);
    EXPECT_TRUE(store.review().verdicts.empty());
    EXPECT_EQ(store.redoCount(), 2);
    EXPECT_EQ(store.redoName(), "Judge event 1");
    store.redo();
    store.redo();
    EXPECT_EQ(store.review().verdicts.at(1).judgement, Judgement::unsure);
    EXPECT_FALSE(store.redo().has_value());
    store.undo();
    store.apply(test::sampleBookmarking(1));
    EXPECT_FALSE(store.canRedo()) << "a new step ends what was undone";
    EXPECT_EQ(store.newVerdictId(), 2) << "numbers are never used again";
}

TEST_F(ReviewStoreTest, ZonesAreThereAfterARestartToTheBitAndGoBackStepByStep) {
    StoredZone renamed = test::sampleZone(2);
    renamed.zone.name = "gate";
    renamed.shown = true;
    {
        ReviewStore store(project_, 1);
        for (int i = 0; i < 6; ++i) store.apply(test::sampleZoning(store.newZoneId()));
        ReviewEdit rename = test::sampleJudging(store.newVerdictId());
        rename.name = "Rename zone";
        rename.zones = {{test::sampleZone(2), renamed}};
        store.apply(rename);
        store.apply({"Delete zone", {}, {}, {{test::sampleZone(6), std::nullopt}}});
    }
    EXPECT_TRUE(checkProject(path_).healthy());
    const ReviewSet read = readReview(project_, 1);
    ASSERT_EQ(read.zones.size(), 5U);
    EXPECT_EQ(read.zones.at(1), test::sampleZone(1));
    EXPECT_EQ(read.zones.at(2), renamed);
    EXPECT_EQ(read.zones.at(3), test::sampleZone(3));
    ReviewStore store(project_, 1);
    EXPECT_EQ(store.newZoneId(), 7) << "numbers are never used again";
    store.undo();
    EXPECT_EQ(store.review().zones.at(6), test::sampleZone(6));
    store.undo();
    EXPECT_EQ(store.review().zones.at(2), test::sampleZone(2));
    EXPECT_TRUE(store.review().verdicts.empty()) << "what changed in one step goes back in one";
    for (int i = 0; i < 6; ++i) store.undo();
    EXPECT_TRUE(readReview(project_, 1).zones.empty());
    while (store.redo()) {
    }
    EXPECT_EQ(store.review().zones, read.zones);
}

TEST_F(ReviewStoreTest, CorrectionsOfTracksAreThereAfterARestartToTheBitAndGoBackStepByStep) {
    {
        ReviewStore store(project_, 1);
        for (int i = 0; i < 6; ++i) store.apply(test::sampleCorrecting(store.newCorrectionId()));
        ReviewEdit removal{"Remove track", {}, {}};
        removal.corrections = {{test::sampleCorrection(3), std::nullopt}};
        removal.zones = {{std::nullopt, test::sampleZone(store.newZoneId())}};
        store.apply(removal);
    }
    EXPECT_TRUE(checkProject(path_).healthy());
    const ReviewSet read = readReview(project_, 1);
    ASSERT_EQ(read.corrections.size(), 5U);
    for (const int id : {1, 2, 4, 5, 6}) EXPECT_EQ(read.corrections.at(id), test::sampleCorrection(id)) << id;
    ReviewStore store(project_, 1);
    EXPECT_EQ(store.newCorrectionId(), 7) << "numbers are never used again";
    EXPECT_EQ(store.undo()->name, "Remove track");
    EXPECT_EQ(store.review().corrections.at(3), test::sampleCorrection(3));
    EXPECT_TRUE(store.review().zones.empty());
    for (int i = 0; i < 6; ++i) store.undo();
    EXPECT_TRUE(readReview(project_, 1).corrections.empty());
    while (store.redo()) {
    }
    EXPECT_EQ(store.review().corrections, read.corrections);
}

TEST_F(ReviewStoreTest, TracksAreRejectedInAProjectThatKnewNoRejections) {
    // As a version of before wrote it.
    ReviewStore(project_, 1).apply(test::sampleCorrecting(1));
    tamper(
        "INSERT INTO correction SELECT 2, sequence_id, 'add', frame, track, x'01', person, when_utc FROM correction "
        "WHERE id = 1 AND kind = 'join'");
    {
        ReviewStore store(project_, 1);
        EXPECT_EQ(store.review().corrections.at(2).kind, CorrectionKind::add);
        ReviewEdit rejecting = test::sampleCorrecting(3);
        rejecting.corrections.push_back({std::nullopt, test::sampleCorrection(7)});
        store.apply(rejecting);
    }
    tamper("UPDATE correction SET person = 'Cy' WHERE kind = 'reject' AND id IN (3, 7)");
    for (const HealthItem& item : checkProject(path_).items) {
        if (item.subject != "values") continue;
        EXPECT_EQ(item.health, Health::good) << item.words;
    }
    const auto read = readReview(project_, 1).corrections;
    ASSERT_EQ(read.size(), 4U);
    EXPECT_EQ(read.at(1), test::sampleCorrection(1));
    for (const int id : {3, 7}) {
        EXPECT_EQ(read.at(id).kind, CorrectionKind::reject);
        EXPECT_EQ(read.at(id).person, "Cy") << "the word in the file";
        EXPECT_EQ(read.at(id).track, test::sampleCorrection(id).track);
    }
    tamper("UPDATE correction SET person = 'Bo' WHERE person = 'Cy'");
    ReviewStore store(project_, 1);
    store.undo();
    EXPECT_EQ(store.review().corrections.size(), 2U) << "both were one step";
    store.redo();
    EXPECT_EQ(readReview(project_, 1).corrections.at(7), test::sampleCorrection(7));
}

TEST_F(ReviewStoreTest, ASecondProgramReadsCorrectionsAndMayNotMakeAny) {
    ReviewStore store(project_, 1);
    ProjectFile second_project = ProjectFile::open(path_);
    ReviewStore second(second_project, 1);
    ASSERT_TRUE(second.readOnly());
    store.apply(test::sampleCorrecting(1));
    EXPECT_TRUE(test::follows(second, path_));
    EXPECT_EQ(second.review().corrections.at(1), test::sampleCorrection(1));
    EXPECT_FALSE(test::follows(second, path_));
    messageOf(ErrorKind::output, [&] { second.apply(test::sampleCorrecting(2)); });
    store.undo();
    EXPECT_TRUE(test::follows(second, path_));
    EXPECT_TRUE(second.review().corrections.empty());
}

TEST_F(ReviewStoreTest, CorrectionsThatCannotBeAreRefusedAndChangeNothing) {
    ReviewStore store(project_, 1);
    const auto refused = [&](int like, const std::function<void(TrackCorrection&)>& change) {
        ReviewEdit edit = test::sampleCorrecting(like);
        change(*edit.corrections.front().after);
        messageOf(ErrorKind::internal, [&] { store.apply(edit); });
        EXPECT_TRUE(store.review().corrections.empty());
    };
    for (const int like : {3, 4}) {  // rejecting, adding
        refused(like, [](TrackCorrection& of_one) { of_one.track.clear(); });
        refused(like, [](TrackCorrection& of_one) { of_one.track[2].frame = of_one.track[1].frame; });
        refused(like, [](TrackCorrection& of_one) { of_one.track[1].box.length = 0; });
        refused(like, [](TrackCorrection& of_one) { of_one.track[1].box.heading = std::nan(""); });
        refused(like, [](TrackCorrection& of_one) { of_one.track[1].box.centre.x = 2e6; });
    }
    for (const int like : {2, 4})  // splitting, adding
        refused(like, [](TrackCorrection& of_one) { of_one.other = of_one.track; });
    refused(1, [](TrackCorrection& joining) { joining.other.clear(); });
    refused(2, [](TrackCorrection& splitting) { splitting.frame = splitting.track.front().frame; });
    refused(2, [](TrackCorrection& splitting) { splitting.frame = splitting.track.back().frame + 1; });
    refused(2, [](TrackCorrection& splitting) { splitting.id = 0; });
}

TEST_F(ReviewStoreTest, ARejectionKeepsTheTrackThatWasKeptBesideIt) {
    ReviewEdit rejecting = test::sampleCorrecting(3);
    TrackCorrection& made = *rejecting.corrections.front().after;
    made.other = {{15, {{22.5, 30.5}, 12, 6, 0}}, {16, {{23.5, 30.5}, 12, 6, 0}}};
    ReviewStore(project_, 1).apply(rejecting);
    EXPECT_EQ(readReview(project_, 1).corrections.at(3), made);
    for (const HealthItem& item : checkProject(path_).items) {
        if (item.subject != "values") continue;
        EXPECT_EQ(item.health, Health::good) << item.words;
    }
}

TEST_F(ReviewStoreTest, BytesOfACorrectionThatNoWriterWroteAreNothing) {
    const Bytes good = packReview(test::sampleCorrecting(1));
    ASSERT_TRUE(unpackReview(good).has_value());
    EXPECT_EQ(unpackReview(good)->corrections.front().after, test::sampleCorrection(1));
    for (std::size_t length = 0; length < good.size(); ++length)
        EXPECT_FALSE(unpackReview(ByteView(good).first(length)).has_value()) << length;
    Bytes longer = good;
    longer.push_back(std::byte{0});
    EXPECT_FALSE(unpackReview(longer).has_value());
    Bytes later = good;
    later[0] = std::byte{4};
    EXPECT_FALSE(unpackReview(later).has_value());
    const Bytes boxes = packSightings(test::sampleCorrection(1).track);
    EXPECT_EQ(unpackSightings(boxes), test::sampleCorrection(1).track);
    for (std::size_t length = 2; length < boxes.size(); ++length)
        EXPECT_EQ(unpackSightings(ByteView(boxes).first(length)).has_value(), length % 44 == 1) << length;
    EXPECT_FALSE(unpackSightings({}).has_value());
}

TEST_F(ReviewStoreTest, ZonesThatCannotBeAreRefusedInWords) {
    ReviewStore store(project_, 1);
    store.apply(test::sampleZoning(1));
    const auto refusal = [&](const std::function<void(StoredZone&)>& change) {
        StoredZone zone = test::sampleZone(2);
        change(zone);
        return messageOf(ErrorKind::parameter, [&] { store.apply({"x", {}, {}, {{std::nullopt, zone}}}); });
    };
    EXPECT_THAT(refusal([](StoredZone& z) { z.zone.name = "yard 1"; }), HasSubstr("a zone \"yard 1\" already"));
    EXPECT_THAT(refusal([](StoredZone& z) { z.zone.name.clear(); }), HasSubstr("needs a name"));
    EXPECT_THAT(refusal([](StoredZone& z) { z.zone.points.resize(2); }), HasSubstr("three points or more"));
    EXPECT_THAT(refusal([](StoredZone& z) { z.zone.points = {{0, 0}, {5, 5}, {10, 10}}; }), HasSubstr("no area"));
    EXPECT_THAT(refusal([](StoredZone& z) { z.zone.points[1].y = std::nan(""); }), HasSubstr("no place"));
    EXPECT_THAT(refusal([](StoredZone& z) { z.zone.points.resize(5000, {1, 2}); }), HasSubstr("up to 1000"));
    EXPECT_EQ(readReview(project_, 1).zones.size(), 1U);
    ReviewEdit swapped{"Swap names", {}, {}, {}};
    store.apply(test::sampleZoning(2));
    for (const int id : {1, 2}) {
        StoredZone zone = test::sampleZone(id);
        zone.zone.name = test::sampleZone(3 - id).zone.name;
        swapped.zones.push_back({test::sampleZone(id), zone});
    }
    store.apply(swapped);
    EXPECT_EQ(readReview(project_, 1).zones.at(2).zone.name, "yard 1");
}

TEST_F(ReviewStoreTest, ThousandsAtOnceAreOneStep) {
    ReviewEdit bulk{"Judge 5000 events not relevant", {}, {}};
    for (int id = 1; id <= 5000; ++id) bulk.verdicts.push_back({std::nullopt, test::sampleVerdict(id)});
    {
        ReviewStore store(project_, 1);
        store.apply(bulk);
        EXPECT_EQ(store.undoCount(), 1);
    }
    ReviewStore store(project_, 1);
    EXPECT_EQ(store.review().verdicts.size(), 5000U);
    EXPECT_EQ(store.undo()->verdicts.size(), 5000U);
    EXPECT_TRUE(readReview(project_, 1).verdicts.empty());
    store.redo();
    EXPECT_EQ(readReview(project_, 1).verdicts.size(), 5000U);
}

TEST_F(ReviewStoreTest, WhatCannotBeIsRefusedAndNothingChanges) {
    ReviewStore store(project_, 1);
    store.apply(test::sampleJudging(1));
    const auto version = store.version();
    const auto with = [](const std::function<void(Verdict&)>& change) {
        Verdict verdict = test::sampleVerdict(2);
        change(verdict);
        return ReviewEdit{"x", {{std::nullopt, verdict}}, {}};
    };
    messageOf(ErrorKind::internal, [&] { store.apply(test::sampleJudging(1)); });
    messageOf(ErrorKind::internal, [&] { store.apply({"x", {{test::sampleVerdict(7), std::nullopt}}, {}}); });
    messageOf(ErrorKind::internal, [&] { store.apply(with([](Verdict& v) { v.subject.place.x = std::nan(""); })); });
    messageOf(ErrorKind::internal, [&] { store.apply(with([](Verdict& v) { v.subject.last_frame = 3; })); });
    messageOf(ErrorKind::parameter, [&] { store.apply(with([](Verdict& v) { v.tags = {"a,b"}; })); });
    EXPECT_THAT(
        messageOf(ErrorKind::parameter, [&] { store.apply(with([](Verdict& v) { v.note.assign(70000, 'n'); })); }),
        HasSubstr("too long"));
    EXPECT_EQ(store.version(), version);
    EXPECT_EQ(store.undoCount(), 1);
    store.apply({"nothing", {}, {}});
    EXPECT_EQ(store.undoCount(), 1);
}

TEST_F(ReviewStoreTest, WhatCannotBeWrittenIsNeitherInTheFileNorInMemory) {
    ReviewStore store(project_, 1);
    store.apply(test::sampleJudging(1));
    {
        SQLite::Database other(path_.string(), SQLite::OPEN_READWRITE);
        const SQLite::Transaction lock(other, SQLite::TransactionBehavior::EXCLUSIVE);
        project_.database().setBusyTimeout(10);
        messageOf(ErrorKind::project, [&] { store.apply(test::sampleJudging(2)); });
        messageOf(ErrorKind::project, [&] { store.undo(); });
    }
    EXPECT_EQ(store.review().verdicts.size(), 1U);
    EXPECT_EQ(readReview(project_, 1).verdicts.size(), 1U);
    EXPECT_EQ(store.undoCount(), 1);
    store.apply(test::sampleJudging(2));
    EXPECT_EQ(readReview(project_, 1).verdicts.size(), 2U);
}

TEST_F(ReviewStoreTest, ASecondWindowReadsAndTakesOverWhenTheFirstIsClosed) {
    auto first = std::make_unique<ReviewStore>(project_, 1);
    ProjectFile other = ProjectFile::open(path_);
    ReviewStore second(other, 1);
    EXPECT_FALSE(first->readOnly());
    EXPECT_TRUE(second.readOnly());
    EXPECT_THAT(second.readOnlyReason(), HasSubstr("is reviewing this project"));
    messageOf(ErrorKind::output, [&] { second.apply(test::sampleJudging(9)); });
    EXPECT_FALSE(test::follows(second, path_));
    first->apply(test::sampleJudging(1));
    EXPECT_TRUE(test::follows(second, path_));
    EXPECT_EQ(second.review().verdicts.size(), 1U);
    EXPECT_FALSE(AnnotationStore(other, 1).readOnly()) << "another may label meanwhile";
    first.reset();
    EXPECT_TRUE(second.tryToWrite());
    EXPECT_TRUE(second.undo().has_value());
    EXPECT_TRUE(std::filesystem::exists(path_.string() + ".reviewing"));
}

TEST_F(ReviewStoreTest, WhatIsKnownIsNotReadNorTakenAgain) {
    ReviewStore first(project_, 1);
    first.apply(test::sampleJudging(1));
    EXPECT_FALSE(ReviewStore::readIfChanged(project_, 1, first.changes()));
    ProjectFile other = ProjectFile::open(path_);
    ReviewStore second(other, 1);
    first.apply(test::sampleJudging(2));
    const auto reading = ReviewStore::readIfChanged(project_, 1, second.changes());
    ASSERT_TRUE(reading.has_value());
    const std::uint64_t before = second.version();
    EXPECT_TRUE(second.follow(*reading));
    EXPECT_GT(second.version(), before) << "for what was computed from it";
    EXPECT_EQ(second.review().verdicts.size(), 2U);
    EXPECT_FALSE(second.follow(*reading));
    first.apply(test::sampleJudging(3));
    EXPECT_FALSE(first.follow(*reading)) << "who writes knows better than what was read before";
    EXPECT_EQ(first.review().verdicts.size(), 3U);
}

TEST_F(ReviewStoreTest, VideosOfAProjectAreReviewedApart) {
    SequenceRecord another = test::sampleRun().sequence;
    another.path = "/videos/other.mp4";
    const int id = ensureSequence(project_, another);
    ReviewStore(project_, 1).apply(test::sampleJudging(1));
    ReviewStore store(project_, id);
    EXPECT_TRUE(store.review().verdicts.empty());
    EXPECT_FALSE(store.canUndo());
    EXPECT_EQ(store.newVerdictId(), 2);
    messageOf(ErrorKind::internal, [&] { store.apply(test::sampleJudging(1)); });
    EXPECT_EQ(readReview(project_, 1).verdicts.size(), 1U) << "nothing is taken away from the other one";
}

TEST_F(ReviewStoreTest, RowsThatNobodyWroteAreRefusedAndFoundByACheck) {
    ReviewStore(project_, 1).apply(test::sampleJudging(1));
    ReviewStore(project_, 1).apply(test::sampleBookmarking(1));
    for (const int id : {1, 2, 3}) ReviewStore(project_, 1).apply(test::sampleZoning(id));
    const std::pair<const char*, const char*> cases[] = {
        {"UPDATE verdict SET kind = 'flies'", "unknown word"},
        {"UPDATE verdict SET judgement = ''", "unknown word"},
        {"UPDATE verdict SET first_frame = -1", "that no video has"},
        {"UPDATE verdict SET last_frame = 2147483647", "that no video has"},
        {"UPDATE verdict SET frame = 5", "range of frames"},
        {"UPDATE verdict SET x = 9e999", "place"},
        {"UPDATE verdict SET note = hex(zeroblob(50000))", "a text of 100000"},
        {"UPDATE bookmark SET frame = -4", "that no video has"},
        {"UPDATE bookmark SET y = NULL", "place"},
        {"UPDATE zone SET shape = 'ring'", "unknown word"},
        {"UPDATE zone SET name = 'yard'", "the name of another"},
        {"UPDATE zone SET name = ''", "needs a name"},
        {"UPDATE zone SET points = substr(points, 1, 33)", "three points"},
        {"UPDATE zone SET points = x'02'", "broken points"},
        {"UPDATE zone SET colour = 99999999", "colour"}};
    for (const auto& [command, words] : cases) {
        SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
        database.exec("CREATE TEMP TABLE v AS SELECT * FROM verdict; CREATE TEMP TABLE b AS SELECT * FROM bookmark");
        database.exec("CREATE TEMP TABLE z AS SELECT * FROM zone");
        database.exec(command);
        EXPECT_THAT(messageOf(ErrorKind::project, [&] { readReview(project_, 1); }), HasSubstr(words)) << command;
        EXPECT_FALSE(checkProject(path_).healthy()) << command;
        database.exec(
            "DELETE FROM verdict; INSERT INTO verdict SELECT * FROM v; DELETE FROM bookmark; INSERT INTO "
            "bookmark SELECT * FROM b; DELETE FROM zone; INSERT INTO zone SELECT * FROM z");
        EXPECT_TRUE(checkProject(path_).healthy()) << command;
    }
}

TEST_F(ReviewStoreTest, StepsThatDoNotFitAreRefusedAndFoundByACheck) {
    ReviewStore(project_, 1).apply(test::sampleJudging(1));
    tamper("UPDATE verdict SET note = 'another'");
    EXPECT_THAT(messageOf(ErrorKind::project, [&] { ReviewStore(project_, 1).undo(); }), HasSubstr("does not fit"));
    EXPECT_FALSE(checkProject(path_).healthy());
    tamper("UPDATE review_step SET data = x'0102'");
    EXPECT_THAT(messageOf(ErrorKind::project, [&] { ReviewStore(project_, 1).undo(); }), HasSubstr("is broken"));
    EXPECT_FALSE(checkProject(path_).healthy());
}

TEST_F(ReviewStoreTest, BytesOfStepsThatWereCutOrChangedAreNoSteps) {
    ReviewEdit edit = test::sampleJudging(3);
    edit.verdicts.push_back({test::sampleVerdict(4), std::nullopt});
    edit.verdicts.push_back({test::sampleVerdict(9), test::sampleVerdict(9)});
    edit.bookmarks.push_back({std::nullopt, test::sampleBookmark(5)});
    EXPECT_EQ(packReview(edit).front(), std::byte{1}) << "what has no zones is as it always was";
    edit.zones.push_back({test::sampleZone(6), test::sampleZone(6)});
    edit.zones.push_back({std::nullopt, test::sampleZone(7)});
    const Bytes bytes = packReview(edit);
    const auto whole = unpackReview(bytes);
    ASSERT_TRUE(whole.has_value());
    ASSERT_EQ(whole->verdicts.size(), 3U);
    EXPECT_EQ(whole->verdicts[0].after, edit.verdicts[0].after);
    EXPECT_EQ(whole->verdicts[1].before, edit.verdicts[1].before);
    EXPECT_EQ(whole->bookmarks[0].after, edit.bookmarks[0].after);
    ASSERT_EQ(whole->zones.size(), 2U);
    EXPECT_EQ(whole->zones[0].before, edit.zones[0].before);
    EXPECT_EQ(whole->zones[1].after, edit.zones[1].after);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        EXPECT_FALSE(unpackReview(ByteView(bytes).first(length)).has_value()) << length;
    }
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        Bytes changed = bytes;
        changed[at] ^= std::byte{0xff};
        unpackReview(changed);  // answers, whatever it answers
    }
}

TEST_F(ReviewStoreTest, VerdictsGoWithTheVideoAndStayWithoutTheRun) {
    const int run = test::writeSampleProject(path_, 2);
    ReviewStore(project_, 1).apply(test::sampleJudging(1));
    RunStore runs(project_);
    runs.remove(run);
    runs.purgeRemoved();
    EXPECT_EQ(readReview(project_, 1).verdicts.size(), 1U);
    SQLite::Database reader(path_.string(), SQLite::OPEN_READONLY);
    EXPECT_EQ(reader.execAndGet("SELECT judgement FROM v_verdicts").getString(), "not relevant");
    EXPECT_EQ(reader.execAndGet("SELECT count(*) FROM v_bookmarks, v_seen").getInt(), 0);
}

}  // namespace
}  // namespace eyrie::review_store_test
