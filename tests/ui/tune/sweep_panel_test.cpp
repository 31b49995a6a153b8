#include "tune/sweep/sweep_panel.h"

#include <sys/resource.h>

#include <QAbstractButton>
#include <QApplication>
#include <QClipboard>
#include <QElapsedTimer>
#include <QFocusEvent>
#include <QImage>
#include <QLabel>
#include <QSignalSpy>
#include <QTest>
#include <QThread>
#include <QTimer>
#include <cmath>
#include <csignal>
#include <fstream>

#include "store/sweeps/sweep_store.h"
#include "tune/evaluate/evaluation_panel.h"
#include "tune/evaluate/truth_choice.h"
#include "tune/sweep/sweep_form.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "widgets/charts/sweep_chart.h"
#include "window/docks/evaluation_docks.h"
#include "window/docks/review_docks.h"
#include "window/main_window.h"

namespace eyrie::ui::sweep_panel_test {

using test::kPatience_ms;

/// The longest time that the event loop of this thread did not turn.
class Watchdog {
 public:
    Watchdog() {
        timer_.setInterval(5);
        timer_.setTimerType(Qt::PreciseTimer);
        QObject::connect(&timer_, &QTimer::timeout, [this] {
            longest_ms_ = std::max(longest_ms_, static_cast<double>(since_.nsecsElapsed()) / 1e6 - 5);
            since_.restart();
        });
        since_.start();
        timer_.start();
    }
    double longest_ms() const { return longest_ms_; }

 private:
    QTimer timer_;
    QElapsedTimer since_;
    double longest_ms_ = 0;
};

class SweepPanelTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;
    std::filesystem::path truth_;

