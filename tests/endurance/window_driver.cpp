#include <QApplication>
#include <QElapsedTimer>
#include <QSettings>
#include <cstdio>
#include <functional>
#include <random>

#include "label/label_session.h"
#include "label/label_workspace.h"
#include "widgets/message_bar.h"
#include "window/main_window.h"
#include "workspace/window_actions.h"

/// window_driver WORD…: works in the window as a person would, without one. Words, done in order:
///   open PATH          a project, a video or a folder of images
///   video CLIP PROJECT a video with the project named
///   label N CLASS      draws N objects of the class; prints "done label CLASS I" once each is stored
///   run NAME           a run whose preset bears the name; prints "done frame NAME I" and "done run NAME"
///   show               goes through the frames of every run
///   soak SECONDS       plays, seeks, switches runs, runs again and removes the oldest run
/// Ends with 0; with 3 when something was refused (printed as "refused TEXT"); with 9 when an answer did not come.
namespace {

using eyrie::FrameIndex;
using eyrie::ui::MainWindow;
using eyrie::ui::ProjectSession;

constexpr int kPatience_ms = 50'000;  // less than those who wait for this program have

void say(const QString& line) {
    std::fprintf(stdout, "%s\n", line.toUtf8().replace('\n', ' ').constData());
    std::fflush(stdout);
}

/// An answer of the window did not come.
struct NoAnswer {
    QString to;
};

class Driver : public QObject {
    Q_OBJECT

 public:
    explicit Driver(MainWindow& window) : window_(window), session_(window.session()) {
        connect(&session_, &ProjectSession::ready, this, [this] { ++ready_; });
        connect(&session_, &ProjectSession::runFinished, this, [this] { ++runs_finished_; });
        connect(&session_, &ProjectSession::runProgress, this, [this](const eyrie::RunProgress& progress) {
            if (progress.frames_done > 0)
                say(QStringLiteral("done frame %1 %2")
                        .arg(QString::fromStdString(session_.settings().preset))
                        .arg(progress.frames_done));
        });
        connect(&session_, &ProjectSession::problem, this, &Driver::refused);
        connect(&window_.labelling().labels(), &eyrie::ui::LabelSession::problem, this, &Driver::refused);
    }

    void open(const std::string& path) {
        opening([&] { session_.open(path); });
    }
    void video(const std::string& clip, const std::string& project) {
        opening([&] { session_.openMedia(eyrie::ui::videoMedia(clip), project); });
    }
    void label(int count, const std::string& name) {
        if (!session_.video() || session_.project().empty()) return;
        const int before = refusals_;
        window_.actions().workspaceAction(eyrie::ui::WorkspaceKind::label)->trigger();
        auto& labels = window_.labelling().labels();
        until("labels", [&] { return labels.isOpen() || refusals_ > before; });
        for (int i = 0; i < count; ++i) {
            if (!labels.canEdit()) return refused(window_.messages().texts().join(QLatin1Char(' ')));
            if (!labels.apply(drawing(labels, i, name))) return;
            say(QStringLiteral("done label %1 %2").arg(QString::fromStdString(name)).arg(i + 1));
            handleEvents(0);
        }
        window_.actions().workspaceAction(eyrie::ui::WorkspaceKind::review)->trigger();
    }
    void run(const std::string& name) {
        if (!session_.video()) return;
        session_.settings().preset = name;
        session_.settings().gsd_m_per_px = 0.2;
        const int finished = runs_finished_;
        const int refusals = refusals_;
        session_.startRun();
        until("run", [&] { return runs_finished_ > finished || (refusals_ > refusals && !session_.running()); });
        until("end of the run", [&] { return !session_.running(); });
        for (const eyrie::RunRecord& record : session_.runs()) {
            if (record.preset == name && record.state == eyrie::RunState::finished)
                return say(QStringLiteral("done run %1").arg(QString::fromStdString(name)));
        }
    }
    void show() {
        const auto runs = session_.runs();
        for (const eyrie::RunRecord& record : runs) {
            session_.showRun(record.id);
            for (FrameIndex frame = 0; frame <= std::min(session_.lastFrame(), 12); frame += 3) goTo(frame);
        }
    }
    void soak(double seconds) {
        std::mt19937 random(1);
        QElapsedTimer watch;
        watch.start();
        for (int round = 0; watch.elapsed() < seconds * 1000; ++round) {
            run("soak");
            session_.togglePlay();
            pass(500);
            session_.step(0);  // pauses; on a busy machine the clip may have ended meanwhile
            for (int i = 0; i < 30; ++i) goTo(static_cast<FrameIndex>(random() % 100) % (session_.lastFrame() + 1));
            for (const eyrie::RunRecord& record : std::vector(session_.runs())) {
                session_.showRun(record.id);
                goTo(static_cast<FrameIndex>(random() % 100) % (session_.lastFrame() + 1));
            }
            // A person keeps some runs; without this the list of runs itself grows.
            if (session_.runs().size() > 4) {
                const std::size_t before = session_.runs().size();
                int oldest = session_.runs().front().id;
                for (const eyrie::RunRecord& record : session_.runs()) oldest = std::min(oldest, record.id);
                session_.removeRun(oldest);
                until("removed run", [&] { return session_.runs().size() < before; });
            }
            say(QStringLiteral("done round %1").arg(round + 1));
        }
    }
    int refusals() const { return refusals_; }

