#include "session/project/project_copy.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <QTest>

#include "store/labels/annotation_store.h"
#include "store/review/seen_store.h"
#include "support/temporary_folder.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::project_copy_test {

namespace {

/// A person who draws an object at the moment when something of a copy is there.
class LabelsMeanwhile {
 public:
    LabelsMeanwhile(ProjectFile& project, const std::filesystem::path& target) : project_(project), target_(target) {
        sqlite3_progress_handler(project_.database().getHandle(), 20, &LabelsMeanwhile::step, this);
    }
    ~LabelsMeanwhile() { sqlite3_progress_handler(project_.database().getHandle(), 0, nullptr, nullptr); }
    LabelsMeanwhile(const LabelsMeanwhile&) = delete;
    LabelsMeanwhile& operator=(const LabelsMeanwhile&) = delete;
    bool done() const { return done_; }

 private:
    static int step(void* self) {
        static_cast<LabelsMeanwhile*>(self)->drawOnce();
        return 0;
    }
    bool isBegun() const {
        for (const auto& entry : std::filesystem::directory_iterator(target_.parent_path()))
            if (entry.path().filename().string().starts_with(target_.filename().string())) return true;
        return false;
    }
    void drawOnce() {
        if (done_ || !isBegun()) return;
        done_ = true;
        ProjectFile file = ProjectFile::open(project_.path());
        AnnotationStore store(file, sequencesOf(file).front().id);
        LabelledObject object;
        object.id = store.newObjectId();
        object.object_class = "car";
        object.keyframes.resize(1);
        object.keyframes.front().box = {{40, 30}, 20, 10, 0};
        AnnotationEdit edit;
        edit.name = "Draw car 1";
        edit.objects.push_back({std::nullopt, object});
        store.apply(edit);
    }

    ProjectFile& project_;
    std::filesystem::path target_;
    bool done_ = false;
};

}  // namespace

/// Copies of a project in which somebody works.
class ProjectCopyTest : public QObject {
    Q_OBJECT

 private slots:
    void whoGoesOnInTheCopyHasWhatWasDoneWhileItWasWritten() {
        const eyrie::test::TemporaryFolder folder;
        ProjectFile project = ProjectFile::openOrCreate(folder / "clip.eyrie");
        SequenceRecord sequence;
        sequence.path = "/nowhere/clip.mp4";
        sequence.size = {160, 120};
        sequence.frame_count = 10;
        const int id = ensureSequence(project, sequence);
        const std::filesystem::path target = folder / "other.eyrie";
        {
            const LabelsMeanwhile person(project, target);
            copyProject(project, target, StepsMeanwhile::copied_too);
            QVERIFY(person.done());
        }
        ProjectFile copy = ProjectFile::open(target);
        QCOMPARE(readAnnotations(copy, id).objects.size(), std::size_t(1));
    }

    void whatIsDoneBetweenTheCopyAndItsUseIsInItToo() {
        const eyrie::test::TemporaryFolder folder;
        ProjectFile project = ProjectFile::openOrCreate(folder / "clip.eyrie");
        SequenceRecord sequence;
        sequence.path = "/nowhere/clip.mp4";
        sequence.size = {160, 120};
        sequence.frame_count = 10;
        const int id = ensureSequence(project, sequence);
        const std::filesystem::path target = folder / "other.eyrie";
        {
            ProjectMove move(project, target);
            QVERIFY(!std::filesystem::exists(target));
            ProjectFile elsewhere = ProjectFile::open(folder / "clip.eyrie");
            addSeen(elsewhere, id, "Ada", {{2, 4}});  // by another connection
            SequenceRecord second = sequence;
            second.path = "/nowhere/second.mp4";
            ensureSequence(project, second);  // and by the one that copies
            move.finish();
        }
        ProjectFile copy = ProjectFile::open(target);
        QCOMPARE(seenByAnybody(copy, id).size(), std::size_t(1));
        QCOMPARE(sequencesOf(copy).size(), std::size_t(2));

        const std::filesystem::path unused = folder / "unused.eyrie";
        { const ProjectMove move(project, unused); }
        for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
            QVERIFY(!entry.path().filename().string().starts_with("unused"));
    }
};

}  // namespace eyrie::ui::project_copy_test

EYRIE_UI_TEST(QCoreApplication, project_copy_test, ProjectCopyTest)
#include "project_copy_test.moc"