    /// Sweeps give way to everything else, so that on a busy machine they take their time.
    static bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, 4 * kPatience_ms); }

    /// The two vehicles of the scene.
    void writeTruth(int frames) {
        truth_ = *home_ / "truth.csv";
        std::ofstream file(truth_);
        file << "frame,id,x,y,length,width,heading,class,ignore\n";
        for (int i = 0; i < frames; ++i) {
            for (int v = 0; v < 2; ++v)
                file << i << "," << v + 1 << "," << 20 + 3 * i + 70 * v + 10.5 << "," << 55 + 60 * v
                     << ",22,11,0,car,0\n";
        }
    }

    std::unique_ptr<MainWindow> windowWithRun(int frames) {
        const auto folder = test::writeScene(*home_ / "images", frames);
        writeTruth(frames);
        auto window = std::make_unique<MainWindow>();
        window->show();
        window->session().settings().options.detection.method = DetectionMethod::gradient;
        window->session().settings().options.view.oblique = false;
        QSignalSpy finished(&window->session(), &ProjectSession::runFinished);
        StartOptions options;
        options.input = folder;
        options.gsd_m_per_px = 0.25;
        window->start(options);
        if (!finished.wait(kPatience_ms)) return nullptr;
        return runIsRead(*window) ? std::move(window) : nullptr;
    }
    static bool runIsRead(MainWindow& window) {
        return waitFor([&] { return window.session().runData() && !window.session().running(); });
    }
    SweepRequest request(const std::vector<std::string>& axes) const {
        SweepRequest request;
        request.axes = axes;
        request.truth_file = truth_;
        return request;
    }
    static std::size_t pointsOf(const SweepPanel& panel) {
        const auto& table = const_cast<SweepPanel&>(panel).sweeps().table();
        return table ? table->points.size() : 0;
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void aSweepOfAProjectThatWasClosedIsNotShown() {
        const auto window = windowWithRun(12);
        QVERIFY(window);
        const std::filesystem::path project = window->session().project();
        SweepSession& sweeps = window->review().sweeps().sweeps();
        sweeps.start(request({"gradient.quantile=0.1,0.2"}));
        // The window does nothing meanwhile, so that it hears of the sweep only when the project is gone.
        QElapsedTimer since;
        since.start();
        const auto begun = [&] {
            ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
            return !SweepStore(file).sweeps().empty();
        };
        while (!begun() && since.elapsed() < 4 * kPatience_ms) QThread::msleep(5);
        QVERIFY(begun());
        window->session().closeProject();
        QVERIFY(waitFor([&] { return !sweeps.running(); }));
        QVERIFY(!sweeps.table());
        QVERIFY(sweeps.sweeps().empty());
    }

    void sweepsOverTheRunAndShowsTheCurveWithoutStoppingTheWindow() {
        const auto window = windowWithRun(40);
        QVERIFY(window);
        SweepPanel& panel = window->review().sweeps();
        panel.form().setAxis(0, QStringLiteral("gradient.quantile"), QStringLiteral("0.02:0.01:0.98"));
        QCOMPARE(panel.form().request().axes.front(), std::string("gradient.quantile=0.02:0.01:0.98"));
        QSignalSpy finished(&panel.sweeps(), &SweepSession::finished);
        QSignalSpy failed(&panel.sweeps(), &SweepSession::failed);
        QSignalSpy progressed(&panel.sweeps(), &SweepSession::progressed);
        double stall_ms = 0;
        QElapsedTimer sweep;
        {
            Watchdog watchdog;
            sweep.start();
            panel.sweeps().start(request(panel.form().request().axes));
            QVERIFY(panel.sweeps().running());
            // As somebody would who goes on reviewing meanwhile.
            int frame = 0;
            QVERIFY(waitFor([&] {
                window->session().goToFrame(frame = (frame + 1) % 40);
                return !panel.sweeps().running();
            }));
            stall_ms = watchdog.longest_ms();
        }
        QVERIFY2(failed.isEmpty(), qPrintable(failed.isEmpty() ? QString() : failed.first().first().toString()));
        QCOMPARE(finished.size(), 1);
        QVERIFY(finished.first().first().toBool());
        QVERIFY(progressed.size() > 1);
        const auto sweep_ms = static_cast<double>(sweep.elapsed());
        qInfo("longest stall of the window thread while a sweep of %.0f ms worked: %.1f ms", sweep_ms, stall_ms);
        // Against the sweep's own time, which grows with it on a busy machine.
        QVERIFY2(stall_ms < sweep_ms / 4, qPrintable(QString::number(stall_ms)));
        QCOMPARE(pointsOf(panel), std::size_t(97));
        // T_ov 0.1, 0.2, 0.3 and their mean; the best point lies on the mean.
        const SweepChartData& data = panel.chart().data();
        QCOMPARE(data.series.size(), std::size_t(4));
        QCOMPARE(data.series.back().x.size(), std::size_t(97));
        QCOMPARE(data.best.size(), std::size_t(1));
        QVERIFY(data.band && data.band->first <= data.best.front().x() && data.best.front().x() <= data.band->second);
        QCOMPARE(data.x_label, QStringLiteral("gradient.quantile"));
        panel.chart().copyText();
        QCOMPARE(QApplication::clipboard()->text().split(QLatin1Char('\n')).size(), 98);
        panel.setView(SweepView::trade_off);
        QCOMPARE(panel.chart().data().x_label, QStringLiteral("recall"));
        panel.setView(SweepView::precision_recall);
        QCOMPARE(panel.chart().data().series.size(), std::size_t(3));
    }

    void pointsAreMeasuredAgainstWhatTheEvaluationIs() {
        const auto window = windowWithRun(24);
        QVERIFY(window);
        SweepPanel& panel = window->review().sweeps();
        EvaluationSession& evaluation = window->evaluation().evaluation();
        const auto* chosen = panel.form().findChild<TruthChoice*>();
        QVERIFY(chosen != nullptr);
        QCOMPARE(chosen->currentText(), QStringLiteral("Labels of the project"));
        QVERIFY(panel.form().request().truth_file.empty());
        // Chosen beside the evaluation …
        window->evaluation().panel().useTruthFile(QString::fromStdString(truth_.string()));
        QCOMPARE(chosen->currentText(), QStringLiteral("truth.csv"));
        QCOMPARE(panel.form().request().truth_file, truth_);
        panel.form().setAxis(0, QStringLiteral("gradient.quantile"), QStringLiteral("0.1,0.2"));
        panel.sweeps().start(panel.form().request());
        QVERIFY(waitFor([&] { return !panel.sweeps().running(); }));
        QCOMPARE(panel.sweeps().table()->plan.clips.front().ground_truth, truth_.string());
        bool told = false;
        for (const auto* label : panel.findChildren<QLabel*>())
            told = told || label->text().contains(QStringLiteral("Measured against truth.csv."));
        QVERIFY(told);
        // … or beside the sweep, it is one choice.
        panel.form().findChild<TruthChoice*>()->useFile(QString());
        QVERIFY(evaluation.settings().truth_file.empty());
        QCOMPARE(window->evaluation().panel().findChild<TruthChoice*>()->currentText(),
                 QStringLiteral("Labels of the project"));
    }

    void aNarrowDockCutsNothing() {
        const auto window = windowWithRun(12);
        QVERIFY(window);
        SweepPanel& panel = window->review().sweeps();
        panel.form().setAxis(0, QStringLiteral("sliding_window.descriptor"), QStringLiteral("dct"));
        panel.form().setAxis(1, QStringLiteral("gradient.quantile"), QStringLiteral("0.1,0.2"));
        QVERIFY2(panel.minimumSizeHint().width() <= 300, qPrintable(QString::number(panel.minimumSizeHint().width())));
    }

    void whoUsesKeysSeesThatTheChartHasThem() {
        SweepChart chart;
        chart.resize(300, 200);
        const auto* ring = chart.findChild<QWidget*>(QStringLiteral("focus_ring"));
        QVERIFY(ring != nullptr && !ring->isVisibleTo(&chart));
        QFocusEvent in(QEvent::FocusIn, Qt::TabFocusReason);
        QApplication::sendEvent(&chart, &in);
        QVERIFY(ring->isVisibleTo(&chart));
        QCOMPARE(ring->geometry(), chart.rect());
        QVERIFY(ring->testAttribute(Qt::WA_TransparentForMouseEvents));
        const QImage picture = chart.grab().toImage();
        QCOMPARE(picture.pixelColor(picture.width() / 2, 1).rgb(), chart.palette().color(QPalette::Highlight).rgb());
        QFocusEvent out(QEvent::FocusOut, Qt::TabFocusReason);
        QApplication::sendEvent(&chart, &out);
        QVERIFY(!ring->isVisibleTo(&chart));
    }

    void aPointGoesIntoTheNextRun() {
        const auto window = windowWithRun(24);
        QVERIFY(window);
        SweepPanel& panel = window->review().sweeps();
        panel.sweeps().start(request({"gradient.quantile=0.11,0.23"}));
        QVERIFY(waitFor([&] { return !panel.sweeps().running(); }));
        emit panel.chart().pointClicked(0);
        QTest::keyClick(&panel.chart(), Qt::Key_Right);
        for (auto* button : panel.findChildren<QAbstractButton*>())
            if (button->text() == QStringLiteral("Use for the next run")) button->click();
        QCOMPARE(window->session().settings().options.detection.gradient.quantile, 0.23);
    }

    void twoParametersMakeAHeatMap() {
        const auto window = windowWithRun(24);
        QVERIFY(window);
        SweepPanel& panel = window->review().sweeps();
        panel.sweeps().start(request({"detection.method=gradient,clusters", "outliers.min_vectors=2,3,40"}));
        QVERIFY(waitFor([&] { return !panel.sweeps().running(); }));
        const SweepChartData& data = panel.chart().data();
        QVERIFY(data.isMap());
        QCOMPARE(data.rows, QStringList({QStringLiteral("gradient"), QStringLiteral("clusters")}));
        QCOMPARE(data.columns.size(), 3);
        QVERIFY(data.best_cell.has_value());
        for (const double cell : data.cells) QVERIFY(std::isfinite(cell));
        emit panel.chart().pointClicked(0);
        QSignalSpy chosen(&panel.chart(), &SweepChart::pointClicked);
        QTest::keyClick(&panel.chart(), Qt::Key_Right);
        QTest::keyClick(&panel.chart(), Qt::Key_Up);
        QTest::keyClick(&panel.chart(), Qt::Key_Up);  // there is no further row
        QCOMPARE(chosen.size(), 2);
        QCOMPARE(chosen.at(0).at(0).toInt(), 1);
        QCOMPARE(chosen.at(1).at(0).toInt(), 4);
    }

    void aCancelledOrClosedSweepIsResumed() {
        const std::string axis = "gradient.quantile=0.02:0.008:0.98";
        std::filesystem::path project;
        std::size_t before = 0;
        {
            const auto window = windowWithRun(40);
            QVERIFY(window);
            project = window->session().project();
            SweepPanel& panel = window->review().sweeps();
            panel.sweeps().start(request({axis}));
            QVERIFY(waitFor([&] { return pointsOf(panel) > 2; }));
            panel.sweeps().cancel();
            QVERIFY(waitFor([&] { return !panel.sweeps().running(); }));
            before = pointsOf(panel);
            QVERIFY(before < 121);
            panel.sweeps().resume(panel.sweeps().table()->id);
            QVERIFY(waitFor([&] { return pointsOf(panel) > before; }));
            before = pointsOf(panel);
            // The window is closed while it works.
        }
        MainWindow window;
        window.session().open(project);
        QVERIFY(runIsRead(window));
        SweepPanel& panel = window.review().sweeps();
        QVERIFY(waitFor([&] { return pointsOf(panel) >= before; }));
        QVERIFY(pointsOf(panel) < 121);
        QCOMPARE(panel.sweeps().sweeps().size(), std::size_t(1));
        QSignalSpy finished(&panel.sweeps(), &SweepSession::finished);
        panel.sweeps().resume(panel.sweeps().sweeps().front().id);
        QVERIFY(waitFor([&] { return !finished.isEmpty(); }));
        QVERIFY(finished.first().first().toBool());
        QCOMPARE(pointsOf(panel), std::size_t(121));
    }

    void severalRunsAreSweptOverTogether() {
        const auto window = windowWithRun(24);
        QVERIFY(window);
        QSignalSpy finished(&window->session(), &ProjectSession::runFinished);
        window->session().settings().options.tracking.min_overlap = 0.4;
        window->session().startRun();
        QVERIFY(finished.wait(kPatience_ms));
        QVERIFY(runIsRead(*window));
        QCOMPARE(window->session().currentRun(), 2);
        SweepPanel& panel = window->review().sweeps();
        QAction* other = nullptr;
        for (QAction* action : panel.form().findChildren<QAction*>())
            if (action->text().startsWith(QStringLiteral("Run 1"))) other = action;
        QVERIFY(other != nullptr && other->isEnabled());
        other->trigger();
        QVERIFY(other->isChecked());
        panel.form().setAxis(0, QStringLiteral("gradient.quantile"), QStringLiteral("0.1,0.2"));
        QCOMPARE(panel.form().request().other_runs, std::vector<int>{1});
        SweepRequest both = request({"gradient.quantile=0.1,0.2"});
        both.other_runs = {1};
        QSignalSpy failed(&panel.sweeps(), &SweepSession::failed);
        panel.sweeps().start(both);
        QVERIFY(waitFor([&] { return !panel.sweeps().running(); }));
        QVERIFY2(failed.isEmpty(), qPrintable(failed.isEmpty() ? QString() : failed.first().first().toString()));
        const SweepTable& table = *panel.sweeps().table();
        QCOMPARE(table.plan.clips.size(), std::size_t(2));
        QCOMPARE(table.plan.clips[0].run, 2);
        QCOMPARE(table.plan.clips[1].run, 1);
        QCOMPARE(table.points.size(), std::size_t(2));
        panel.sweeps().resume(table.id);  // nothing is left to do
        QVERIFY(waitFor([&] { return !panel.sweeps().running(); }));
        QVERIFY(failed.isEmpty());
    }

    void oneOfTwoWindowsWorksOnASweep() {
        const auto window = windowWithRun(40);
        QVERIFY(window);
        SweepSession& first = window->review().sweeps().sweeps();
        first.start(request({"gradient.quantile=0.02:0.002:0.98"}));
        QVERIFY(waitFor([&] { return pointsOf(window->review().sweeps()) > 2; }));
        MainWindow other;
        other.session().open(window->session().project());
        QVERIFY(runIsRead(other));
        SweepSession& second = other.review().sweeps().sweeps();
        QVERIFY(waitFor([&] { return second.table() != nullptr; }));
        QSignalSpy failed(&second, &SweepSession::failed);
        second.resume(second.table()->id);
        QVERIFY(waitFor([&] { return !failed.isEmpty(); }));
        QVERIFY2(failed.first().first().toString().contains(QStringLiteral("is being worked on by process")),
                 qPrintable(failed.first().first().toString()));
        QVERIFY(first.running());
        first.cancel();
        QVERIFY(waitFor([&] { return !first.running(); }));
        QSignalSpy progressed(&second, &SweepSession::progressed);
        second.resume(second.table()->id);
        QVERIFY(waitFor([&] { return progressed.size() > 3; }));
        QCOMPARE(failed.size(), 1);
    }

    void aFullDiskKeepsWhatIsDone() {
        const auto window = windowWithRun(30);
        QVERIFY(window);
        SweepPanel& panel = window->review().sweeps();
        SweepSession& sweeps = panel.sweeps();
        QSignalSpy failed(&sweeps, &SweepSession::failed);
        signal(SIGXFSZ, SIG_IGN);
        rlimit before{};
        getrlimit(RLIMIT_FSIZE, &before);
        rlimit small = before;
        sweeps.start(request({"gradient.quantile=0.02:0.008:0.98"}));
        QVERIFY(waitFor([&] { return pointsOf(panel) > 2; }));
        std::error_code none;  // no file grows much beyond that of the journal
        const auto journal = std::filesystem::file_size(window->session().project().string() + "-wal", none);
        small.rlim_cur = (none ? 0 : journal) + 60'000;
        setrlimit(RLIMIT_FSIZE, &small);
        const bool ended = waitFor([&] { return !sweeps.running(); });
        setrlimit(RLIMIT_FSIZE, &before);
        QVERIFY(ended);
        QCOMPARE(failed.size(), 1);
        const QString text = failed.first().first().toString();
        QVERIFY2(text.contains(QStringLiteral("storing point")), qPrintable(text));
        const std::size_t kept = pointsOf(panel);
        QVERIFY(kept > 0 && kept < 121);
        QSignalSpy finished(&sweeps, &SweepSession::finished);
        sweeps.resume(sweeps.table()->id);
        QVERIFY(waitFor([&] { return !sweeps.running(); }));
        QVERIFY(finished.size() == 1 && finished.first().first().toBool());
        QCOMPARE(pointsOf(panel), std::size_t(121));
    }

    void aModelOfAnotherDescriptorAndATruthOfOtherFramesAreNamed() {
        const auto window = windowWithRun(24);
        QVERIFY(window);
        SweepSession& sweeps = window->review().sweeps().sweeps();
        QSignalSpy failed(&sweeps, &SweepSession::failed);
        sweeps.start(request({"sliding_window.descriptor=chnftrs,dct"}));
        QVERIFY(waitFor([&] { return !sweeps.running(); }));
        QVERIFY(failed.isEmpty());  // the run's detector needs no model
        sweeps.start(request({"detection.method=sliding_window", "sliding_window.descriptor=dct"}));
        QVERIFY(waitFor([&] { return !failed.isEmpty(); }));
        const QString text = failed.first().first().toString();
        QVERIFY2(text.contains(QStringLiteral("chnftrs")) && text.contains(QStringLiteral("dct")), qPrintable(text));
        failed.clear();
        std::ofstream(truth_) << "frame,id,x,y,length,width,heading,class,ignore\n900,1,20,20,22,11,0,car,0\n";
        sweeps.start(request({"gradient.quantile=0.1,0.2"}));
        QVERIFY(waitFor([&] { return !failed.isEmpty(); }));
        QVERIFY(failed.first().first().toString().contains(QStringLiteral("only in frames 900 to 900")));
    }

    void saysWhatIsMissing() {
        const auto window = windowWithRun(24);
        QVERIFY(window);
        SweepSession& sweeps = window->review().sweeps().sweeps();
        QSignalSpy failed(&sweeps, &SweepSession::failed);
        const auto refused = [&](const SweepRequest& request) {
            failed.clear();
            sweeps.start(request);
            waitFor([&] { return !failed.isEmpty(); });
            return failed.isEmpty() ? QString() : failed.first().first().toString();
        };
        SweepRequest unlabelled = request({"gradient.quantile=0.1"});
        unlabelled.truth_file.clear();
        QVERIFY(refused(unlabelled).contains(QStringLiteral("nobody has labelled")));
        QVERIFY(refused(request({"gradient.quantile=0.5:0.1:0.1"})).contains(QStringLiteral("empty")));
        QVERIFY(refused(request({"gradient.quantle=0.5"})).contains(QStringLiteral("nearest")));
        SweepRequest bad = request({"gradient.quantile=0.5"});
        bad.overlaps = {-1};
        QVERIFY(refused(bad).contains(QStringLiteral("overlap")));
        QSignalSpy asked(&sweeps, &SweepSession::consentNeeded);
        QObject::disconnect(&sweeps, &SweepSession::consentNeeded, nullptr, nullptr);
        QSignalSpy asked_again(&sweeps, &SweepSession::consentNeeded);
        sweeps.start(request({"gradient.quantile=0.001:0.000001:0.999"}));
        QCOMPARE(asked_again.size(), 1);
        QVERIFY(!sweeps.running());
    }

    void withoutARunTheFormSaysHowToBegin() {
        MainWindow window;
        window.show();
        SweepForm& form = window.review().sweeps().form();
        form.setAxis(0, QStringLiteral("gradient.quantile"), QStringLiteral("0.1:0.1:0.5"));
        auto* start = form.findChild<QAbstractButton*>(QStringLiteral("sweep_start"));
        QVERIFY(start != nullptr);
        QVERIFY(!start->isEnabled());
        QVERIFY(start->toolTip().contains(QStringLiteral("Run the video first")));
    }
};

}  // namespace eyrie::ui::sweep_panel_test

EYRIE_UI_TEST(QApplication, sweep_panel_test, SweepPanelTest)
#include "sweep_panel_test.moc"
