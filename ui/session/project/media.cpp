#include "session/project/media.h"

#include "session/project/scene_frame_cache.h"

namespace eyrie::ui {

namespace fs = std::filesystem;

namespace {
const std::string kScenePrefix = "scene:";
}

Media videoMedia(const fs::path& path, FrameRate rate) {
    std::error_code no_such_path;
    fs::path absolute = fs::weakly_canonical(path, no_such_path);
    if (no_such_path) absolute = fs::absolute(path);
    if (!absolute.has_filename()) absolute = absolute.parent_path();
    Media media;
    media.name = absolute.filename().string();
    media.identity = absolute.string();
    media.gsd_m_per_px = [] { return 0.0; };
    media.given_rate_hz = rate.given_hz;
    media.open = [absolute, rate](const IndexProgress& progress, std::stop_token stop) {
        SourceOptions options;
        options.frame_rate_hz = rate.given_hz;
        options.remembered_rate_hz = rate.remembered_hz;
        return openSource(absolute, options, progress, std::move(stop));
    };
    return media;
}

Media sceneMedia(const std::string& scene) {
    Media media;
    media.name = scene + " scene";
    media.identity = kScenePrefix + scene;
    const auto kept = std::make_shared<SceneFrameCache>(scene, sceneFolder());
    media.gsd_m_per_px = [kept] { return kept->facts().gsd_m_per_px; };
    media.open = [kept](const IndexProgress&, std::stop_token) { return kept->open(); };
    return media;
}

bool isScene(const std::string& identity) {
    return identity.starts_with(kScenePrefix);
}

Media mediaOfIdentity(const std::string& identity, FrameRate rate) {
    if (isScene(identity)) return sceneMedia(identity.substr(kScenePrefix.size()));
    return videoMedia(identity, rate);
}

std::function<cv::Mat(FrameIndex)> grayReader(FrameSource& source) {
    return [&source](FrameIndex frame) {
        try {
            return source.read(frame, false).gray;
        } catch (const std::exception&) {
            return cv::Mat();
        }
    };
}

}  // namespace eyrie::ui
