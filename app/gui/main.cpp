#include <QApplication>
#include <QCommandLineParser>
#include <QIcon>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "core/error.h"
#include "core/values/scene_scale.h"
#include "gui/ending_signals.h"
#include "window/docks/report_printing.h"
#include "window/main_window.h"
#include "window/screenshot.h"
#include "window/theme.h"

namespace {

using eyrie::ui::StartOptions;
using eyrie::ui::ThemeChoice;

[[noreturn]] void refuse(const QString& message) {
    std::fprintf(stderr, "eyrie: %s\n", message.toLocal8Bit().constData());
    std::exit(2);
}

/// A number above 0, or 0 when the option was not given.
double positive(const QCommandLineParser& parser, const QCommandLineOption& option) {
    if (!parser.isSet(option)) return 0;
    bool understood = false;
    const double value = parser.value(option).toDouble(&understood);
    if (!understood || !std::isfinite(value) || value <= 0)
        refuse(
            QStringLiteral("--%1 %2: expected a number above 0").arg(option.names().constLast(), parser.value(option)));
    return value;
}

/// The word of the command line that Qt shows as `shown`: names of files need not be UTF-8, and text of Qt is.
std::string asGiven(const QString& shown, int argc, char** argv) {
    for (int i = 1; i < argc; ++i)
        if (QString::fromLocal8Bit(argv[i]) == shown) return argv[i];
    return shown.toStdString();
}

StartOptions readOptions(const QCoreApplication& application, int argc, char** argv) {
    QCommandLineParser parser;
    parser.setApplicationDescription(
        QStringLiteral("Finds, outlines and follows the small moving vehicles in aerial video.\n"
                       "With a video or folder of images: opens it and, unless it has a finished run, processes it.\n"
                       "With a project: shows its runs. With neither: shows the built-in demo scene."));
    parser.addHelpOption();
    parser.addVersionOption();
    parser.addPositionalArgument(
        QStringLiteral("input"),
        QStringLiteral("Video, or several files that count as one video, in their order; folder of "
                       "images; live source, by its address (udp://, rtsp:// and others) or as a camera "
                       "(/dev/video0); or "
                       "project (.eyrie)."),
        QStringLiteral("[VIDEO…|ADDRESS|PROJECT]"));
    const QCommandLineOption gsd(QStringLiteral("gsd"), QStringLiteral("Ground sampling distance, metres per pixel."),
                                 QStringLiteral("m"));
    const QCommandLineOption rate(QStringLiteral("fps"), QStringLiteral("Frames per second, for folders of images."),
                                  QStringLiteral("f"));
    const QCommandLineOption demo(QStringLiteral("demo"), QStringLiteral("Show the built-in demo scene."));
    const QCommandLineOption run(QStringLiteral("run"), QStringLiteral("Start a run even if there is a finished one."));
    const QCommandLineOption empty(QStringLiteral("empty"), QStringLiteral("Start without a video."));
    const QCommandLineOption theme(QStringLiteral("theme"), QStringLiteral("system, light or dark."),
                                   QStringLiteral("name"), QStringLiteral("system"));
    const QCommandLineOption workspace(QStringLiteral("workspace"),
                                       QStringLiteral("review, label or tune; otherwise the one that was shown last."),
                                       QStringLiteral("name"));
    const QCommandLineOption screenshot(QStringLiteral("screenshot"),
                                        QStringLiteral("Write a picture of the window and quit."),
                                        QStringLiteral("file"));
    const QCommandLineOption after(QStringLiteral("after-frames"),
                                   QStringLiteral("Frames with results to show before that picture is written (1)."),
                                   QStringLiteral("n"), QStringLiteral("1"));
    parser.addOptions({gsd, rate, demo, run, empty, theme, workspace, screenshot, after});
    parser.process(application);

    StartOptions options;
    const QStringList inputs = parser.positionalArguments();
    if (!inputs.isEmpty()) options.input = asGiven(inputs.front(), argc, argv);
    for (const QString& part : inputs.mid(1)) options.further_parts.emplace_back(asGiven(part, argc, argv));
    options.gsd_m_per_px = positive(parser, gsd);
    if (const std::string why = eyrie::whyNotAGsd(options.gsd_m_per_px); parser.isSet(gsd) && !why.empty())
        refuse(QStringLiteral("--gsd %1: %2").arg(parser.value(gsd), QString::fromStdString(why)));
    options.frame_rate_hz = positive(parser, rate);
    options.demo = parser.isSet(demo) || (inputs.isEmpty() && !parser.isSet(empty));
    options.run = parser.isSet(run);
    options.screenshot = parser.value(screenshot).toStdString();
    options.after_frames = std::max(0, parser.value(after).toInt());
    if (parser.isSet(workspace)) {
        options.workspace = eyrie::ui::workspaceOf(parser.value(workspace));
        if (!options.workspace)
            refuse(QStringLiteral("--workspace %1: expected review, label or tune").arg(parser.value(workspace)));
    }
    const QString theme_name = parser.value(theme);
    if (theme_name == QLatin1String("dark"))
        options.theme = ThemeChoice::dark;
    else if (theme_name == QLatin1String("light"))
        options.theme = ThemeChoice::light;
    else if (theme_name != QLatin1String("system"))
        refuse(QStringLiteral("--theme %1: expected system, light or dark").arg(theme_name));
    return options;
}

void nameProgram() {
    QCoreApplication::setOrganizationName(QStringLiteral("eyrie"));
    QCoreApplication::setApplicationName(QStringLiteral("eyrie"));
    QCoreApplication::setApplicationVersion(QStringLiteral(EYRIE_VERSION));
}

/// Help and version need no display.
bool asksForText(int argc, char** argv) {
    const std::array<std::string_view, 5> questions{"-h", "--help", "--help-all", "-v", "--version"};
    return std::any_of(argv + 1, argv + argc, [&](const char* argument) {
        return std::find(questions.begin(), questions.end(), argument) != questions.end();
    });
}

/// Qt would abort without a display; a reader of the message can be helped.
void needDisplay(int argc, char** argv) {
    const bool chosen =
        qEnvironmentVariableIsSet("QT_QPA_PLATFORM") || std::any_of(argv + 1, argv + argc, [](const char* argument) {
            return std::string_view(argument).starts_with("-platform");
        });
    if (chosen || qEnvironmentVariableIsSet("DISPLAY") || qEnvironmentVariableIsSet("WAYLAND_DISPLAY")) return;
    refuse(QStringLiteral("there is no display to show a window on. `eyrie-cli run` processes a video without one."));
}

/// `eyrie --print-report PACKED PDF`: how eyrie-cli has reports printed, without a window. Answers the exit code.
int printReport(const char* packed, const char* pdf) {
    try {
        eyrie::ui::printPackedReport(packed, pdf);
        return 0;
    } catch (const eyrie::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 4;
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc >= 4 && std::string_view(argv[1]) == "--print-report") {
        QGuiApplication application(argc, argv);
        nameProgram();
        return printReport(argv[2], argv[3]);
    }
    if (asksForText(argc, argv)) {
        QCoreApplication application(argc, argv);
        nameProgram();
        readOptions(application, argc, argv);
        return 0;
    }
    needDisplay(argc, argv);
    QApplication::setHighDpiScaleFactorRoundingPolicy(Qt::HighDpiScaleFactorRoundingPolicy::PassThrough);
    eyrie::EndingSignals ending;
    QApplication application(argc, argv);
    nameProgram();
    QApplication::setWindowIcon(QIcon(QStringLiteral(":/icons/eyrie.svg")));
    QApplication::setDesktopFileName(QStringLiteral("eyrie"));
    const StartOptions options = readOptions(application, argc, argv);
    eyrie::ui::Theme theme(application);
    theme.choose(options.theme);
    eyrie::ui::MainWindow window;
    window.show();
    if (!options.screenshot.empty()) eyrie::ui::takeScreenshot(window, options.screenshot, options.after_frames);
    // A stopped run asks no question, which nobody may be there to answer; its whole frames are kept.
    QObject::connect(&ending, &eyrie::EndingSignals::asked, &window, [&window] {
        window.session().stopRun();
        window.close();
        QCoreApplication::exit(0);
    });
    ending.watch();
    window.start(options);
    return QApplication::exec();
}
