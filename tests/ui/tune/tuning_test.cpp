#include "window/docks/tuning.h"

#include <QCheckBox>
#include <QDockWidget>
#include <QSignalSpy>
#include <QSlider>
#include <QTableWidget>
#include <QTest>
#include <fstream>

#include "canvas/layers/stages/detection_layer.h"
#include "canvas/layers/track_layer.h"
#include "canvas/video_view.h"
#include "canvas/wipe_split.h"
#include "store/labels/annotation_store.h"
#include "tune/compare/comparison_header.h"
#include "tune/compare/comparison_window.h"
#include "tune/compare/preview_bar.h"
#include "tune/inspect/why_panel.h"
#include "tune/parameters/preset_dialog.h"
#include "tune/train/training_dialog.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "widgets/charts/sweep_chart.h"
#include "widgets/parameters/parameter_form.h"
#include "widgets/parameters/parameter_row.h"
#include "window/docks/review_docks.h"
#include "window/main_window.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::tuning_test {

using test::kPatience_ms;

class TuningTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;
    std::unique_ptr<MainWindow> window_;

    static bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, kPatience_ms); }
    ProjectSession& session() { return window_->session(); }
    Tuning& tuning() { return window_->tuning(); }
    LivePreview& preview() { return tuning().preview(); }

    /// A window that shows frame 40 of a finished run.
    bool showRun() {
        window_ = std::make_unique<MainWindow>();
        window_->resize(1200, 800);
        window_->show();
        QSignalSpy ready(&session(), &ProjectSession::ready);
        session().openMedia(test::sceneUnderTest(60));
        if (!ready.wait(kPatience_ms)) return false;
        session().settings().gsd_m_per_px = 0.25;
        session().settings().options.view.oblique = false;
        QSignalSpy finished(&session(), &ProjectSession::runFinished);
        session().startRun();
        if (!finished.wait(kPatience_ms)) return false;
        session().goToFrame(40);
        return waitFor(
            [&] { return session().viewFrame().index == 40 && session().viewFrame().result && session().runData(); });
    }
    ParameterRow* row(const char* name) {
        for (auto* row : window_->review().parameterForm().findChildren<ParameterRow*>())
            if (row->name() == QLatin1String(name)) return row;
        return nullptr;
    }
    void slide(const char* name, int steps) {
        auto* slider = row(name)->findChild<QSlider*>();
        slider->setValue(slider->value() + steps);
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() {
        window_.reset();
        home_.reset();
    }

    void whyIsAnsweredWithTheStepsAndALinkToTheParameter() {
        QVERIFY(showRun());
        QVERIFY(tuning().whyPanel().explanation().contains(QStringLiteral("context menu of a place")));
        QVERIFY(!session().viewFrame().result->tracks.empty());
        const cv::Point2d centre = session().viewFrame().result->tracks.front().box.centre;
        tuning().askWhy(QPointF(centre.x, centre.y), 2);
        QVERIFY(waitFor([&] { return tuning().why().view() && !tuning().why().waiting(); }));
        QVERIFY(tuning().why().view()->told.found);
        QVERIFY(tuning().whyPanel().text().contains(QStringLiteral(" is here: ")));
        QVERIFY(tuning().whyPanel().text().contains(QStringLiteral("clustering.min_members")));
        // The answer follows its track through the frames.
        session().goToFrame(45);
        QVERIFY(waitFor([&] { return tuning().why().view() && tuning().why().view()->frame == 45; }));
        QVERIFY(tuning().why().view()->told.found);
        // The ground, where nothing is.
        tuning().askWhy(QPointF(30, 165));
        QVERIFY(waitFor([&] { return tuning().why().view() && !tuning().why().view()->told.found; }));
        const QString parameter = QString::fromStdString(tuning().why().view()->told.parameter);
        QVERIFY(!parameter.isEmpty());
        emit tuning().whyPanel().parameterChosen(parameter);
        QVERIFY(waitFor([&] {
            QWidget* focused = window_->focusWidget();
            return focused != nullptr && row(parameter.toLatin1().constData())->isAncestorOf(focused);
        }));
    }

    void aMovedSliderShowsThePresentFrameAtOnce() {
        QVERIFY(showRun());
        const auto stored = session().viewFrame().result;
        QVERIFY(!stored->detections.empty());
        QVERIFY(tuning().previewBar().isHidden());
        slide("clustering.min_members", 6);
        QVERIFY(waitFor([&] { return preview().view() != nullptr; }));
        qInfo("first picture after %.0f ms", preview().view()->milliseconds);
        QVERIFY(!tuning().previewBar().isHidden());
        QVERIFY(tuning().previewBar().text().startsWith(QStringLiteral("clustering.min_members 3 →")));
        QVERIFY(waitFor([&] { return window_->canvas().frame().result != stored; }));
        QVERIFY(waitFor([&] { return preview().framesLeft() == 0; }));
        QVERIFY(preview().view()->previewed.tracks_final);
        // Lists that still tell of the run say so; what tells nothing of it is as it was.
        const auto is_marked = [&](DockId id) {
            return window_->docks().dock(id)->windowTitle().contains(QStringLiteral("(stored)"));
        };
        for (const DockId id : {DockId::tracks, DockId::events, DockId::inspector, DockId::stages, DockId::why})
            QVERIFY2(is_marked(id), qPrintable(window_->docks().dock(id)->windowTitle()));
        for (const DockId id : {DockId::runs, DockId::parameters, DockId::sweeps, DockId::stage_times,
                                DockId::evaluation, DockId::errors, DockId::metadata, DockId::objects})
            QVERIFY2(!is_marked(id), qPrintable(window_->docks().dock(id)->windowTitle()));
        // Another frame is previewed, too.
        session().goToFrame(41);
        QVERIFY(waitFor([&] { return preview().view() && preview().view()->frame == 41; }));
        tuning().previewBar().commands().discard();
        QVERIFY(!preview().active());
        QVERIFY(waitFor([&] { return window_->canvas().frame().result == session().viewFrame().result; }));
        QVERIFY(!is_marked(DockId::tracks) && !is_marked(DockId::why));
        QCOMPARE(row("clustering.min_members")->value(), QStringLiteral("3"));
    }

    void whatIsMovedFirstIsMovedOnTheRunShown() {
        QVERIFY(showRun());
        ParameterForm& form = window_->review().parameterForm();
        emit form.presetChosen(QStringLiteral("thesis"));
        QVERIFY(waitFor([&] { return preview().active(); }));  // a preset is meant as it is
        QVERIFY(preview().differences().size() > 10);
        preview().discard();
        slide("clustering.min_members", 6);
        QVERIFY(waitFor([&] { return preview().active(); }));
        QCOMPARE(preview().differences().size(), std::size_t{1});
        QCOMPARE(QString::fromStdString(preview().differences().front().name),
                 QStringLiteral("clustering.min_members"));
    }

    void draggingAnswersAllTheTime() {
        QVERIFY(showRun());
        int answers = 0;
        std::shared_ptr<const PreviewView> last;
        connect(&preview(), &LivePreview::changed, this, [&] {
            if (preview().view() && preview().view() != last) ++answers;
            last = preview().view();
        });
        auto* slider = row("gradient.quantile")->findChild<QSlider*>();
        const int begin = slider->value();
        int step = 0;
        QVERIFY(waitFor([&] {  // it is asked every few milliseconds, as a mouse moves
            slider->setValue(begin + ++step % 40);
            return answers >= 5;
        }));
        const double shown = row("gradient.quantile")->value().toDouble();
        QVERIFY(waitFor([&] { return preview().framesLeft() == 0; }));
        QCOMPARE(session().settings().options.detection.gradient.quantile, shown);
    }

    void switchedOffNothingIsComputed() {
        QVERIFY(showRun());
        window_->actions().live_preview->setChecked(false);
        slide("clustering.min_members", 6);
        QCoreApplication::processEvents();
        QVERIFY(!preview().active());
        window_->actions().live_preview->setChecked(true);
        QVERIFY(waitFor([&] { return preview().view() != nullptr; }));
        window_->actions().live_preview->setChecked(false);
        QVERIFY(!preview().active());
    }

    void twoRunsAreComparedOnTheSameFrames() {
        QVERIFY(showRun());
        ComparisonWindow& alone = tuning().compareRuns();
        QCOMPARE(alone.differences().rowCount(), 0);
        // What is compared is drawn, although the window beside it shows something else.
        window_->overlays().setProfile({});
        QVERIFY(alone.drawn().isDrawn(TrackLayer::kKind) && !alone.drawn().isDrawn(DetectionLayer::kKind));
        alone.detections().setChecked(true);
        QVERIFY(alone.drawn().isDrawn(DetectionLayer::kKind));
        window_->overlays().setHidden(true);
        QVERIFY(!alone.drawn().isDrawn(DetectionLayer::kKind));
        window_->overlays().setHidden(false);
        alone.close();
        session().settings().options.clustering.min_members = 200;  // finds nothing
        QSignalSpy finished(&session(), &ProjectSession::runFinished);
        session().startRun();
        QVERIFY(finished.wait(kPatience_ms));
        QVERIFY(waitFor([&] { return session().runs().size() == 2 && session().runs().back().frames_done == 60; }));
        QTest::qWait(0);
        ComparisonWindow& comparison = tuning().compareRuns();
        comparison.choose(1, 2);
        QVERIFY(waitFor([&] { return comparison.differences().rowCount() > 0; }));
        QCOMPARE(comparison.parameters().rowCount(), 1);
        QCOMPARE(comparison.parameters().item(0, 0)->text(), QStringLiteral("clustering.min_members"));
        QCOMPARE(comparison.parameters().item(0, 2)->text(), QStringLiteral("200"));
        for (int row = 0; row < comparison.differences().rowCount(); ++row)
            QCOMPARE(comparison.differences().item(row, 2)->text(), QStringLiteral("only in A"));
        // The largest stands first; going to it shows the same place of the same frame in both.
        const double size = comparison.differences().item(0, 0)->data(Qt::DisplayRole).toDouble();
        const int last = comparison.differences().rowCount() - 1;
        QVERIFY(size >= comparison.differences().item(last, 0)->data(Qt::DisplayRole).toDouble());
        comparison.differences().setCurrentCell(0, 0);
        emit comparison.differences().cellClicked(0, 0);
        VideoView& a = comparison.views().first();
        VideoView& b = comparison.views().second();
        QVERIFY(waitFor([&] { return a.frame().index == comparison.frame() && b.frame().index == a.frame().index; }));
        QVERIFY(a.frame().result && b.frame().result);
        QVERIFY(!a.frame().result->tracks.empty());
        QVERIFY(b.frame().result->tracks.empty());
        a.zoomBy(2);
        QCOMPARE(b.transform().zoom(), a.transform().zoom());
        const QPointF middle_a = a.transform().imageFromView(QPointF(a.width() / 2.0, a.height() / 2.0));
        const QPointF middle_b = b.transform().imageFromView(QPointF(b.width() / 2.0, b.height() / 2.0));
        QVERIFY(QLineF(middle_a, middle_b).length() < 1);
        comparison.views().setWipe(true);
        QCOMPARE(a.size(), b.size());
        comparison.views().setBorder(0.25);
        QVERIFY(!b.mask().contains(QPoint(2, 10)));
        QVERIFY(a.mask().contains(QPoint(2, 10)));
        comparison.playback().setSpeed(Playback::kFastest, 0);
        comparison.playback().setLooping(true);
        comparison.playback().play(0);
        QVERIFY(waitFor([&] { return comparison.shownPerSecond() > 0; }));
        qInfo("A and B: %.0f frames a second shown when %.0f are due", comparison.shownPerSecond(),
              25 * Playback::kFastest);
        comparison.playback().pause();
    }

    void aSideMayBeAPresetOrTheForm() {
        QVERIFY(showRun());
        ComparisonWindow& comparison = tuning().compareRuns();
        ComparisonHeader& header = comparison.header();
        QVERIFY(header.choose(ComparisonHeader::runSide(1), ComparisonHeader::presetSide(QStringLiteral("thesis"))));
        header.setRange(30, 50);
        QVERIFY(waitFor([&] { return comparison.parameters().rowCount() > 10; }));
        QVERIFY(header.summary().contains(QStringLiteral("only in A")));
        comparison.goToFrame(45);
        VideoView& a = comparison.views().first();
        VideoView& b = comparison.views().second();
        QVERIFY(waitFor([&] { return a.frame().index == 45 && b.frame().index == 45; }));
        QVERIFY(a.frame().result && b.frame().result);
        QVERIFY(!b.frame().result->motion.motion_vectors.empty());
        QVERIFY(a.frame().scale.gsd_known && b.frame().scale.gsd_known);
        comparison.goToFrame(59);  // not computed
        QCOMPARE(comparison.frame(), 50);
        comparison.goToFrame(0);
        QCOMPARE(comparison.frame(), 30);
        // The same parameters find the same, finished as in a run.
        QVERIFY(header.choose(ComparisonHeader::formSide(), ComparisonHeader::runSide(1)));
        header.setRange(0, 59);
        QVERIFY(waitFor([&] { return header.summary().startsWith(QStringLiteral("0 only in A, 0 only in B")); }));
        QCOMPARE(comparison.differences().rowCount(), 0);
        QCOMPARE(comparison.parameters().rowCount(), 0);
        // A slider of the form is followed.
        slide("outliers.min_length", 1000);  // as far as it goes
        QVERIFY(waitFor([&] { return comparison.parameters().rowCount() == 1; }));
        QVERIFY(comparison.differences().rowCount() > 0);
        // Only computed frames are played, again and again.
        header.setRange(10, 14);
        QSignalSpy shown(&comparison, &ComparisonWindow::framesShown);
        comparison.playback().play(10);
        QVERIFY(waitFor([&] { return shown.count() > 12; }));
        comparison.playback().pause();
        for (const auto& frame : shown) QVERIFY(frame.front().toInt() >= 10 && frame.front().toInt() <= 14);
        // A preset that needs a file that is not there.
        session().settings().options.detection.sliding_window.model = "no such model";
        comparison.parametersEdited();
        QVERIFY(waitFor([&] { return header.summary().contains(QStringLiteral("no such model")); }));
    }

    void presetsArePartOfTheProject() {
        QVERIFY(showRun());
        PresetLibrary library;
        library.useProject(session().project());
        ChainOptions night;
        night.motion.min_speed_m_s = 2.5;
        library.save("night", night, this, {});
        QVERIFY(library.find("night") == nullptr);  // written and read behind the window
        QVERIFY(library.find("thesis") != nullptr);
        QVERIFY(waitFor([&] { return library.find("night") != nullptr; }));
        PresetDialog dialog(library, ChainOptions(), window_.get());
        dialog.select(QStringLiteral("night"));
        QCOMPARE(dialog.selected(), QStringLiteral("night"));
        QCOMPARE(dialog.differences().rowCount(), 1);
        QCOMPARE(dialog.differences().item(0, 0)->text(), QStringLiteral("motion.min_speed"));
        QCOMPARE(dialog.differences().item(0, 1)->text(), QStringLiteral("2.5"));
        dialog.renameSelected(QStringLiteral("default"));
        QVERIFY(waitFor([&] { return dialog.message().contains(QStringLiteral("built in")); }));
        dialog.renameSelected(QStringLiteral("dusk"));
        QVERIFY(waitFor([&] { return dialog.selected() == QStringLiteral("dusk"); }));
        const QString file = QString::fromStdString((*home_ / "evening.json").string());
        dialog.exportSelected(file);
        QVERIFY(waitFor([&] { return dialog.message().contains(QStringLiteral("Wrote")); }));
        dialog.removeSelected();
        QVERIFY(waitFor([&] { return dialog.selected() == QStringLiteral("default"); }));
        QCOMPARE(library.presets().size(), builtInPresets().size());
        dialog.importFile(file);
        QVERIFY(waitFor([&] { return dialog.selected() == QStringLiteral("evening"); }));
        QCOMPARE(library.find("evening")->options->motion.min_speed_m_s, 2.5);
        dialog.importFile(QStringLiteral("/nowhere/x.json"));
        QVERIFY(waitFor([&] { return dialog.message().contains(QStringLiteral("/nowhere/x.json")); }));
        dialog.select(QStringLiteral("default"));
        dialog.removeSelected();
        QVERIFY(waitFor([&] { return dialog.message().contains(QStringLiteral("built in")); }));
    }

    void aPresetThatCannotBeReadSaysSoWhenItIsChosen() {
        std::filesystem::create_directories(*home_ / "presets");
        std::ofstream(*home_ / "presets" / "broken.json") << "{";
        PresetLibrary library(*home_ / "presets");
        QVERIFY(waitFor([&] { return library.find("broken") != nullptr; }));
        QVERIFY(!library.find("broken")->options);
        PresetDialog dialog(library, ChainOptions(), nullptr);
        dialog.select(QStringLiteral("broken"));
        QVERIFY2(dialog.message().contains(QStringLiteral("broken.json")), qPrintable(dialog.message()));
    }

    void trainingSaysWhatIsMissing() {
        QVERIFY(showRun());
        TrainingDialog dialog(session().project(), window_.get());
        dialog.setFile(QString::fromStdString((*home_ / "own.eyriemodel").string()));
        QSignalSpy failed(&dialog.training(), &LabelTraining::failed);
        dialog.start();
        QVERIFY(failed.wait(kPatience_ms));
        QVERIFY2(dialog.message().contains(QStringLiteral("no labelled vehicles")), qPrintable(dialog.message()));
        dialog.addProject(QStringLiteral("/nowhere/p.eyrie"));
        dialog.start();
        QVERIFY(failed.wait(kPatience_ms));
        QVERIFY(dialog.message().contains(QStringLiteral("/nowhere/p.eyrie")) ||
                dialog.message().contains(QStringLiteral("no labelled vehicles")));
    }

    void labelsBecomeAClassifierBesideTheShippedOne() {
        const auto images = test::writeScene(*home_ / "images", 40);
        const std::filesystem::path path = *home_ / "labels.eyrie";
        {
            // Both vehicles of the scene, labelled in each frame.
            ProjectFile project = ProjectFile::create(path);
            SequenceRecord sequence;
            sequence.path = images.string();
            sequence.size = {240, 180};
            sequence.frame_count = 40;
            const int id = ensureSequence(project, sequence);
            AnnotationStore store(project, id);
            for (int vehicle = 0; vehicle < 2; ++vehicle) {
                LabelledObject object;
                object.id = store.newObjectId();
                object.object_class = "car";
                for (int f = 0; f < 40; ++f) {
                    Keyframe key;
                    key.frame = f;
                    key.box = {{20.0 + 3 * f + 70 * vehicle + 10.5, 50.0 + 60 * vehicle + 5}, 22, 11, 0};
                    object.keyframes.push_back(key);
                }
                object.last_frame = 39;
                AnnotationEdit edit;
                edit.name = "add";
                edit.objects.push_back({std::nullopt, object});
                store.apply(edit);
            }
        }
        TrainingDialog dialog(path, nullptr);
        dialog.setKinds(DescriptorKind::dct, ClassifierKind::random_naive_bayes);
        dialog.setEvery(2);
        dialog.options().hard_negative_rounds = 0;
        const QString file = QString::fromStdString((*home_ / "own.eyriemodel").string());
        dialog.setFile(file);
        QSignalSpy finished(&dialog.training(), &LabelTraining::finished);
        QSignalSpy failed(&dialog.training(), &LabelTraining::failed);
        dialog.start();
        QVERIFY(waitFor([&] { return !finished.isEmpty() || !failed.isEmpty(); }));
        QVERIFY2(failed.isEmpty(), qPrintable(dialog.message()));
        QVERIFY(dialog.message().contains(QStringLiteral("last third")));
        QCOMPARE(dialog.chart().data().series.size(), std::size_t{2});
        QVERIFY(std::filesystem::exists(file.toStdString()));
        // A model of another descriptor is not overwritten by mistake.
        dialog.setKinds(DescriptorKind::hog, ClassifierKind::random_naive_bayes);
        QSignalSpy asked(&dialog.training(), &LabelTraining::replacementNeeded);
        dialog.start();
        QVERIFY(asked.wait(kPatience_ms));
        QVERIFY2(dialog.message().contains(QStringLiteral("a model with DCT and Random Naïve Bayes")) &&
                     dialog.message().contains(QStringLiteral("by one with HOG and Random")),
                 qPrintable(dialog.message()));
        dialog.start();
        dialog.training().cancel();
        QSignalSpy stopped(&dialog.training(), &LabelTraining::stopped);
        QVERIFY(waitFor([&] { return !dialog.training().running(); }));
    }

    void valuesThatCannotBeAreSaid() {
        QVERIFY(showRun());
        session().settings().options.detection.sliding_window.model = "no such model";
        preview().parametersEdited();
        QVERIFY(waitFor([&] { return !preview().problem().isEmpty(); }));
        QVERIFY(tuning().previewBar().text().contains(QStringLiteral("no such model")));
    }
};

}  // namespace eyrie::ui::tuning_test

EYRIE_UI_TEST(QApplication, tuning_test, TuningTest)
#include "tuning_test.moc"
