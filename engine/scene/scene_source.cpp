#include "scene/scene_source.h"

#include <cmath>

#include "core/scene_name.h"
#include "scene/painting/scene_renderer.h"
#include "scene/towns/scene_preset.h"

namespace eyrie {
namespace {

class SceneSource : public FrameSource {
 public:
    explicit SceneSource(SceneDescription description) : renderer_(std::move(description)) {
        const SceneDescription& scene = renderer_.scene();
        info_.path = sceneName(scene.name);
        info_.size = scene.image_size;
        info_.frame_count = scene.frame_count;
        info_.frame_rate_hz = scene.frame_rate_hz;
        info_.gsd_m_per_px = scene.gsd_m_per_px;
        info_.codec = "rendered";
        info_.container = "scene";
    }
    const VideoInfo& info() const override { return info_; }
    Frame read(FrameIndex index, bool with_colour) override {
        Frame frame = renderer_.render(index).frame;
        if (!with_colour) frame.colour.release();
        return frame;
    }
    std::int64_t timeOf(FrameIndex index) const override {
        return static_cast<std::int64_t>(std::floor(index * 1e6 / info_.frame_rate_hz + 0.5));
    }

 private:
    SceneRenderer renderer_;
    VideoInfo info_;
};

}  // namespace

std::unique_ptr<FrameSource> openScene(const std::string& name, std::uint32_t seed) {
    return std::make_unique<SceneSource>(scenePreset(name, seed));
}

}  // namespace eyrie
