#include "session/frames/open_run.h"

#include <utility>

#include "core/error.h"
#include "store/details/kept_details.h"
#include "store/runs/doubtful_tracks.h"
#include "store/runs/stored_light.h"

namespace eyrie::ui {

OpenRun::OpenRun(const ReplayRun& run, const std::stop_token& stop)
    : pictures_(run.media.open({}, stop)),
      project_(ProjectFile::open(run.project)),
      store_(project_),
      run_id_(run.run_id) {}

RunRecord OpenRun::record() const {
    auto record = store_.run(run_id_);
    if (!record) throw Error(ErrorKind::project, "the project has no run " + std::to_string(run_id_));
    return std::move(*record);
}

ReplaySource OpenRun::source(std::function<void(FrameIndex)> about_to_read) {
    const RunRecord run = record();
    ReplaySource source;
    source.options = storedOptions(store_.parameters(run_id_));
    source.scale = run.scale;
    source.first_frame = run.first_frame;
    source.pixels = [this, about_to_read = std::move(about_to_read)](FrameIndex frame) {
        if (about_to_read) about_to_read(frame);
        return pictures_->read(frame, false);
    };
    const auto result = [this](FrameIndex frame) {
        if (!hasDetails(project_, run_id_, frame)) needDetails(project_, record());
        return this->result(frame);
    };
    source.motion_of = [result](FrameIndex frame) -> std::optional<FrameMotion> {
        auto stored = result(frame);
        if (!stored) return std::nullopt;
        return std::move(stored->motion);
    };
    source.result_of = result;
    source.evidence_of = [this](TrackId track) { return store_.doubtful().evidence(run_id_, track); };
    source.shadow_of = [this](FrameIndex frame) { return StoredLight(project_).shadowIn(run_id_, frame); };
    source.trim_of = [this](TrackId track) { return StoredLight(project_).trimOf(run_id_, track); };
    return source;
}

}  // namespace eyrie::ui
