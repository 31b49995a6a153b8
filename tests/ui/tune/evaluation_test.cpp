#include <QDockWidget>
#include <QFile>
#include <QSignalSpy>
#include <QTableView>
#include <QTableWidget>
#include <QTest>
#include <QThread>
#include <cmath>
#include <fstream>

#include "canvas/layers/track_layer.h"
#include "canvas/layers/verdict_layer.h"
#include "canvas/video_view.h"
#include "label/label_workspace.h"
#include "store/labels/annotation_store.h"
#include "store/runs/result_writer.h"
#include "tune/evaluate/errors_panel.h"
#include "tune/evaluate/evaluation_panel.h"
#include "tune/evaluate/evaluation_wording.h"
#include "tune/inspect/why_panel.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "widgets/charts/line_chart.h"
#include "widgets/charts/tracked_bar.h"
#include "widgets/message_bar.h"
#include "widgets/tables/table_roles.h"
#include "window/docks/evaluation_docks.h"
#include "window/docks/tuning.h"
#include "window/main_window.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"
#include "workspace/workspaces.h"

namespace eyrie::ui::evaluation_test {

using test::kPatience_ms;

namespace {
constexpr int kFrames = 20;

/// The box that a true car has in a frame; `car` 0 or 1.
OrientedBox truth(int car, int frame) {
    return {{30.0 + 3 * frame + 70 * car, 55.0 + 60 * car}, 22, 11, 0};
}
}  // namespace

/// Evaluation and list of errors over a folder of images, with a run whose errors are known: car 0 is missed from frame
/// 12 on and has another track from frame 8 on; nothing is at (200, 20), where track 9 says so in frames 3 to 6.
class EvaluationTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, kPatience_ms); }

    std::filesystem::path project() const { return *home_ / "p.eyrie"; }
    void makeProject(bool with_labels) const {
        const auto images = test::writeScene(*home_ / "images", kFrames);
        ProjectFile::openOrCreate(project());
        for (const bool better : {false, true}) {
            RunRecord run;
            run.sequence = {.path = images.string(), .size = {240, 180}, .frame_count = kFrames, .frame_rate_hz = 25};
            run.last_frame = kFrames - 1;
            ResultWriter writer(project(), run, {});
            for (int frame = 0; frame < kFrames; ++frame) {
                FrameResult result;
                result.motion.frame = frame;
                result.motion.image_size = {240, 180};
                auto& registration = result.motion.registration;
                registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
                registration.current_from_previous.from_frame = std::max(0, frame - 1);
                registration.current_from_previous.to_frame = frame;
                const auto track = [&](int id, const OrientedBox& box) {
                    TrackState state;
                    state.id = id;
                    state.box = box;
                    state.status = TrackStatus::confirmed;
                    state.score = id == 9 ? 0.1 : 0.9;
                    result.tracks.push_back(state);
                };
                if (frame < 12 || better) track(frame < 8 || better ? 1 : 3, truth(0, frame));
                track(2, truth(1, frame));
                if (frame >= 3 && frame <= 6 && !better) track(9, {{200, 20}, 22, 11, 0});
                writer.write(result);
            }
            writer.finish(RunState::finished, "");
        }
        if (!with_labels) return;
        ProjectFile opened = ProjectFile::open(project());
        AnnotationStore store(opened, sequencesOf(opened).front().id);
        AnnotationEdit edit;
        edit.name = "draw";
        for (const int car : {0, 1}) {
            LabelledObject object;
            object.id = store.newObjectId();
            object.keyframes = {{.frame = 0, .box = truth(car, 0)},
                                {.frame = kFrames - 1, .box = truth(car, kFrames - 1)}};
            object.last_frame = kFrames - 1;
            edit.objects.push_back({std::nullopt, object});
        }
        store.apply(edit);
    }
    QString truthFile(int first = 0) const {
        const auto path = *home_ / "truth.csv";
        std::ofstream file(path);
        file << "frame,id,x,y,length,width,heading,class,ignore\n";
        for (int frame = 0; frame < kFrames; ++frame)
            for (const int car : {0, 1})
                file << frame + first << ',' << car + 1 << ',' << truth(car, frame).centre.x << ','
                     << truth(car, frame).centre.y << ",22,11,0,car,0\n";
        return QString::fromStdString(path.string());
    }
    /// A window that shows the first run, with the docks in front.
    std::unique_ptr<MainWindow> evaluatingWindow(bool with_labels = true) const {
        makeProject(with_labels);
        auto window = std::make_unique<MainWindow>();
        window->resize(1400, 900);
        window->show();
        QSignalSpy ready(&window->session(), &ProjectSession::ready);
        window->session().open(project());
        if (!ready.wait(kPatience_ms)) return nullptr;
        window->session().showRun(1);
        window->workspaces().open(WorkspaceKind::tune);
        for (const DockId id : {DockId::evaluation, DockId::errors}) window->docks().raise(id);
        EvaluationSession& evaluation = window->evaluation().evaluation();
        const bool answered = waitFor([&] { return evaluation.evaluation() || !evaluation.obstacle().isEmpty(); });
        return answered ? std::move(window) : nullptr;
    }
    static int rows(const ErrorsPanel& panel) { return panel.table()->model()->rowCount(); }
    static QString cell(const ErrorsPanel& panel, int row, int column) {
        return panel.table()->model()->index(row, column).data().toString();
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void aRunIsMeasuredAgainstTheLabels() {
        const auto window = evaluatingWindow();
        QVERIFY(window);
        EvaluationPanel& panel = window->evaluation().panel();
        QCOMPARE(panel.explanation(), QString());
        QCOMPARE(panel.table().columnCount(), 3);
        QStringList names;
        for (int row = 0; row < panel.table().rowCount(); ++row) names << panel.table().verticalHeaderItem(row)->text();
        QCOMPARE(panel.table().item(static_cast<int>(names.indexOf(QStringLiteral("FN"))), 0)->text(),
                 QStringLiteral("8"));
        QCOMPARE(panel.table().item(static_cast<int>(names.indexOf(QStringLiteral("FP"))), 0)->text(),
                 QStringLiteral("4"));
        QVERIFY(names.contains(QStringLiteral("HOTA")) && names.contains(QStringLiteral("IDF1")));
        QVERIFY(panel.headline().contains(QStringLiteral("MOTA")));
        QCOMPARE(panel.tracked().shares().size(), std::size_t{2});
        QCOMPARE(panel.tracked().shares()[1].found, 12);
        QCOMPARE(panel.counts().data().places.size(), static_cast<std::size_t>(kFrames));
        QCOMPARE(panel.counts().data().series[1].values[15], 1.0);
        QVERIFY(panel.counts().data().text().startsWith(QStringLiteral("frame\tfound\tmissed\tfalse\n")));
        // Without the false track, which has the lowest score, nothing is false and as much is found.
        QVERIFY(waitFor([&] { return panel.scoreCurve().data().places.size() == 2; }));
        const LineData& curve = panel.scoreCurve().data();
        QCOMPARE(curve.places[0], curve.places[1]);
        QCOMPARE(curve.series[0].values[0], 1.0);
        QVERIFY(curve.series[0].values[1] < 0.95);
        QVERIFY(std::abs(curve.series[2].values[0] - 0.9) < 1e-9);
        QVERIFY(!panel.scoreCurve().isHidden());
        // Without an evaluation there is none of a former one.
        EvaluationSettings settings = window->evaluation().evaluation().settings();
        settings.truth_file = *home_ / "nowhere.csv";
        window->evaluation().evaluation().setSettings(settings);
        QVERIFY(waitFor([&] { return !panel.explanation().isEmpty() && panel.scoreCurve().isHidden(); }));
    }

    void whyThereIsNoCurveOverTheScoreIsTold() {
        const auto window = evaluatingWindow();
        QVERIFY(window);
        EvaluationPanel& panel = window->evaluation().panel();
        QVERIFY(waitFor([&] { return panel.scoreCurve().data().places.size() == 2; }));
        // What the run left out is read from the project, which is gone; the rest is still known.
        EvaluationSettings settings = window->evaluation().evaluation().settings();
        std::filesystem::rename(project(), *home_ / "moved.eyrie");
        settings.wishes.overlap = 0.45;
        window->evaluation().evaluation().setSettings(settings);
        QVERIFY(waitFor([&] { return test::says(panel, QStringLiteral("No curve by score: ")); }));
        QVERIFY(panel.scoreCurve().isHidden());
    }

    void everyErrorIsListedWithItsCause() {
        const auto window = evaluatingWindow();
        QVERIFY(window);
        ErrorsPanel& errors = window->evaluation().errors();
        QCOMPARE(rows(errors), 4);  // false alarm, switch, miss, fragment
        errors.setShownKind(QStringLiteral("miss"));
        QCOMPARE(rows(errors), 1);
        QCOMPARE(cell(errors, 0, ErrorsModel::frame_column), QStringLiteral("12–19"));
        QCOMPARE(cell(errors, 0, ErrorsModel::count_column), QStringLiteral("8"));
        QCOMPARE(cell(errors, 0, ErrorsModel::cause_column), QStringLiteral("no corners"));
        errors.setShownKind({});
        errors.setShownCause(QStringLiteral("no corners"));
        QCOMPARE(rows(errors), 2);  // the fragment has the cause of its miss
        errors.setShownCause({});
        QVERIFY(waitFor([&] { return errors.rowsWithoutChip().isEmpty(); }));
    }

    void oneKeyGoesFromErrorToError() {
        const auto window = evaluatingWindow();
        QVERIFY(window);
        ErrorsPanel& errors = window->evaluation().errors();
        window->canvas().setFocus();
        QTest::keyClick(window.get(), Qt::Key_F8);
        QCOMPARE(errors.currentId(), 1);
        QVERIFY(waitFor([&] { return window->canvas().frame().index >= 3 && window->canvas().frame().index <= 6; }));
        const QPointF middle = window->canvas().transform().imageFromView(
            QPointF(window->canvas().width() / 2.0, window->canvas().height() / 2.0));
        QVERIFY(std::abs(middle.x() - 200) < 1 && std::abs(middle.y() - 20) < 1);
        QVERIFY(errors.status().contains(QStringLiteral("false alarm")));
        QTest::keyClick(window.get(), Qt::Key_F8);
        QCOMPARE(errors.currentId(), 2);
        QTest::keyClick(window.get(), Qt::Key_F8, Qt::ShiftModifier);
        QTest::keyClick(window.get(), Qt::Key_F8, Qt::ShiftModifier);
        QCOMPARE(errors.currentId(), 4);  // round to the last one
    }

    void theCanvasShowsFoundMissedAndFalse() {
        const auto window = evaluatingWindow();
        QVERIFY(window);
        const EvaluationSession& evaluation = window->evaluation().evaluation();
        const auto kinds = [&](FrameIndex frame) {
            QList<int> counts(kVerdictKinds, 0);
            for (const VerdictMark& mark : evaluation.marksAt(frame)) ++counts[static_cast<int>(mark.kind)];
            return counts;
        };
        QCOMPARE(kinds(4), (QList<int>{2, 0, 1, 0, 0, 0}));
        QCOMPARE(kinds(8), (QList<int>{1, 0, 0, 1, 0, 0}));
        QCOMPARE(kinds(12), (QList<int>{1, 0, 0, 0, 1, 0}));
        QCOMPARE(kinds(15), (QList<int>{1, 1, 0, 0, 0, 0}));
        QVERIFY(evaluation.marksAt(99).empty());

        window->session().goToFrame(4);
        QVERIFY(waitFor([&] { return window->canvas().frame().index == 4 && window->canvas().frame().evaluated; }));
        const QColor wanted = verdictColour(VerdictKind::false_alarm, PaletteKind::thesis);
        const auto drawn = [&] {
            const QImage picture = window->canvas().picture();
            for (int y = 0; y < picture.height(); ++y)
                for (int x = 0; x < picture.width(); ++x)
                    if (picture.pixelColor(x, y).rgb() == wanted.rgb()) return true;
            return false;
        };
        QVERIFY(drawn());
        QTest::keyClick(window.get(), Qt::Key_Q, Qt::AltModifier);
        QVERIFY(!drawn());
    }

    void theOtherOverlaysComeBack() {
        const auto window = evaluatingWindow();
        QVERIFY(window);
        QVERIFY(!window->overlays().isVisible(TrackLayer::kKind));
        QVERIFY(window->overlays().style().detail.labels);
        QTest::keyClick(window.get(), Qt::Key_B, Qt::AltModifier);
        for (const DockId id : {DockId::evaluation, DockId::errors}) window->docks().dock(id)->hide();
        QVERIFY(window->overlays().isVisible(TrackLayer::kKind));
        QVERIFY(window->overlays().isVisible(VerdictLayer::kKind));
        QVERIFY(!window->overlays().style().detail.labels);
    }

    void aPreviewIsSeenThoughErrorsAreLookedAt() {
        const auto window = evaluatingWindow();
        QVERIFY(window);
        QVERIFY(!window->overlays().isVisible(TrackLayer::kKind));
        window->evaluation().setPreviewed(true);
        QVERIFY2(window->overlays().isVisible(TrackLayer::kKind),
                 "verdicts are of the stored run: nothing would be seen");
        window->evaluation().setPreviewed(false);
        QVERIFY(!window->overlays().isVisible(TrackLayer::kKind));
        QVERIFY(window->overlays().isVisible(VerdictLayer::kKind));
    }

    void fullScreenLeavesErrorsAloneAndOverlaysHidden() {
        const auto window = evaluatingWindow();
        QVERIFY(window);
        const WindowActions& actions = window->actions();
        const auto errorsAlone = [&] {
            return window->overlays().isVisible(VerdictLayer::kKind) &&
                   !window->overlays().isVisible(TrackLayer::kKind);
        };
        QVERIFY(errorsAlone());
        actions.full_screen->trigger();
        QVERIFY(window->isFullScreen());
        QVERIFY2(errorsAlone(), "no dock is seen, but nobody left them");
        actions.hide_overlays->trigger();
        QVERIFY(!window->overlays().isDrawn(VerdictLayer::kKind));
        actions.full_screen->trigger();
        QVERIFY(!window->isFullScreen());
        QVERIFY2(actions.hide_overlays->isChecked(), "what a key has hidden stays so");
        actions.hide_overlays->trigger();
        QVERIFY(errorsAlone());
        for (const DockId id : {DockId::evaluation, DockId::errors}) window->docks().dock(id)->hide();
        QVERIFY(window->overlays().isVisible(TrackLayer::kKind));
    }

    void anErrorIsAskedWhy() {
        const auto window = evaluatingWindow();
        QVERIFY(window);
        ErrorsPanel& errors = window->evaluation().errors();
        Why& why = window->tuning().why();
        const auto& listed = window->evaluation().evaluation().evaluation()->errors;
        const auto askAt = [&](ResultErrorKind kind, bool by_key) {
            for (std::size_t i = 0; i < listed.size(); ++i) {
                if (listed[i].error.kind != kind) continue;
                const ErrorPlace place = listed[i].error.places[listed[i].place];
                window->session().goToFrame(0);
                if (by_key) {
                    errors.commands().go_to(static_cast<int>(i) + 1);
                    window->session().goToFrame(0);
                    QTest::keyClick(window.get(), Qt::Key_W, Qt::ControlModifier | Qt::ShiftModifier);
                } else {
                    errors.commands().ask_why(static_cast<int>(i) + 1);
                }
                return waitFor([&] { return why.view() && why.view()->frame == place.frame; }) &&
                       why.area()->centre == place.box.centre &&
                       waitFor([&] { return window->session().viewFrame().index == place.frame; });
            }
            return false;
        };
        QVERIFY(askAt(ResultErrorKind::miss, false));
        QVERIFY(!why.view()->told.found);
        QVERIFY(askAt(ResultErrorKind::false_alarm, true));
        QVERIFY(why.view()->told.found);
        QVERIFY(window->tuning().whyPanel().isVisible());
    }

    void aWrongTruthIsCorrectedAndScoredAgain() {
        const auto window = evaluatingWindow();
        QVERIFY(window);
        ErrorsPanel& errors = window->evaluation().errors();
        EvaluationSession& evaluation = window->evaluation().evaluation();
        int miss = 0;
        for (int row = 0; row < rows(errors); ++row)
            if (cell(errors, row, ErrorsModel::kind_column) == QStringLiteral("miss"))
                miss = errors.table()->model()->index(row, 0).data(id_role).toInt();
        errors.commands().go_to(miss);
        QTest::keyClick(window.get(), Qt::Key_T, Qt::ControlModifier);
        LabelSession& labels = window->labelling().labels();
        QVERIFY(waitFor([&] { return labels.isOpen() && labels.selected() == 1; }));
        QVERIFY(window->labelling().active());
        QVERIFY(window->session().currentFrame() >= 12);
        // The truth is wrong: the car left in frame 11.
        LabelledObject shorter = *labels.object(1);
        shorter.keyframes.back().frame = 11;
        shorter.keyframes.back().box = truth(0, 11);
        shorter.last_frame = 11;
        AnnotationEdit edit;
        edit.name = "end";
        edit.objects.push_back({*labels.object(1), shorter});
        QElapsedTimer clock;
        clock.start();
        QVERIFY(labels.apply(edit));
        QVERIFY(waitFor(
            [&] { return evaluation.evaluation() && evaluation.evaluation()->shown.detection.false_negatives == 0; }));
        qInfo("scored again after %lld ms", static_cast<long long>(clock.elapsed()));
        QVERIFY(errors.status().contains(QStringLiteral("Scored again")));
    }

    void aFileIsNotChangedButTheRemedyIsTold() {
        const auto window = evaluatingWindow(false);
        QVERIFY(window);
        // Without labels the panel says what to do, and names no path: video and project are those that are shown.
        const QString todo = window->evaluation().panel().explanation();
        QVERIFY2(todo.contains(QStringLiteral("Draw or import")) && !todo.contains(QLatin1Char('/')), qPrintable(todo));
        EvaluationSession& evaluation = window->evaluation().evaluation();
        window->evaluation().panel().useTruthFile(truthFile());
        QVERIFY(waitFor([&] { return evaluation.evaluation() != nullptr; }));
        QCOMPARE(evaluation.evaluation()->shown.detection.false_negatives, 8);
        window->evaluation().step(1);
        window->evaluation().correctTruth();
        QVERIFY(window->messages().texts().front().contains(QStringLiteral("Import it")));
        QVERIFY(!window->labelling().active());
        // No frame in common.
        window->evaluation().panel().useTruthFile({});
        window->evaluation().panel().useTruthFile(truthFile(500));
        QVERIFY(waitFor([&] { return !evaluation.working() && evaluation.evaluation() == nullptr; }));
        QVERIFY(window->evaluation().panel().explanation().contains(QStringLiteral("holds no box in the frames")));
    }

    void anotherRunTellsWhetherTheDifferenceIsReal() {
        const auto window = evaluatingWindow();
        QVERIFY(window);
        EvaluationSession& evaluation = window->evaluation().evaluation();
        EvaluationSettings settings = evaluation.settings();
        settings.other_run = 2;
        evaluation.setSettings(settings);
        QVERIFY(waitFor([&] { return evaluation.evaluation() && evaluation.evaluation()->difference; }));
        QVERIFY(evaluation.evaluation()->difference->difference.f_score.value < 0);
        QVERIFY(window->evaluation().panel().headline().contains(QStringLiteral("against run 2")));
    }

    void reportsAreWrittenOrSayWhyNot() {
        const auto window = evaluatingWindow();
        QVERIFY(window);
        const auto told = [&](const QString& words) {
            const QStringList texts = window->messages().texts();
            return !texts.isEmpty() && texts.front().contains(words);
        };
        const auto at = [this](const char* name) { return QString::fromStdString((*home_ / name).string()); };
        window->evaluation().writeReport(at("r.html"));
        QVERIFY(waitFor([&] { return told(at("r.html")); }));
        QFile html(at("r.html"));
        QVERIFY(html.open(QIODevice::ReadOnly));
        QVERIFY(html.readAll().contains("data:image/png;base64"));
        window->evaluation().writeReport(at("r.pdf"));
        QVERIFY(waitFor([&] { return told(at("r.pdf")); }));
        QFile pdf(at("r.pdf"));
        QVERIFY(pdf.open(QIODevice::ReadOnly));
        QVERIFY(pdf.read(5) == "%PDF-" && pdf.size() > 10'000);
        for (const char* name : {"no/where/r.pdf", "no/where/r.html"}) {
            window->evaluation().writeReport(at(name));
            QVERIFY(waitFor([&] { return told(QString::fromUtf8(name)); }));
        }
    }

    void windowsOfFramesHaveRatios() {
        const std::vector<FrameCounts> frames{{0, 1, 1, 0}, {1, 1, 0, 1}, {2, 0, 0, 0}, {3, 0, 0, 0}, {4, 0, 0, 0}};
        const WindowedRatios ratios = windowedRatios(frames, 3);
        QCOMPARE(ratios.precision[0], 2.0 / 3);  // frames 0 and 1
        QCOMPARE(ratios.recall[0], 2.0 / 3);
        QCOMPARE(ratios.precision[2], 0.5);  // frames 1 to 3
        QCOMPARE(ratios.recall[2], 1.0);
        QVERIFY(std::isnan(ratios.recall[4]));
    }
};

}  // namespace eyrie::ui::evaluation_test

EYRIE_UI_TEST(QApplication, evaluation_test, EvaluationTest)
#include "evaluation_test.moc"
