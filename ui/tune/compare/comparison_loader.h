#pragma once

#include <QString>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "canvas/view_frame.h"
#include "chain/chain_run.h"
#include "evaluation/comparison/result_difference.h"
#include "session/background/background_query.h"
#include "session/project/media.h"
#include "tune/compare/live_preview.h"

namespace eyrie::ui {

/// What is compared: a run as it was stored, or what other parameters find on its motion vectors.
struct ComparisonSide {
    int run_id = 0;
    std::shared_ptr<const ChainOptions> options;  ///< null: as it was stored
};

/// Two sides over one video.
struct ComparisonPair {
    Media media;
    std::filesystem::path project;
    ComparisonSide first;
    ComparisonSide second;
    FrameRange range;  ///< compared where a side is computed; stored runs are compared as a whole

    bool computes() const { return first.options || second.options; }
};

/// What two sides differ in.
struct SideComparison {
    std::vector<ResultDifference> tracks;
    std::vector<ResultDifference> detections;
    std::vector<ParameterDifference> parameters;
    bool exact = true;  ///< computed sides are what whole runs with their parameters would be
};

/// What becomes of what a ComparisonLoader was asked for.
struct ComparisonAnswers {
    std::function<void(const std::shared_ptr<const SideComparison>& comparison)> show_comparison;
    /// Both show the same picture.
    std::function<void(const ViewFrame& first, const ViewFrame& second)> show;
    /// More frames of computed sides are there.
    std::function<void(int frames_done, int frames_total)> show_progress;
    std::function<void(const QString& message)> fail;
};

/// Reads or computes the frames of two sides together, and compares them, in the background. Of several frames asked
/// for the newest wins. Answers arrive on the thread it was made on.
class ComparisonLoader {
 public:
    explicit ComparisonLoader(ComparisonAnswers answers);
    ~ComparisonLoader();

    /// Opens video and project; shows the comparison or fails. Computed sides grow meanwhile.
    void usePair(const ComparisonPair& pair);
    /// Shows it, unless a newer request comes first. A side that has no such frame yet has no result.
    void request(FrameIndex frame);
    void cancel();

 private:
    class Worker;
    ComparisonAnswers answers_;
    std::unique_ptr<Worker> worker_;
    std::stop_source opening_;
    BackgroundQuery comparing_;
    BackgroundQuery query_;  ///< last: stops before the worker goes
};

}  // namespace eyrie::ui
