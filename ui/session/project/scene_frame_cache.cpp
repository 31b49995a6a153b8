#include "session/project/scene_frame_cache.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QFileInfo>
#include <QStandardPaths>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <sstream>

#include "core/error.h"
#include "core/scene_name.h"
#include "io/atomic_file.h"
#include "io/folder.h"
#include "scene/painting/scene_renderer.h"
#include "scene/towns/scene_preset.h"

namespace eyrie::ui {

namespace fs = std::filesystem;

namespace {

/// Names the program that renders: another build may render differently.
std::string buildMark() {
    const QFileInfo program(QCoreApplication::applicationFilePath());
    return QString::number(program.lastModified().toSecsSinceEpoch(), 36).toStdString();
}

void removeFramesOfOtherBuilds(const fs::path& parent, const std::string& scene, const fs::path& kept) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(parent, ignored)) {
        const bool of_this_scene = entry.path().filename().string().starts_with(scene + "-");
        if (of_this_scene && entry.path() != kept) fs::remove_all(entry.path(), ignored);
    }
}

/// Writes a file for later, or not: then it is made again.
void keepFile(const fs::path& file, const std::string& bytes) {
    try {
        writeFileAtomically(file, bytes);
    } catch (const Error&) {
    }
}

std::optional<SceneFrameCache::Facts> readFacts(const fs::path& file) {
    if (!isFile(file)) return std::nullopt;
    std::istringstream text(readWholeFile(file));
    SceneFrameCache::Facts facts;
    text >> facts.size.width >> facts.size.height >> facts.frame_count >> facts.frame_rate_hz >> facts.gsd_m_per_px;
    const bool sound =
        text && facts.size.width > 0 && facts.size.height > 0 && facts.frame_count > 0 && facts.frame_rate_hz > 0;
    return sound ? std::optional(facts) : std::nullopt;
}

class CachedSceneSource : public FrameSource {
 public:
    CachedSceneSource(std::shared_ptr<SceneFrameCache> scene, const std::string& name) : scene_(std::move(scene)) {
        const SceneFrameCache::Facts facts = scene_->facts();
        info_.path = sceneName(name);
        info_.size = facts.size;
        info_.frame_count = facts.frame_count;
        info_.frame_rate_hz = facts.frame_rate_hz;
        info_.codec = "rendered";
        info_.container = "scene";
    }
    const VideoInfo& info() const override { return info_; }
    std::int64_t timeOf(FrameIndex index) const override { return std::llround(index * 1e6 / info_.frame_rate_hz); }
    Frame read(FrameIndex index, bool with_colour) override {
        Frame frame = scene_->frame(index);
        frame.time_us = timeOf(index);
        if (!with_colour) frame.colour.release();
        return frame;
    }

 private:
    std::shared_ptr<SceneFrameCache> scene_;
    VideoInfo info_;
};

}  // namespace

SceneFrameCache::SceneFrameCache(std::string scene, const fs::path& folder)
    : scene_(std::move(scene)), parent_(folder), folder_(folder / (scene_ + "-" + buildMark())) {}

SceneFrameCache::~SceneFrameCache() = default;

std::unique_ptr<FrameSource> SceneFrameCache::open() {
    removeFramesOfOtherBuilds(parent_, scene_, folder_);
    std::error_code ignored;  // without the folder every frame is rendered
    fs::create_directories(folder_, ignored);
    return std::make_unique<CachedSceneSource>(shared_from_this(), scene_);
}

SceneFrameCache::Facts SceneFrameCache::facts() {
    const fs::path file = folder_ / "facts.txt";
    if (const auto known = readFacts(file)) return *known;
    const SceneDescription& scene = renderer().scene();
    const Facts facts{scene.image_size, scene.frame_count, scene.frame_rate_hz, scene.gsd_m_per_px};
    std::ostringstream text;
    text << facts.size.width << ' ' << facts.size.height << ' ' << facts.frame_count << ' ' << facts.frame_rate_hz
         << ' ' << facts.gsd_m_per_px << '\n';
    keepFile(file, text.str());
    return facts;
}

Frame SceneFrameCache::frame(FrameIndex index) {
    const fs::path file = fileOf(index);
    Frame frame;
    if (isFile(file)) frame.colour = cv::imread(file.string(), cv::IMREAD_COLOR);
    if (frame.colour.empty()) {
        frame = renderer().render(index).frame;
        std::vector<uchar> png;
        cv::imencode(".png", frame.colour, png, {cv::IMWRITE_PNG_COMPRESSION, 1});
        keepFile(file, std::string(png.begin(), png.end()));
    } else {
        cv::cvtColor(frame.colour, frame.gray, cv::COLOR_BGR2GRAY);
    }
    frame.index = index;
    return frame;
}

const SceneRenderer& SceneFrameCache::renderer() {
    const std::scoped_lock lock(mutex_);
    if (!renderer_) renderer_ = std::make_unique<const SceneRenderer>(scenePreset(scene_));
    return *renderer_;
}

fs::path SceneFrameCache::fileOf(FrameIndex index) const {
    std::array<char, 24> name{};
    std::snprintf(name.data(), name.size(), "%06d.png", index);
    return folder_ / name.data();
}

fs::path sceneFolder() {
    const QString cache = QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation);
    return fs::path(cache.toStdString()) / "eyrie" / "scenes";
}

}  // namespace eyrie::ui
