#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/values/ids.h"
#include "store/project/project_file.h"

namespace eyrie {

/// What the chain remembered after a frame; see chain/run_resume.h.
struct StoredRunState {
    FrameIndex frame = 0;
    std::string bytes;
};

/// Bytes of a state; a row of a project holds no more.
inline constexpr std::size_t kLargestRunState = ProjectFile::kLongestRow - 1'000'000;  // what else stands in its row

/// Keeps what a run needs to be gone on with when it ends early. Throws Error(project | output).
class RunStateStore {
 public:
    /// `project` must outlive the store.
    explicit RunStateStore(ProjectFile& project) : project_(project) {}

    /// The newest state of a run, if one was kept.
    std::optional<StoredRunState> newest(int run_id) const;
    /// Keeps a state in place of the one before. One that is too large for the project is not kept.
    void keep(int run_id, FrameIndex frame, const std::string& bytes);
    /// Keeps the tracks as they are; to be called before they are finished.
    void keepTracks(int run_id);
    /// Makes an ended run one that is being written again, with its tracks unfinished, in one step. Its frames after
    /// `last` stay until each is done again: whatever happens meanwhile, what was shown as done is there. Returns the
    /// last frame stored. Throws Error(project), too, when the run is finished, removed or lacks a frame up to `last`.
    FrameIndex takeUp(int run_id, FrameIndex last);

 private:
    ProjectFile& project_;
};

}  // namespace eyrie