 private:
    void refused(const QString& message) {
        ++refusals_;
        say(QStringLiteral("refused ") + message);
    }
    template <class Open>
    void opening(const Open& begin) {
        const int ready = ready_;
        const int refusals = refusals_;
        begin();
        until("open", [&] { return ready_ > ready || refusals_ > refusals; });
        if (ready_ > ready) say(QStringLiteral("done open"));
    }
    void goTo(FrameIndex frame) {
        session_.goToFrame(frame);
        const int refusals = refusals_;
        until("frame", [&] { return session_.viewFrame().index == frame || refusals_ > refusals; });
    }
    /// As the program's own loop does: what is to be deleted later is deleted, which processEvents() alone never does.
    static void handleEvents(int ms) {
        QCoreApplication::processEvents(ms > 0 ? QEventLoop::WaitForMoreEvents : QEventLoop::AllEvents, ms);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }
    static void pass(int ms) {
        QElapsedTimer watch;
        watch.start();
        while (watch.elapsed() < ms) handleEvents(20);
    }
    static void until(const char* what, const std::function<bool()>& condition) {
        QElapsedTimer watch;
        watch.start();
        while (!condition()) {
            if (watch.elapsed() > kPatience_ms) throw NoAnswer{QString::fromUtf8(what)};
            handleEvents(100);
        }
    }
    static eyrie::AnnotationEdit drawing(eyrie::ui::LabelSession& labels, int number, const std::string& name) {
        eyrie::LabelledObject object;
        object.id = labels.newObjectId();
        object.object_class = name;
        eyrie::Keyframe keyframe;
        keyframe.box = {{20.0 + number % 100, 30}, 20, 10, 0};
        object.keyframes.push_back(keyframe);
        eyrie::AnnotationEdit edit;
        edit.name = "Draw";
        edit.objects.push_back({std::nullopt, object});
        return edit;
    }

    MainWindow& window_;
    ProjectSession& session_;
    int ready_ = 0;
    int runs_finished_ = 0;
    int refusals_ = 0;
};

void drive(Driver& driver, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word == "open")
            driver.open(words.at(++i));
        else if (word == "video") {
            const std::string& clip = words.at(++i);
            driver.video(clip, words.at(++i));
        } else if (word == "label") {
            const int count = std::stoi(words.at(++i));
            driver.label(count, words.at(++i));
        } else if (word == "run")
            driver.run(words.at(++i));
        else if (word == "show")
            driver.show();
        else if (word == "soak")
            driver.soak(std::stod(words.at(++i)));
        else
            throw std::out_of_range("no such word: " + word);
    }
}

}  // namespace

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    QCoreApplication::setOrganizationName(QStringLiteral("eyrie-test"));
    QCoreApplication::setApplicationName(QStringLiteral("window"));
    try {
        MainWindow window;
        window.show();
        Driver driver(window);
        drive(driver, {argv + 1, argv + argc});
        window.close();
        return driver.refusals() == 0 ? 0 : 3;
    } catch (const NoAnswer& none) {
        say(QStringLiteral("no answer: ") + none.to);
        std::_Exit(9);
    } catch (const std::out_of_range& error) {
        std::fprintf(stderr, "window_driver: %s\n", error.what());
        return 2;
    }
}

#include "window_driver.moc"
