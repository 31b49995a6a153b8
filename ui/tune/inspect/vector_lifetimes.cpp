#include "tune/inspect/vector_lifetimes.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "store/details/kept_details.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"

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
        if (vector.isInferred()) continue;  // lasts for one frame, and others tell its speed
        speeds_.push_back(std::hypot(vector.velocity.x, vector.velocity.y));
        Life& life = lives_[vector.id];
        ++life.frames;
        life.associated += std::any_of(result.tracks.begin(), result.tracks.end(), [&](const TrackState& state) {
            return state.status != TrackStatus::tentative && state.box.contains(vector.position, kMargin);
        });
    }
}

void VectorLifeCounter::finish() {
    std::sort(speeds_.begin(), speeds_.end());
}

VectorLifetimes VectorLifeCounter::lives() const {
    std::vector<Life> all;
    all.reserve(lives_.size());
    for (const auto& [id, life] : lives_) all.push_back(life);
    return sumOf(all);
}

VectorLifetimes VectorLifeCounter::livesOf(const std::vector<MotionVector>& vectors) const {
    std::vector<Life> all;
    for (const MotionVector& vector : vectors) {
        const auto found = lives_.find(vector.id);
        if (found != lives_.end()) all.push_back(found->second);
    }
    return sumOf(all);
}

VectorLifetimes VectorLifeCounter::sumOf(const std::vector<Life>& all) {
    VectorLifetimes lives;
    lives.vectors = static_cast<int>(all.size());
    double frames = 0;
    double associated = 0;
    int ever_associated = 0;
    for (const Life& life : all) {
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

void VectorLifetimesReader::read(const RunReference& run) {
    const auto work = [this, run](const BackgroundTask& task) {
        ProjectFile project = ProjectFile::open(run.project);
        const RunStore store(project);
        const auto record = store.run(run.run_id);
        if (!record) return;
        needDetails(project, *record);
        auto counter = std::make_shared<VectorLifeCounter>();
        for (FrameIndex frame = record->first_frame; frame < record->first_frame + record->frames_done; ++frame) {
            if (task.stop().stop_requested()) return;
            if (const auto result = store.frameResult(run.run_id, frame)) counter->add(*result);
        }
        counter->finish();
        task.tell([this, id = run.run_id, lives = std::shared_ptr<const VectorLifeCounter>(counter)] {
            emit readDone(id, lives);
        });
    };
    query_.ask(work, std::bind_front(&VectorLifetimesReader::failed, this));
}

}  // namespace eyrie::ui

#include "moc_vector_lifetimes.cpp"
