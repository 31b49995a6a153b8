#pragma once

#include <QString>
#include <array>
#include <optional>
#include <vector>

#include "core/values/frame_result.h"
#include "store/runs/run_store.h"

namespace eyrie::ui {

/// The times per stage of a run as they are drawn: stacked, frame after frame. Arithmetic only.
class StageTimesData {
 public:
    using Tops = std::array<double, kStageCount>;

    void clear();
    /// Frames ascend; one that does not is left out.
    void append(const FrameSummary& frame);

    std::size_t size() const { return frames_.size(); }
    FrameIndex frameAt(std::size_t position) const { return frames_[position].frame; }
    /// Some frames drawn as one, so that long runs draw quickly.
    struct Bin {
        double frame = 0;  ///< the middle of its frames
        Tops tops{};       ///< means over its frames
        double peak = 0;   ///< total of the slowest of its frames
    };
    /// The frames in [first, last] and one to either side, in at most `most` bins (at least one); a bin per frame when
    /// they fit.
    std::vector<Bin> bins(FrameIndex first, FrameIndex last, std::size_t most) const;

    /// Upper edge of each stage's band, ms: its own time and that of all stages before it.
    const Tops& topsAt(std::size_t position) const { return frames_[position].tops; }
    double totalAt(std::size_t position) const { return frames_[position].tops.back(); }
    double stageAt(std::size_t position, Stage stage) const;
    /// Whether the stage took any time in any frame.
    bool isUsed(Stage stage) const { return used_[static_cast<std::size_t>(stage)]; }
    /// Median ms of a stage; 0 without frames.
    double median(Stage stage) const;
    /// An upper end for the axis that a few slow frames (the first, a stalled disk) do not spoil, ms; > 0.
    double axisMaximum() const;
    /// Position of the frame, or of the last one before it; nothing before the first.
    std::optional<std::size_t> positionOf(FrameIndex frame) const;

    /// "frame 12: 23.4 ms · detection 9.1 · corners 4.0 …", the dearest stages first.
    QString describe(std::size_t position) const;
    /// A table of frames and stages for spreadsheets.
    QString text() const;

 private:
    struct Entry {
        FrameIndex frame = 0;
        Tops tops{};
    };
    std::vector<Entry> frames_;
    std::array<bool, kStageCount> used_{};
};

/// The stage's name in the user's language.
QString shownName(Stage stage);

}  // namespace eyrie::ui
