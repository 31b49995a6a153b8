#include "session/kept_scene.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QFileInfo>
#include <QStandardPaths>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "io/atomic_file.h"
#include "scene/scene_preset.h"
#include "scene/scene_source.h"

namespace eyrie::ui {

namespace fs = std::filesystem;

namespace {

/// Names the program that renders: another build may render differently.
std::string buildMark() {
    const QFileInfo program(QCoreApplication::applicationFilePath());
    return QString::number(program.lastModified().toSecsSinceEpoch(), 36).toStdString();
}

void removeOldFrames(const fs::path& folder, const std::string& scene, const fs::path& kept) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const bool of_this_scene = entry.path().filename().string().starts_with(scene + "-");
        if (of_this_scene && entry.path() != kept) fs::remove_all(entry.path(), ignored);
    }
}

class KeptScene : public FrameSource {
 public:
    KeptScene(std::string scene, const fs::path& folder)
        : scene_(std::move(scene)), folder_(folder / (scene_ + "-" + buildMark())) {
        const SceneDescription description = scenePreset(scene_);
        info_.path = "scene:" + scene_;
        info_.size = description.image_size;
        info_.frame_count = description.frame_count;
        info_.frame_rate_hz = description.frame_rate_hz;
        info_.codec = "rendered";
        info_.container = "scene";
        removeOldFrames(folder, scene_, folder_);
        std::error_code ignored;  // without the folder every frame is rendered
        fs::create_directories(folder_, ignored);
    }

    const VideoInfo& info() const override { return info_; }

    std::int64_t timeOf(FrameIndex index) const override { return std::llround(index * 1e6 / info_.frame_rate_hz); }

    Frame read(FrameIndex index, bool with_colour) override {
        const fs::path file = fileOf(index);
        Frame frame;
        frame.index = index;
        frame.time_us = timeOf(index);
        frame.colour = cv::imread(file.string(), cv::IMREAD_COLOR);
        if (frame.colour.size() == info_.size) {
            cv::cvtColor(frame.colour, frame.gray, cv::COLOR_BGR2GRAY);
        } else {
            if (!renderer_) renderer_ = openScene(scene_);
            frame = renderer_->read(index, true);
            keep(frame.colour, file);
        }
        if (!with_colour) frame.colour.release();
        return frame;
    }

 private:
    fs::path fileOf(FrameIndex index) const {
        std::array<char, 24> name{};
        std::snprintf(name.data(), name.size(), "%06d.png", index);
        return folder_ / name.data();
    }

    static void keep(const cv::Mat& colour, const fs::path& file) {
        std::vector<uchar> png;
        cv::imencode(".png", colour, png, {cv::IMWRITE_PNG_COMPRESSION, 1});
        try {
            writeFileAtomically(file, std::string(png.begin(), png.end()));  // others may read it at the same time
        } catch (const Error&) {
            return;  // then it is rendered again
        }
    }

    std::string scene_;
    fs::path folder_;
    VideoInfo info_;
    std::unique_ptr<FrameSource> renderer_;  ///< made when the first frame has to be rendered
};

}  // namespace

std::unique_ptr<FrameSource> openKeptScene(const std::string& scene, const fs::path& folder) {
    return std::make_unique<KeptScene>(scene, folder);
}

fs::path sceneFolder() {
    const QString cache = QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation);
    return fs::path(cache.toStdString()) / "eyrie" / "scenes";
}

}  // namespace eyrie::ui
