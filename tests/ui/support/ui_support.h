#pragma once

#include <QAbstractButton>
#include <QCoreApplication>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QLabel>
#include <QMessageBox>
#include <QMimeData>
#include <QSettings>
#include <QStandardPaths>
#include <QTest>
#include <QUrl>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "session/project/media.h"
#include "support/temporary_folder.h"

/// What the tests of session and window share.
namespace eyrie::ui::test {

/// A user's home that vanishes: settings, data, configuration and caches of the program under test lie in it.
class OwnHome {
 public:
    OwnHome() {
        qputenv("XDG_DATA_HOME", (folder_ / "data").c_str());
        qputenv("XDG_CONFIG_HOME", (folder_ / "config").c_str());
        qputenv("XDG_CACHE_HOME", (folder_ / "cache").c_str());
        QSettings::setDefaultFormat(QSettings::IniFormat);
        QSettings::setPath(QSettings::IniFormat, QSettings::UserScope,
                           QString::fromStdString((folder_ / "config").string()));
        QCoreApplication::setOrganizationName(QStringLiteral("eyrie-test"));
        QCoreApplication::setApplicationName(QStringLiteral("window"));
    }
    std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
    eyrie::test::TemporaryFolder folder_;
};

/// Frame `index` of a small scene: a textured ground that drifts under the camera, and two bright vehicles that drive.
inline cv::Mat sceneFrame(int index, cv::Size size = {240, 180}) {
    static const cv::Mat ground = [] {
        cv::Mat noise(600, 900, CV_8UC1);
        cv::RNG random(5);
        random.fill(noise, cv::RNG::UNIFORM, 30, 160);
        cv::GaussianBlur(noise, noise, {}, 2);
        cv::normalize(noise, noise, 40, 150, cv::NORM_MINMAX);
        return noise;
    }();
    cv::Mat frame = ground({20 + index % 600, 30, size.width, size.height}).clone();
    for (int vehicle = 0; vehicle < 2; ++vehicle) {
        const int left = 20 + 3 * index + 70 * vehicle;
        const cv::Rect body(left, 50 + 60 * vehicle, 22, 11);
        if (!(body & cv::Rect({}, size)).empty()) {
            cv::rectangle(frame, body, cv::Scalar(230), cv::FILLED);
            cv::rectangle(frame, cv::Rect(left + 13, 52 + 60 * vehicle, 4, 7), cv::Scalar(20), cv::FILLED);
            cv::rectangle(frame, cv::Rect(left + 3, 53 + 60 * vehicle, 3, 5), cv::Scalar(90), cv::FILLED);
        }
    }
    return frame;
}

/// Writes the scene as a folder of images.
inline std::filesystem::path writeScene(const std::filesystem::path& folder, int frames) {
    std::filesystem::create_directories(folder);
    for (int i = 0; i < frames; ++i) {
        char name[16];
        std::snprintf(name, sizeof(name), "%04d.png", i);
        cv::imwrite((folder / name).string(), sceneFrame(i));
    }
    return folder;
}

/// The same scene without files. `before_read` is called with every frame asked for, on the thread that reads.
class SceneSource : public FrameSource {
 public:
    SceneSource(int frames, std::function<void(FrameIndex)> before_read) : before_read_(std::move(before_read)) {
        info_.path = "scene under test";
        info_.size = {240, 180};
        info_.frame_count = frames;
        info_.frame_rate_hz = 25;
    }
    const VideoInfo& info() const override { return info_; }
    Frame read(FrameIndex index, bool) override {
        if (before_read_) before_read_(index);
        Frame frame;
        frame.index = index;
        frame.time_us = timeOf(index);
        frame.gray = sceneFrame(index);
        return frame;
    }
    std::int64_t timeOf(FrameIndex index) const override { return index * std::int64_t{40'000}; }

 private:
    VideoInfo info_;
    std::function<void(FrameIndex)> before_read_;
};

inline Media sceneUnderTest(int frames, std::function<void(FrameIndex)> before_read = {}) {
    Media media;
    media.name = "scene.mp4";
    media.identity = "/nowhere/scene.mp4";
    media.gsd_m_per_px = [] { return 0.25; };
    media.open = [frames, before_read](const IndexProgress&, std::stop_token) {
        return std::make_unique<SceneSource>(frames, before_read);
    };
    return media;
}

/// Presses the button of this text in the question that is open over a window; answers whether there is one.
inline bool answer(QWidget& window, const QString& button_text) {
    for (auto* box : window.findChildren<QMessageBox*>()) {
        if (!box->isVisible()) continue;
        for (QAbstractButton* button : box->buttons()) {
            if (button->text().remove(QLatin1Char('&')) != button_text) continue;
            button->click();
            return true;
        }
    }
    return false;
}

/// Presses a button by its text; answers whether there is one.
inline bool press(QWidget& dialog, const QString& button_text) {
    for (auto* button : dialog.findChildren<QAbstractButton*>()) {
        if (button->text().remove(QLatin1Char('&')) != button_text || !button->isEnabled()) continue;
        button->click();
        return true;
    }
    return false;
}

/// Drops files on a window, as a file manager does.
inline void drop(QWidget& window, const QList<QUrl>& urls) {
    QMimeData data;
    data.setUrls(urls);
    QDragEnterEvent enter({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window, &enter);
    QDropEvent dropped({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&window, &dropped);
}
inline void drop(QWidget& window, const std::filesystem::path& file) {
    drop(window, QList<QUrl>{QUrl::fromLocalFile(QString::fromStdString(file.string()))});
}

/// Whether a label of a dialog says something.
inline bool says(const QWidget& dialog, const QString& part) {
    const auto labels = dialog.findChildren<QLabel*>();
    return std::any_of(labels.begin(), labels.end(), [&](const QLabel* label) { return label->text().contains(part); });
}

#ifdef __SANITIZE_THREAD__
inline constexpr int kPatience_ms = 900'000;
#else
inline constexpr int kPatience_ms = 60'000;  ///< for what comes sooner on any machine that works
#endif

}  // namespace eyrie::ui::test
