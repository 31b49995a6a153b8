#include <QApplication>
#include <QComboBox>
#include <QSignalSpy>
#include <QTest>
#include <QTimer>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <string>

#include "core/error.h"
#include "formats/label_formats.h"
#include "io/video/frame_source.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"
#include "ui/window/window_with_run.h"
#include "widgets/message_bar.h"
#include "window/handover/clip_dialog.h"
#include "window/handover/track_export.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::handover_test {

using test::kPatience_ms;

/// Tracks and clips for other people, from the window.
class HandoverTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    /// Whether it was written.
    static bool write(ExportDialog& dialog) {
        QSignalSpy finished(&dialog, &ExportDialog::finishedExport);
        dialog.startExport();
        return finished.wait(kPatience_ms) && finished.front().front().toBool();
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void tracksAreWrittenInAnyFormat() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        QVERIFY(window->actions().export_tracks->isEnabled());
        const auto finished = [&] {  // the lists of the run as it ended, not as it went
            const auto& data = window->session().runData();
            return data && !data->record.live && !data->tracks.empty();
        };
        QVERIFY(QTest::qWaitFor(finished, kPatience_ms));
        int boxes = 0;
        for (const TrackSummary& track : window->session().runData()->tracks)
            if (track.confirmed && !track.doubtful) boxes += track.frames;
        QVERIFY(boxes > 0);
        ExportDialog dialog(trackExport(window->session()));
        const auto file = *home_ / "tracks.txt";
        dialog.setFormat(QStringLiteral("mot"));
        dialog.setTarget(file);
        QVERIFY2(write(dialog), qPrintable(dialog.report()));
        int written = 0;
        for (const auto& [frame, in_frame] : readLabels(file, "mot").boxes)
            written += static_cast<int>(in_frame.size());
        QCOMPARE(written, boxes);
        QVERIFY2(dialog.report().contains(QString::number(boxes)), qPrintable(dialog.report()));

        QVERIFY2(!write(dialog), "what is there is not replaced without a question");
        QVERIFY2(dialog.report().contains(QStringLiteral("would be replaced")), qPrintable(dialog.report()));
        QVERIFY2(write(dialog), qPrintable(dialog.report()));

        dialog.setTarget(window->session().project());
        QVERIFY2(!write(dialog), "the project is not overwritten");
        QVERIFY2(dialog.findChild<QComboBox*>()->findData(QStringLiteral("kw18")) >= 0, "an operator's format");
    }

    void whoExportsIsOfferedTimesMetresAndPlacesFirst() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        QString offered;
        QTimer::singleShot(0, window.get(), [&] {
            auto* dialog = qobject_cast<ExportDialog*>(QApplication::activeModalWidget());
            if (dialog == nullptr) return;
            if (const auto* formats = dialog->findChild<QComboBox*>()) offered = formats->currentData().toString();
            dialog->reject();
        });
        window->actions().export_tracks->trigger();
        QCOMPARE(offered, QStringLiteral("tracks-csv"));
    }

    void aClipHasWhatWasAskedFor() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        ProjectSession& session = window->session();
        ClipDialog dialog(session, {QStringLiteral("clip"), {20, 30}});
        const auto file = *home_ / "clip.mp4";
        const double rate_hz = session.video()->frame_rate_hz;
        for (const bool overlay : {false, true}) {
            dialog.setAround(5 / rate_hz);
            dialog.setOverlay(overlay);
            dialog.setTarget(file);
            while (!write(dialog))
                QVERIFY2(dialog.report().contains(QStringLiteral("replaced")), qPrintable(dialog.report()));
            QVERIFY2(dialog.report().contains(QStringLiteral("15 to 35")), qPrintable(dialog.report()));
            const auto clip = openSource(file);
            QCOMPARE(clip->info().frame_count, 21);
        }
        dialog.setAround(600);
        dialog.setTarget(*home_ / "all.mp4");
        QVERIFY2(write(dialog), qPrintable(dialog.report()));
        QCOMPARE(openSource(*home_ / "all.mp4")->info().frame_count, 60);
    }

    void aClipThatIsStoppedLeavesNothing() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        ClipDialog dialog(window->session(), {QStringLiteral("clip"), {0, 59}});
        dialog.setTarget(*home_ / "clip.mp4");
        QSignalSpy finished(&dialog, &ExportDialog::finishedExport);
        dialog.startExport();
        dialog.startExport();
        QVERIFY(finished.wait(kPatience_ms));
        QVERIFY2(!finished.front().front().toBool(), qPrintable(dialog.report()));
        QVERIFY(!std::filesystem::exists(*home_ / "clip.mp4"));
    }

    void whatIsStoppedIsNoFailure() {
        ExportSource source;
        source.title = QStringLiteral("Export");
        source.offers << ExportOffer{QStringLiteral("txt"), QStringLiteral("Text"), QStringLiteral("txt"), {}};
        source.files = [](const ExportWish&) { return std::vector<OutputFile>(); };
        source.begin = [](const ExportWish&) -> ExportWork {
            return [](const ExportProgress&, const std::stop_token& stop) -> std::optional<QString> {
                std::mutex mutex;
                std::unique_lock lock(mutex);
                std::condition_variable_any().wait(lock, stop, [] { return false; });
                throw Error(ErrorKind::output, "only half of it is there");
            };
        };
        ExportDialog dialog(source);
        dialog.setTarget(*home_ / "a.txt");
        QSignalSpy finished(&dialog, &ExportDialog::finishedExport);
        dialog.startExport();
        dialog.startExport();
        QVERIFY(finished.wait(kPatience_ms));
        QVERIFY(!finished.front().front().toBool());
        QVERIFY2(dialog.report().startsWith(QStringLiteral("Stopped")), qPrintable(dialog.report()));
    }

    void nothingSelectedIsSaid() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        window->session().selectTrack(std::nullopt);
        window->actions().clip_track->trigger();
        QVERIFY(window->messages().texts().join(QLatin1Char(' ')).contains(QStringLiteral("Select a track first")));
    }
};

}  // namespace eyrie::ui::handover_test

EYRIE_UI_TEST(QApplication, handover_test, HandoverTest)
#include "handover_test.moc"
