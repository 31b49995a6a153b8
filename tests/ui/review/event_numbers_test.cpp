#include <QTableView>
#include <QTest>
#include <map>
#include <tuple>

#include "events/review/reviewed_run.h"
#include "review/events/event_text.h"
#include "review/events/events_panel.h"
#include "support/places.h"
#include "support/process.h"
#include "support/written_run.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "widgets/tables/table_roles.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::event_numbers_test {

namespace {

constexpr int kFrames = 300;

/// A vehicle that drives through, one that stops, and one that is lost in mid-picture at the end of all that.
void drive(int frame, FrameResult& result) {
    result.motion.time_us = frame * std::int64_t{40'000};
    const auto add = [&](TrackId id, double x, double y) {
        TrackState track;
        track.id = id;
        track.box = {{x, y}, 22, 9, 0};
        track.status = TrackStatus::confirmed;
        result.tracks.push_back(track);
    };
    if (frame >= 10 && frame < 110) add(1, 3 * (frame - 10.0), 60);
    if (frame >= 20) add(2, std::min(200.0, 2 * (frame - 20.0)), 120);
    if (frame >= 80 && frame < 180) add(3, 1.5 * (frame - 80.0), 180);
}

/// Kind, frame and tracks of events by their numbers, as `eyrie-cli events --csv` tells them.
std::map<int, std::string> numbersOnTheCommandLine(const std::filesystem::path& project,
                                                   const std::filesystem::path& csv) {
    const auto result = eyrie::test::runProcess(
        {eyrie::test::programPath("eyrie-cli"), "events", "--project", project.string(), "--csv", csv.string()});
    if (result.exit_code != 0) qWarning("%s", result.errors.c_str());
    std::map<int, std::string> found;
    std::ifstream file(csv);
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        QStringList words = QString::fromStdString(line).split(QLatin1Char(','));
        found[words[words.size() - 2].toInt()] = (words[0] + ' ' + words[1] + ' ' + words[6]).toStdString();
    }
    return found;
}

}  // namespace

/// One number for one event, wherever it is told.
class EventNumbersTest : public QObject {
    Q_OBJECT

 private slots:
    void theListAndTheCommandLineNumberEventsAlike() {
        const test::OwnHome home;
        const RunRecord record = eyrie::test::writeRun(home / "p.eyrie", kFrames, drive);
        ProjectFile project = ProjectFile::open(home / "p.eyrie");
        const auto run = std::make_shared<const StoredTracks>(readTracks(RunStore(project), record));
        const auto found = findAndOrder(run, {}, {});
        EventsModel model;
        model.setEvents(found, [](std::size_t) { return nullptr; });
        OverlaySettings overlays;
        QWidget window;
        const WindowActions actions(overlays, &window);
        EventsPanel panel(&model, actions);
        panel.resize(600, 400);
        panel.show();

        const auto numbers = numbersOnTheCommandLine(home / "p.eyrie", home / "events.csv");
        QVERIFY(numbers.size() >= 5);
        const auto* list = panel.table()->model();
        QCOMPARE(panel.listedNumbers().size(), numbers.size());
        for (int row = 0; row < model.rowCount(); ++row) {  // also what stands in the row of its stop
            const int number = model.index(row, EventsModel::number_column).data().toInt();
            const int track = model.index(row, EventsModel::tracks_column).data().toInt();
            QVERIFY2(numbers.contains(number), std::to_string(number).c_str());
            const QString kind = eventKindText(*found, static_cast<std::size_t>(row)).toLower();
            const int frame = model.index(row, EventsModel::time_column).data(sort_role).toInt();
            QCOMPARE(QStringLiteral("%1 %2 %3").arg(kind).arg(frame).arg(track).toStdString(), numbers.at(number));
        }
        const auto numberIn = [&](int row) { return list->index(row, EventsModel::number_column).data().toInt(); };
        std::vector<int> in_list;
        for (int row = 0; row < list->rowCount(); ++row) in_list.push_back(numberIn(row));
        QVERIFY2(in_list.size() < numbers.size(), "a stop is one row");
        QCOMPARE(list->index(0, EventsModel::kind_column).data().toString(), QStringLiteral("Lost"));
        QVERIFY2(in_list.front() != 1, "what is looked at first is not what happened first");

        panel.table()->sortByColumn(EventsModel::number_column, Qt::AscendingOrder);
        for (int row = 1; row < list->rowCount(); ++row) QVERIFY(numberIn(row - 1) < numberIn(row));
        panel.table()->sortByColumn(-1, Qt::AscendingOrder);
        for (int row = 0; row < list->rowCount(); ++row)
            QCOMPARE(numberIn(row), in_list[static_cast<std::size_t>(row)]);
    }
};

}  // namespace eyrie::ui::event_numbers_test

EYRIE_UI_TEST(QApplication, event_numbers_test, EventNumbersTest)
#include "event_numbers_test.moc"
