#pragma once

#include <QApplication>
#include <QImage>
#include <QPalette>
#include <QSettings>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QWidget>
#include <algorithm>
#include <cmath>

#include "store/runs/run_store.h"

/// What the tests of the panels share.
namespace eyrie::ui::test {

/// Keeps QSettings of a test in a folder that vanishes.
class OwnSettings {
 public:
    OwnSettings() {
        QCoreApplication::setOrganizationName(QStringLiteral("eyrie-test"));
        QCoreApplication::setApplicationName(QStringLiteral("panels"));
        QSettings::setDefaultFormat(QSettings::IniFormat);
        QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
    }

 private:
    QTemporaryDir folder_;
};

inline QPalette darkPalette() {
    QPalette palette;
    palette.setColor(QPalette::Window, QColor(45, 45, 45));
    palette.setColor(QPalette::Base, QColor(30, 30, 30));
    palette.setColor(QPalette::AlternateBase, QColor(40, 40, 40));
    palette.setColor(QPalette::Button, QColor(55, 55, 55));
    palette.setColor(QPalette::WindowText, QColor(235, 235, 235));
    palette.setColor(QPalette::Text, QColor(235, 235, 235));
    palette.setColor(QPalette::PlaceholderText, QColor(235, 235, 235, 128));
    palette.setColor(QPalette::ButtonText, QColor(235, 235, 235));
    return palette;
}

/// Ratio of luminances as WCAG 2 defines it; 4.5 and more reads well.
inline double contrast(const QColor& a, const QColor& b) {
    const auto luminance = [](const QColor& colour) {
        const auto linear = [](double v) { return v <= 0.03928 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
        return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
    };
    const double bright = std::max(luminance(a), luminance(b));
    const double dark = std::min(luminance(a), luminance(b));
    return (bright + 0.05) / (dark + 0.05);
}

/// Lets somebody look: EYRIE_TEST_PICTURES names a folder for pictures of the widgets tested.
inline void keepPicture(QWidget& widget, const QString& name) {
    const QString folder = qEnvironmentVariable("EYRIE_TEST_PICTURES");
    if (!folder.isEmpty()) widget.grab().save(folder + QLatin1Char('/') + name + QStringLiteral(".png"));
}

inline RunRecord sampleRun(int id) {
    RunRecord run;
    run.id = id;
    run.sequence.path = "/videos/street.mp4";
    run.started_utc = "2026-11-21T08:00:00Z";
    run.engine_version = "0.1.0";
    run.preset = id % 2 == 0 ? "thesis" : "default";
    run.scale = {0.25, 25, true};
    run.scale_basis = {ScaleOrigin::given};
    run.last_frame = 99;
    run.frames_done = 100;
    run.state = RunState::finished;
    return run;
}

inline TrackSummary sampleTrack(int id) {
    TrackSummary track;
    track.id = id;
    track.first_frame = 10 * id;
    track.last_frame = 10 * id + 49;
    track.frames = 50;
    track.confirmed = id % 3 != 0;
    track.mean_speed_px = 2.0 * id;
    track.mean_length_px = 18;
    track.mean_width_px = 8;
    return track;
}

template <class Record>
std::vector<Record> several(int count, Record (*make)(int)) {
    std::vector<Record> records;
    for (int id = 1; id <= count; ++id) records.push_back(make(id));
    return records;
}

}  // namespace eyrie::ui::test
