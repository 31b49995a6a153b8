#include "store/labels/annotation_store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <functional>
#include <limits>
#include <random>

#include "core/error.h"
#include "store/following.h"
#include "store/labels/label_samples.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::annotation_store_test {
namespace {

using testing::HasSubstr;

class AnnotationStoreTest : public testing::Test {
 protected:
    AnnotationStoreTest() { ensureSequence(project_, test::sampleRun().sequence); }

    static void expectError(ErrorKind kind, const std::string& words, const std::function<void()>& action) {
        try {
            action();
            FAIL() << "expected an error with: " << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), kind) << error.what();
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    }

    /// Moves the first keyframe of an object.
    static AnnotationEdit moved(const LabelledObject& object, double by) {
        AnnotationEdit edit;
        edit.name = "Move box of truck " + std::to_string(object.id);
        LabelledObject after = object;
        after.keyframes.front().box.centre.x += by;
        edit.objects.push_back({object, after});
        return edit;
    }

    void damage(const std::string& command) {
        SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
        database.exec(command);
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
    ProjectFile project_ = ProjectFile::create(path_);
};

TEST_F(AnnotationStoreTest, EverythingLabelledIsThereAfterReopening) {
    AnnotationSet written;
    {
        AnnotationStore store(project_, 1);
        ASSERT_FALSE(store.readOnly()) << store.readOnlyReason();
        AnnotationEdit edit = test::sampleEdit(store.newObjectId());
        edit.objects.push_back({std::nullopt, test::sampleObject(store.newObjectId(), 300)});
        edit.regions.push_back({std::nullopt, test::sampleRegion(store.newRegionId())});
        edit.reviews = TailChange<ReviewMark>{0, {}, {test::sampleMark(1), test::sampleMark(2)}};
        edit.classes = Change<std::vector<ObjectClass>>{std::nullopt, {{{"tractor", true, 0x123456, 5.5, 2.25}}}};
        store.apply(edit);
        EXPECT_EQ(store.annotations().objects.size(), 2U);
        written = store.annotations();
    }
    ProjectFile again = ProjectFile::open(path_);
    test::expectSame(AnnotationStore(again, 1).annotations(), written);
    test::expectSame(readAnnotations(again, 1), written);
    EXPECT_TRUE(readAnnotations(again, 2).objects.empty());
}

TEST_F(AnnotationStoreTest, UndoAndRedoGoStepByStepAlsoAfterReopening) {
    std::mt19937 dice(5);
    std::vector<AnnotationSet> states;
    {
        AnnotationStore store(project_, 1);
        states.push_back(store.annotations());
        for (int step = 0; step < 60; ++step) {
            AnnotationEdit edit;
            edit.name = "step " + std::to_string(step);
            const auto& objects = store.annotations().objects;
            const unsigned kind = dice() % 5;
            if (kind == 0 || objects.empty()) {
                edit = test::sampleEdit(store.newObjectId());
            } else if (kind == 1 && objects.size() > 2) {
                edit.objects.push_back({objects.begin()->second, std::nullopt});
            } else if (kind == 2) {
                LabelledObject after = objects.rbegin()->second;
                after.keyframes.erase(after.keyframes.begin() + static_cast<int>(dice() % after.keyframes.size()));
                after.keyframes.push_back(test::sampleKeyframe(after.last_frame + 5));
                after.last_frame += 5;
                after.notes += "!";
                edit.objects.push_back({objects.rbegin()->second, after});
            } else if (kind == 3) {
                edit.reviews = TailChange<ReviewMark>{store.annotations().reviews.size(), {}, {test::sampleMark(step)}};
            } else {
                edit.regions.push_back({std::nullopt, test::sampleRegion(store.newRegionId())});
                edit.classes = Change<std::vector<ObjectClass>>{std::nullopt,
                                                                {{{"class " + std::to_string(step), false, 1, 0, 0}}}};
            }
            store.apply(edit);
            states.push_back(store.annotations());
        }
    }
    for (int round = 0; round < 2; ++round) {
        for (std::size_t step = states.size() - 1; step > 0; --step) {
            // Reopened now and then.
            ProjectFile again = ProjectFile::open(path_);
            AnnotationStore store(again, 1);
            EXPECT_EQ(store.undoCount(), static_cast<int>(step));
            EXPECT_FALSE(store.undoName().empty());
            const auto undone = store.undo();
            ASSERT_TRUE(undone.has_value());
            test::expectSame(store.annotations(), states[step - 1]);
            test::expectSame(readAnnotations(again, 1), states[step - 1]);
        }
        AnnotationStore store(project_, 1);
        EXPECT_FALSE(store.canUndo());
        EXPECT_FALSE(store.undo().has_value());
        for (std::size_t step = 1; step < states.size(); ++step) {
            ASSERT_TRUE(store.redo().has_value());
            test::expectSame(store.annotations(), states[step]);
        }
        EXPECT_FALSE(store.redo().has_value());
    }
}

TEST_F(AnnotationStoreTest, ANewStepForgetsWhatWasUndone) {
    AnnotationStore store(project_, 1);
    store.apply(test::sampleEdit(store.newObjectId()));
    store.apply(moved(store.annotations().objects.at(1), 5));
    EXPECT_EQ(store.undoName(), "Move box of truck 1");
    store.undo();
    EXPECT_EQ(store.redoName(), "Move box of truck 1");
    store.apply(moved(store.annotations().objects.at(1), 7));
    EXPECT_FALSE(store.canRedo());
    EXPECT_EQ(store.redoName(), "");
    EXPECT_EQ(store.undoCount(), 2);
    EXPECT_EQ(store.annotations().objects.at(1).keyframes[0].box.centre.x,
              test::sampleObject(1).keyframes[0].box.centre.x + 7);
}

TEST_F(AnnotationStoreTest, KeepsAtLeastFiveHundredStepsAndDropsTheOldest) {
    static_assert(kStepsKept >= 500);
    {
        AnnotationStore store(project_, 1);
        store.apply(test::sampleEdit(store.newObjectId()));
        for (int i = 0; i < kStepsKept + 20; ++i) store.apply(moved(store.annotations().objects.at(1), 1));
        EXPECT_EQ(store.undoCount(), kStepsKept);
    }
    AnnotationStore store(project_, 1);
    EXPECT_EQ(store.undoCount(), kStepsKept);
    int undone = 0;
    while (store.undo()) ++undone;
    EXPECT_EQ(undone, kStepsKept);
    EXPECT_DOUBLE_EQ(store.annotations().objects.at(1).keyframes[0].box.centre.x,
                     test::sampleObject(1).keyframes[0].box.centre.x + 20);
}

TEST_F(AnnotationStoreTest, NumbersAreNeverUsedAgain) {
    ObjectId last = 0;
    {
        AnnotationStore store(project_, 1);
        for (int i = 0; i < 3; ++i) store.apply(test::sampleEdit(last = store.newObjectId()));
        store.undo();
        AnnotationEdit deletion;
        deletion.objects.push_back({store.annotations().objects.at(2), std::nullopt});
        store.apply(deletion);
        EXPECT_GT(store.newObjectId(), last);
    }
    SequenceRecord other = test::sampleRun().sequence;
    other.path = "/videos/other.mp4";
    const int other_id = ensureSequence(project_, other);
    EXPECT_EQ(ensureSequence(project_, other), other_id);
    EXPECT_EQ(sequencesOf(project_).size(), 2U);
    AnnotationStore store(project_, other_id);
    EXPECT_GT(store.newObjectId(), last) << "of the whole project";
    // An object of another video is not taken away.
    expectError(ErrorKind::internal, "contradictory", [&] { store.apply(test::sampleEdit(1)); });
    EXPECT_TRUE(store.annotations().objects.empty());
    EXPECT_EQ(readAnnotations(project_, 1).objects.count(1), 1U);
}

TEST_F(AnnotationStoreTest, WhatDoesNotFitIsRefusedWhole) {
    AnnotationStore store(project_, 1);
    store.apply(test::sampleEdit(store.newObjectId()));
    const AnnotationSet before = store.annotations();
    const auto refused = [&](const AnnotationEdit& edit) {
        EXPECT_THROW(store.apply(edit), Error);
        test::expectSame(store.annotations(), before);
        test::expectSame(readAnnotations(project_, 1), before);
        EXPECT_EQ(store.undoCount(), 1);
    };
    AnnotationEdit edit = test::sampleEdit(2);
    edit.objects.push_back({std::nullopt, test::sampleObject(1)});
    refused(edit);  // there already
    edit = test::sampleEdit(2);
    edit.objects.push_back({test::sampleObject(3), test::sampleObject(3)});
    refused(edit);  // not there
    edit = test::sampleEdit(2);
    edit.objects[0].after->keyframes.clear();
    refused(edit);
    edit = test::sampleEdit(2);
    std::swap(edit.objects[0].after->keyframes[0], edit.objects[0].after->keyframes[1]);
    refused(edit);
    edit = test::sampleEdit(2);
    edit.objects[0].after->keyframes[1].box.length = std::numeric_limits<double>::quiet_NaN();
    refused(edit);
    edit = test::sampleEdit(2);
    edit.reviews = TailChange<ReviewMark>{5, {}, {test::sampleMark(1)}};
    refused(edit);
    edit = test::sampleEdit(2);
    edit.regions.push_back({std::nullopt, IgnoreRegion{}});
    refused(edit);
    store.apply({});
    EXPECT_EQ(store.undoCount(), 1) << "nothing done is no step";
}

TEST_F(AnnotationStoreTest, TheLabelsInTheFileCountAndNotWhatTheEditBelievesWasThere) {
    AnnotationStore store(project_, 1);
    store.apply(test::sampleEdit(store.newObjectId()));
    const AnnotationSet before = store.annotations();
    AnnotationEdit edit = moved(test::sampleObject(1, 2), 3);
    store.apply(edit);
    store.undo();
    test::expectSame(store.annotations(), before);
}

TEST_F(AnnotationStoreTest, AFailureToWriteChangesNothing) {
    AnnotationStore store(project_, 1);
    store.apply(test::sampleEdit(store.newObjectId()));
    const AnnotationSet before = store.annotations();
    {
        SQLite::Database other(path_.string(), SQLite::OPEN_READWRITE);
        const SQLite::Transaction lock(other, SQLite::TransactionBehavior::EXCLUSIVE);
        project_.database().setBusyTimeout(10);
        expectError(ErrorKind::project, "in use by another program",
                    [&] { store.apply(moved(store.annotations().objects.at(1), 9)); });
        expectError(ErrorKind::project, "in use by another program", [&] { store.undo(); });
    }
    test::expectSame(store.annotations(), before);
    EXPECT_EQ(store.undoCount(), 1);
    store.apply(moved(store.annotations().objects.at(1), 9));
    store.undo();
    test::expectSame(store.annotations(), before);
}

TEST_F(AnnotationStoreTest, DamagedLabelsAreAnErrorThatSaysWhere) {
    {
        AnnotationStore store(project_, 1);
        AnnotationEdit edit = test::sampleEdit(store.newObjectId());
        edit.regions.push_back({std::nullopt, test::sampleRegion(store.newRegionId())});
        edit.reviews = TailChange<ReviewMark>{0, {}, {test::sampleMark(1)}};
        store.apply(edit);
    }
    const std::pair<const char*, const char*> cases[] = {
        {"UPDATE labelled_object SET keyframes = x'01'", "object 1"},
        {"UPDATE labelled_object SET keyframes = x''", "keyframes"},
        {"UPDATE labelled_object SET keyframes = x'02' || substr(keyframes, 2)", "keyframes"},
        {"UPDATE labelled_object SET keyframes = substr(keyframes, 1, 100)", "keyframes"},
        {"UPDATE labelled_object SET keyframes = keyframes || substr(keyframes, 2)", "keyframes"},
        {"UPDATE labelled_object SET keyframes = zeroblob(91)", "keyframes"},
        {"UPDATE labelled_object SET origin = 'found'", "found"},
        {"UPDATE labelled_object SET last_frame = 1", "ends before it begins"},
        {"UPDATE ignore_region SET polygon = x'0100'", "polygon"},
        {"UPDATE ignore_region SET last_frame = -1", "ignore region 1"},
        {"UPDATE review_mark SET state = 'perhaps'", "perhaps"}};
    for (const auto& [command, words] : cases) {
        damage("CREATE TABLE IF NOT EXISTS kept_object AS SELECT * FROM labelled_object");
        damage("CREATE TABLE IF NOT EXISTS kept_region AS SELECT * FROM ignore_region");
        damage("CREATE TABLE IF NOT EXISTS kept_mark AS SELECT * FROM review_mark");
        damage(command);
        ProjectFile other = ProjectFile::open(path_);
        expectError(ErrorKind::project, words, [&] { AnnotationStore store(other, 1); });
        expectError(ErrorKind::project, "damaged", [&] { readAnnotations(other, 1); });
        damage(
            "DELETE FROM labelled_object; INSERT INTO labelled_object SELECT * FROM kept_object;"
            "DELETE FROM ignore_region; INSERT INTO ignore_region SELECT * FROM kept_region;"
            "DELETE FROM review_mark; INSERT INTO review_mark SELECT * FROM kept_mark");
    }
}

TEST_F(AnnotationStoreTest, ADamagedJournalStopsUndoAndNothingElse) {
    AnnotationStore store(project_, 1);
    store.apply(test::sampleEdit(store.newObjectId()));
    store.apply(moved(store.annotations().objects.at(1), 4));
    const AnnotationSet before = store.annotations();
    for (const char* command :
         {"UPDATE edit_journal SET data = x'01ffffffff'", "UPDATE edit_journal SET data = x''",
          "UPDATE edit_journal SET data = (SELECT data || x'00' FROM edit_journal WHERE id = 1)"}) {
        damage(command);
        expectError(ErrorKind::project, "Move box of truck 1", [&] { store.undo(); });
        test::expectSame(store.annotations(), before);
    }
    store.apply(moved(store.annotations().objects.at(1), 4));
    EXPECT_TRUE(store.undo().has_value());
    test::expectSame(store.annotations(), before);
}

TEST_F(AnnotationStoreTest, ASecondWindowReadsAndSaysWhy) {
    auto first = std::make_unique<AnnotationStore>(project_, 1);
    first->apply(test::sampleEdit(first->newObjectId()));
    ProjectFile other = ProjectFile::open(path_);
    AnnotationStore second(other, 1);
    EXPECT_TRUE(second.readOnly());
    EXPECT_THAT(second.readOnlyReason(), HasSubstr("process " + std::to_string(getpid())));
    expectError(ErrorKind::output, "are read-only", [&] { second.apply(test::sampleEdit(9)); });
    expectError(ErrorKind::output, "are read-only", [&] { second.undo(); });
    // It follows the first.
    EXPECT_FALSE(test::follows(second, path_));
    first->apply(moved(first->annotations().objects.at(1), 2));
    EXPECT_TRUE(test::follows(second, path_));
    test::expectSame(second.annotations(), first->annotations());
    EXPECT_FALSE(second.tryToWrite());
    first.reset();
    EXPECT_TRUE(second.tryToWrite());
    EXPECT_EQ(second.readOnlyReason(), "");
    EXPECT_TRUE(second.undo().has_value());
    EXPECT_TRUE(AnnotationStore(project_, 1).readOnly());
}

TEST_F(AnnotationStoreTest, AProjectOpenForReadingIsRead) {
    AnnotationStore(project_, 1).apply(test::sampleEdit(1));
    ProjectFile other = ProjectFile::open(path_, ProjectFile::Mode::read_only);
    AnnotationStore store(other, 1);
    EXPECT_TRUE(store.readOnly());
    EXPECT_THAT(store.readOnlyReason(), HasSubstr("open for reading only"));
    EXPECT_EQ(store.annotations().objects.size(), 1U);
    EXPECT_FALSE(AnnotationStore(project_, 1).readOnly()) << "a reader holds nobody up";
}

TEST_F(AnnotationStoreTest, NothingStaysBesideTheProject) {
    { AnnotationStore store(project_, 1); }
    EXPECT_FALSE(std::filesystem::exists(path_.string() + ".labelling"));
}

}  // namespace
}  // namespace eyrie::annotation_store_test
