#include <QSignalSpy>
#include <QTest>
#include <fstream>

#include "scoring/scoring.h"
#include "store/labels/annotation_store.h"
#include "tune/evaluate/evaluation_session.h"
#include "tune/sweep/sweep_session.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::one_score_test {

using test::kPatience_ms;

namespace {

constexpr int kFrames = 24;

/// Measures by their keys in files.
using Figures = std::map<std::string, double>;

Figures figuresOf(const std::function<std::optional<double>(const std::string&)>& valueOf) {
    Figures figures;
    for (const char* key : {"tp", "fp", "fn", "f_score", "mota"}) figures[key] = valueOf(key).value_or(-1);
    return figures;
}

Figures figuresOf(const Measures& measures) {
    return figuresOf([&](const std::string& key) {
        for (const NamedMeasure& measure : listMeasures(measures))
            if (measure.key == key) return measure.value;
        return std::optional<double>();
    });
}

/// The box around a vehicle of the scene.
OrientedBox vehicleIn(int frame, int vehicle) {
    return {{30.5 + 3 * frame + 70 * vehicle, 55.0 + 60 * vehicle}, 22, 11, 0};
}

}  // namespace

/// A window shows one score for one run: the docks Evaluation and Sweeps have the figures of the room scoring.
class OneScoreTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    /// A format that cannot turn boxes.
    std::filesystem::path motFile() const {
        std::ofstream file(*home_ / "gt.txt");
        for (int frame = 0; frame < kFrames; ++frame) {
            for (const int vehicle : {0, 1}) {
                const OrientedBox box = vehicleIn(frame, vehicle);
                file << frame + 1 << ',' << vehicle + 1 << ',' << box.centre.x - 9.5 << ',' << box.centre.y - 4
                     << ",22,11,1,3,1\n";
            }
        }
        return *home_ / "gt.txt";
    }
    static void label(const std::filesystem::path& project) {
        ProjectFile file = ProjectFile::open(project);
        AnnotationStore store(file, sequencesOf(file).front().id);
        AnnotationEdit edit;
        edit.name = "draw";
        for (const int vehicle : {0, 1}) {
            LabelledObject object;
            object.id = store.newObjectId();
            object.object_class = "car";
            object.keyframes = {{.frame = 0, .box = vehicleIn(0, vehicle)},
                                {.frame = kFrames - 1, .box = vehicleIn(kFrames - 1, vehicle)}};
            object.last_frame = kFrames - 1;
            edit.objects.push_back({std::nullopt, object});
        }
        store.apply(edit);
    }
    static Figures scored(const ProjectSession& session, const std::filesystem::path& truth_file, bool& upright) {
        ProjectFile file = ProjectFile::open(session.project(), ProjectFile::Mode::read_only);
        const RunStore store(file);
        const RunRecord run = store.run(*session.currentRun()).value();
        EvaluationOptions wishes = storedWishes();
        wishes.image_size = run.sequence.size;
        const Scoring scoring = scoringOf(readGroundTruth({truth_file}, file, run), wishes, coveredFrames(run));
        upright = scoring.options.upright;
        return figuresOf(evaluate(scoring.truth.boxes, store.trackBoxes(run.id), scoring.options));
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void bothDocksHaveTheFiguresOfScoring_data() {
        QTest::addColumn<bool>("of_labels");
        QTest::newRow("labels of the project") << true;
        QTest::newRow("a file without headings") << false;
    }
    void bothDocksHaveTheFiguresOfScoring() {
        QFETCH(bool, of_labels);
        ProjectSession session;
        QVERIFY(test::openAndWait(session, videoMedia(test::writeScene(*home_ / "images", kFrames))));
        session.settings().options.detection.method = DetectionMethod::gradient;
        QVERIFY(test::runAndWait(session));
        QTRY_VERIFY_WITH_TIMEOUT(session.runData() && session.currentRun(), kPatience_ms);
        if (of_labels) label(session.project());
        const std::filesystem::path truth_file = of_labels ? std::filesystem::path() : motFile();
        EvaluationSession evaluation(session);
        EvaluationSettings settings = evaluation.settings();
        settings.truth_file = truth_file;
        if (of_labels) settings.wishes.border = 12;
        settings.wishes.vehicles_only = true;
        evaluation.setSettings(settings);
        bool upright = false;
        const Figures expected = scored(session, truth_file, upright);
        QVERIFY(expected.at("tp") > 10);
        QCOMPARE(upright, !of_labels);

        evaluation.setWanted(true);
        QTRY_VERIFY_WITH_TIMEOUT(evaluation.evaluation() || !evaluation.obstacle().isEmpty(), kPatience_ms);
        QCOMPARE(evaluation.obstacle(), QString());
        QCOMPARE(figuresOf(evaluation.evaluation()->shown), expected);

        SweepSession sweeps(session);
        SweepRequest request;
        request.truth_file = truth_file;
        request.wishes = storedWishes();
        for (const auto& [name, value] : evaluation.evaluation()->parameters)
            if (name == "gradient.quantile") request.axes = {name + "=" + value};
        request.overlaps = {settings.wishes.overlap};
        QSignalSpy finished(&sweeps, &SweepSession::finished);
        QSignalSpy failed(&sweeps, &SweepSession::failed);
        sweeps.start(request);
        QTRY_VERIFY_WITH_TIMEOUT(!finished.isEmpty() || !failed.isEmpty(), kPatience_ms);
        QVERIFY2(failed.isEmpty(), qPrintable(failed.isEmpty() ? QString() : failed.first().first().toString()));
        for (const SweepFigures& figures : sweeps.table()->points.at(0)) {
            if (figures.tracks) QCOMPARE(figuresOf([&](const std::string& key) { return figures.at(key); }), expected);
        }
    }
};

}  // namespace eyrie::ui::one_score_test

EYRIE_UI_TEST(QApplication, one_score_test, OneScoreTest)
#include "one_score_test.moc"
