#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>

#include "canvas/view_frame.h"
#include "correction/corrected_tracks.h"
#include "session/background/lru_cache.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"

namespace eyrie::ui {

/// How much of a run's registration is kept in memory.
struct HomographyBlocks {
    int frames = 256;      ///< read at once
    std::size_t most = 8;  ///< kept
};

/// The frames of one stored run, by an own connection; a few are kept in memory. For one thread. Throws Error.
class StoredFrames {
 public:
    /// `corrected`: what people made of the run's tracks; null: they are shown as they are.
    StoredFrames(const std::filesystem::path& project, int run_id, int trail_length,
                 std::shared_ptr<const CorrectedTracks> corrected = {}, HomographyBlocks blocks = {});

    /// Fills result, scale, trails and, if it has none, time; leaves the frame as it is when the run does not have it.
    void addTo(ViewFrame& frame);
    /// Reads a frame into memory for later; false when the run does not have it.
    bool prepare(FrameIndex frame);

 private:
    std::shared_ptr<const FrameResult> result(FrameIndex frame);
    std::vector<Trail> trails(FrameIndex frame);
    const Homography* homography(FrameIndex frame);  ///< valid until the next call

    ProjectFile project_;
    RunStore store_;
    int run_id_;
    int trail_length_;
    std::shared_ptr<const CorrectedTracks> corrected_;  ///< never null
    SceneScale scale_;
    LruCache<FrameIndex, std::shared_ptr<const FrameResult>> results_;
    /// Of some consecutive frames: current from previous, by current frame.
    struct HomographyBlock {
        std::map<FrameIndex, Homography> known;
        FrameIndex next = 0;  ///< the first that was not read; the run may be at work
    };
    HomographyBlocks blocks_;
    std::map<int, HomographyBlock> homographies_;  ///< by number; a few
};

}  // namespace eyrie::ui
