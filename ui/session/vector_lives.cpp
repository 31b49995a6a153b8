#include "session/vector_lives.h"

#include <algorithm>
#include <exception>

#include "session/queued_call.h"
#include "store/project_file.h"
#include "store/run_store.h"

namespace eyrie::ui {

namespace {

constexpr int kFirstBin = 10;  ///< frames
constexpr int kBin = 50;       ///< frames
constexpr double kMargin = 1;  ///< px; corners lie on outlines

void count(std::vector<int>& bins, int frames) {
    const auto bin = static_cast<std::size_t>(lifeBin(frames));
    if (bins.size() <= bin) bins.resize(bin + 1);
    ++bins[bin];
}

}  // namespace

int lifeBin(int frames) {
    return frames <= kFirstBin ? 0 : 1 + (frames - 1) / kBin;
}

QString lifeBinText(int bin) {
    if (bin == 0) return QStringLiteral("≤ %1").arg(kFirstBin);
    return QStringLiteral("%1–%2").arg(bin == 1 ? kFirstBin + 1 : (bin - 1) * kBin + 1).arg(bin * kBin);
}

void VectorLifeCounter::add(const FrameResult& result) {
    for (const MotionVector& vector : result.motion.motion_vectors) {
        Life& life = lives_[vector.id];
        ++life.frames;
        life.associated += std::any_of(result.tracks.begin(), result.tracks.end(), [&](const TrackState& state) {
            return state.status != TrackStatus::tentative && state.box.contains(vector.position, kMargin);
        });
    }
}

VectorLives VectorLifeCounter::lives() const {
    VectorLives lives;
    lives.vectors = static_cast<int>(lives_.size());
    double frames = 0;
    double associated = 0;
    int ever_associated = 0;
    for (const auto& [id, life] : lives_) {
        count(lives.life, life.frames);
        frames += life.frames;
        if (life.associated == 0) continue;
        count(lives.association, life.associated);
        associated += life.associated;
        ++ever_associated;
    }
    lives.association.resize(std::max(lives.life.size(), lives.association.size()));
    lives.mean_life = lives.vectors > 0 ? frames / lives.vectors : 0;
    lives.mean_association = ever_associated > 0 ? associated / ever_associated : 0;
    return lives;
}

void VectorLivesReader::read(const RunReference& run) {
    request_.request_stop();
    request_ = std::stop_source();
    thread_.postNewest([this, run, stop = request_.get_token()](const std::stop_token& end) {
        try {
            ProjectFile project = ProjectFile::open(run.project);
            const RunStore store(project);
            const auto record = store.run(run.run_id);
            if (!record) return;
            VectorLifeCounter counter;
            for (FrameIndex frame = record->first_frame; frame < record->first_frame + record->frames_done; ++frame) {
                if (stop.stop_requested() || end.stop_requested()) return;
                if (const auto result = store.frameResult(run.run_id, frame)) counter.add(*result);
            }
            queuedCall(this, [this, id = run.run_id, lives = std::make_shared<const VectorLives>(counter.lives())] {
                emit readDone(id, lives);
            });
        } catch (const std::exception& error) {
            queuedCall(this, [this, message = QString::fromUtf8(error.what())] { emit failed(message); });
        }
    });
}

}  // namespace eyrie::ui
