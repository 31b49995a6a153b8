#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QRegularExpression>
#include <QStatusBar>
#include <QTest>
#include <cmath>
#include <numbers>

#include "canvas/layers/north_layer.h"
#include "canvas/video_view.h"
#include "review/earth/earth_dock.h"
#include "review/earth/metadata_panel.h"
#include "review/earth/video_earth.h"
#include "review/inspector/inspector_panel.h"
#include "review/inspector/track_inspector.h"
#include "store/review/control_points.h"
#include "support/shared_data.h"
#include "ui/support/ui_test.h"
#include "ui/window/flown_video.h"
#include "ui/window/window_with_run.h"
#include "widgets/empty_state.h"
#include "window/docks/review_docks.h"
#include "window/docks/watching_docks.h"
#include "workspace/dock_registry.h"

namespace eyrie::ui::metadata_window_test {

using test::kPatience_ms;

/// What the window tells of where a video was taken: its metadata, coordinates, north.
class MetadataWindowTest : public QObject {
    Q_OBJECT

    static constexpr int kFlownFrames = 40;
    std::unique_ptr<test::OwnHome> home_;

    static std::unique_ptr<MainWindow> windowOver(const std::filesystem::path& video) {
        auto window = std::make_unique<MainWindow>();
        window->resize(1280, 720);
        window->show();
        if (!QTest::qWaitForWindowActive(window.get())) return nullptr;
        if (!test::openAndWait(window->session(), videoMedia(video))) return nullptr;
        window->docks().raise(DockId::metadata);
        if (!QTest::qWaitFor([&] { return window->watching().earth().earth().metadata() != nullptr; }, kPatience_ms))
            return nullptr;
        return window;
    }
    static QString cell(const MainWindow& window, const QString& name, int column = MetadataModel::value_column) {
        const MetadataModel& model = const_cast<MainWindow&>(window).watching().earth().metadata().model();
        for (int row = 0; row < model.rowCount(); ++row)
            if (model.index(row, MetadataModel::name_column).data().toString() == name)
                return model.index(row, column).data().toString();
        return QStringLiteral("no such row");
    }
    static double degrees(const MainWindow& window, const QString& name) {
        QString text = cell(window, name);
        const bool has_unit = text.endsWith(QStringLiteral("°"));
        text.chop(1);
        return has_unit ? text.toDouble() : 1e9;
    }
    static bool goTo(MainWindow& window, FrameIndex frame) {
        window.session().goToFrame(frame);
        return test::shows(window.session(), frame);
    }
    static void pointAt(MainWindow& window, QPointF px) {
        QTest::mouseMove(&window.canvas(), window.canvas().transform().viewFromImage(px).toPoint());
    }
    /// The place that the status bar tells; nothing when it tells none.
    static std::optional<GeoPoint> placeTold(const MainWindow& window) {
        for (const QLabel* label : window.statusBar()->findChildren<QLabel*>()) {
            const QStringList parts = label->text().split(QStringLiteral(", "));
            if (parts.size() == 2 && label->toolTip().contains(QStringLiteral("Latitude")))
                return GeoPoint{parts[0].toDouble(), parts[1].toDouble()};
        }
        return std::nullopt;
    }
    static double metresApart(const std::optional<GeoPoint>& told, const GeoPoint& place) {
        return told ? cv::norm(LocalPlane(place).metresOf(*told)) : 1e9;
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }

    void theTableTellsWhatTheFrameShows() {
        const auto window = windowOver(test::writeFlownVideo(*home_ / "", kFlownFrames));
        QVERIFY(window);
        QTRY_COMPARE_WITH_TIMEOUT(cell(*window, QStringLiteral("mission")), QStringLiteral("OUTBOUND"), kPatience_ms);
        const double before = degrees(*window, QStringLiteral("corner 1 longitude"));
        QCOMPARE(cell(*window, QStringLiteral("corner 1 longitude"), MetadataModel::sets_column),
                 QStringLiteral("100 %"));
        QCOMPARE(cell(*window, QStringLiteral("time")), QStringLiteral("2009-01-12T22:08:22.000Z"));
        QCOMPARE(cell(*window, QStringLiteral("scale")), QStringLiteral("0.5 m/px"));
        QCOMPARE(degrees(*window, QStringLiteral("the picture's top points to")), 0.0);
        QVERIFY(goTo(*window, 30));
        QTRY_COMPARE(cell(*window, QStringLiteral("mission")), QStringLiteral("RETURN"));
        QCOMPARE(cell(*window, QStringLiteral("time")), QStringLiteral("2009-01-12T22:08:23.200Z"));
        const double east_m = (degrees(*window, QStringLiteral("corner 1 longitude")) - before) * 74'600;
        QVERIFY2(qAbs(east_m - 15) < 0.5, qPrintable(QString::number(east_m)));
        const QString summary = window->watching().earth().metadata().summary();
        QVERIFY2(summary.contains(QStringLiteral("40 sets, 100 % of the video covered")), qPrintable(summary));
        QVERIFY(!summary.contains(QStringLiteral("damaged")));
        QVERIFY(!window->watching().earth().metadata().streams().isVisible());
    }

    void whatIsDamagedIsCountedAndTheRestCounts() {
        const auto window = windowOver(test::writeFlownVideo(*home_ / "", kFlownFrames, 3));
        QVERIFY(window);
        QTRY_VERIFY_WITH_TIMEOUT(
            window->watching().earth().metadata().summary().contains(QStringLiteral("3 damaged, skipped")),
            kPatience_ms);
        QVERIFY(window->watching().earth().metadata().summary().contains(QStringLiteral("37 sets")));
        QCOMPARE(cell(*window, QStringLiteral("mission")), QStringLiteral("OUTBOUND"));
    }

    void coordinatesStandUnderTheCursorAndFollowTheFrame() {
        const auto window = windowOver(test::writeFlownVideo(*home_ / "", kFlownFrames));
        QVERIFY(window);
        const QPointF px(60, 40);
        pointAt(*window, px);
        // A pixel of the view is a fraction of one of the picture.
        QTRY_VERIFY_WITH_TIMEOUT(metresApart(placeTold(*window), test::flownPlace(0, {60, 40})) < 0.5, kPatience_ms);
        QVERIFY(goTo(*window, 30));
        QTRY_VERIFY(metresApart(placeTold(*window), test::flownPlace(30, {60, 40})) < 0.5);
        emit window->canvas().cursorMoved(std::nullopt);
        QVERIFY(!placeTold(*window));
    }

    void theInspectorTellsTheCourseFromNorth() {
        const auto window = windowOver(test::writeFlownVideo(*home_ / "", kFlownFrames));
        QVERIFY(window);
        const VideoEarth& earth = window->watching().earth().earth();
        // The top of the picture is north: what points right drives east.
        const double kQuarter = std::numbers::pi / 2;
        for (int turn = 0; turn < 4; ++turn) {
            const auto course = earth.courseOf(5, {120, 90}, turn * kQuarter);
            QVERIFY(course);
            QVERIFY2(std::abs(std::remainder(*course - 90 * (turn + 1), 360)) < 1,
                     qPrintable(QString::number(*course)));
        }
        TrackFrame driving;
        driving.frame = 5;
        driving.state.box = {{120, 90}, 20, 10, kQuarter};
        TrackInspector& inspector = window->review().inspector().track();
        inspector.showTrack(1, {driving}, {test::kFlownPixel_m, 25, true}, TrackClass::vehicle);
        inspector.setCurrentFrame(5);
        const QRegularExpression south(QStringLiteral("\\t(179|180|181)° from north"));
        QVERIFY2(inspector.text().contains(south), qPrintable(inspector.text()));
    }

    void northIsDrawnWithoutARun() {
        const auto window = windowOver(test::writeFlownVideo(*home_ / "", kFlownFrames));
        QVERIFY(window);
        QTRY_VERIFY_WITH_TIMEOUT(window->canvas().frame().north_deg.has_value(), kPatience_ms);
        QVERIFY(qAbs(std::remainder(*window->canvas().frame().north_deg + 90, 360)) < 0.2);
        QVERIFY(!window->session().currentRun());
        QVERIFY(window->overlays().isVisible(NorthLayer::kKind));
        const QImage with = window->canvas().picture();
        QTest::keyClick(window.get(), Qt::Key_8, Qt::AltModifier);
        QVERIFY(!window->overlays().isVisible(NorthLayer::kKind));
        QVERIFY(with != window->canvas().picture());
    }

    void theRunSteadiesPlacesAndIsNamed() {
        const auto window = windowOver(test::writeFlownVideo(*home_ / "", kFlownFrames));
        QVERIFY(window);
        QVERIFY(test::runAndWait(window->session()));
        // Nobody gave a scale: the metadata do.
        QVERIFY(window->session().shownRun() != nullptr);
        QCOMPARE(window->session().shownRun()->scale_basis.origin, ScaleOrigin::metadata);
        QVERIFY(qAbs(window->session().shownRun()->scale.gsd_m_per_px - test::kFlownPixel_m) < 0.005);
        const auto* gsd = window->findChild<QLineEdit*>(QStringLiteral("gsd"));
        QVERIFY2(gsd->placeholderText().endsWith(tr("from the metadata")), qPrintable(gsd->placeholderText()));
        const auto told = [&] { return window->watching().earth().earth().origin(); };
        QTRY_VERIFY_WITH_TIMEOUT(told().contains(QStringLiteral("steadied by the registration")), kPatience_ms);
        const auto place = window->watching().earth().earth().placeOf(25, {100, 90});
        QVERIFY(metresApart(place, test::flownPlace(25, {100, 90})) < 0.6);
    }

    void aVideoWithoutMetadataSaysSoAndWhatHelps() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        window->docks().raise(DockId::metadata);
        const auto text = [&] { return window->watching().earth().metadata().emptyState()->explanation(); };
        QTRY_VERIFY_WITH_TIMEOUT(
            text().contains(QStringLiteral("only video files carry metadata (KLV)."), Qt::CaseInsensitive),
            kPatience_ms);
        QVERIFY(text().contains(QStringLiteral("by hand")));
        pointAt(*window, {60, 40});
        QVERIFY(!placeTold(*window));
        QVERIFY(!window->canvas().frame().north_deg);
    }

    void controlPointsOfTheProjectDoWithoutMetadata() {
        {
            const auto window = test::windowWithRun();
            QVERIFY(window);
            ProjectFile project = ProjectFile::open(window->session().project());
            std::vector<ControlPoint> points;
            for (const cv::Point2d& px : {cv::Point2d(10, 10), {200, 20}, {210, 160}, {20, 150}})
                points.push_back({0, px, test::flownPlace(0, px)});
            replaceControlPoints(project, window->session().shownRun()->sequence.id, points);
            window->close();
        }
        const auto window = test::windowWithRun();
        QVERIFY(window);
        QVERIFY(goTo(*window, 20));
        const auto apart = [&] {
            return metresApart(window->watching().earth().earth().placeOf(20, {100, 90}),
                               test::flownPlace(20, {100, 90}));
        };
        QTRY_VERIFY_WITH_TIMEOUT(apart() < 1, kPatience_ms);
        QVERIFY(window->watching().earth().earth().origin().contains(QStringLiteral("4 control points")));
        QTRY_VERIFY(window->canvas().frame().north_deg.has_value());
    }

    void oneOfSeveralStreamsCanBeLookedAt() {
        const std::filesystem::path given = eyrie::test::sharedData("klv") / "h265_tricky_klv.ts";
        if (!std::filesystem::exists(given)) QSKIP("needs shared data");
        // A project is kept beside its video, where perhaps nothing may be written.
        const std::filesystem::path video = *home_ / "streams.ts";
        std::filesystem::copy_file(given, video);
        const auto window = windowOver(video);
        QVERIFY(window);
        QTRY_COMPARE_WITH_TIMEOUT(window->watching().earth().metadata().streams().count(), 3, kPatience_ms);
        QVERIFY(window->watching().earth().metadata().streams().isVisible());
        const int used = window->watching().earth().metadata().streams().currentIndex();
        QTRY_VERIFY(window->watching().earth().metadata().model().rowCount() > 0);
        const QString summary = window->watching().earth().metadata().summary();
        window->watching().earth().metadata().streams().setCurrentIndex((used + 1) % 3);
        QVERIFY(window->watching().earth().metadata().summary() != summary);
        // Going on in the video keeps the choice.
        QVERIFY(goTo(*window, 5));
        QCOMPARE(window->watching().earth().metadata().streams().currentIndex(), (used + 1) % 3);
    }
};

}  // namespace eyrie::ui::metadata_window_test

EYRIE_UI_TEST(QApplication, metadata_window_test, MetadataWindowTest)
#include "metadata_window_test.moc"
