#include "cli/reports/preview_times.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "chain/chain.h"
#include "cli/reports/median.h"
#include "rerun/preview.h"
#include "store/project/project_file.h"
#include "store/runs/result_writer.h"
#include "store/runs/run_store.h"

namespace eyrie::cli {
namespace {

using Clock = std::chrono::steady_clock;

const cv::Size kSize(1024, 540);
constexpr int kRange = 30;      ///< frames over which the window follows tracks
constexpr int kPositions = 15;  ///< of each slider

double msSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::vector<Frame> enlarged(const std::vector<Frame>& frames) {
    std::vector<Frame> large = frames;
    for (Frame& frame : large) {
        frame.colour.release();
        if (frame.gray.size() != kSize) cv::resize(frame.gray, frame.gray, kSize, 0, 0, cv::INTER_CUBIC);
    }
    return large;
}

int storeRun(const std::vector<Frame>& frames, const ChainOptions& options, const SceneScale& scale,
             const std::filesystem::path& project) {
    ProjectFile::openOrCreate(project);
    RunRecord run;
    run.sequence.path = "preview";
    run.sequence.size = kSize;
    run.scale = scale;
    run.last_frame = static_cast<int>(frames.size()) - 1;
    ResultWriter writer(project, run, parameterValues(options));
    Chain chain(options, scale);
    for (const Frame& frame : frames) writer.write(chain.next(frame));
    writer.finish(RunState::finished, "");
    return writer.runId();
}

}  // namespace

PreviewTimes measurePreview(const std::vector<Frame>& frames, const ChainOptions& options, SceneScale scale,
                            const std::filesystem::path& project_path) {
    PreviewTimes times;
    times.size = kSize;
    scale.gsd_m_per_px *= static_cast<double>(frames.front().gray.cols) / kSize.width;
    const std::vector<Frame> large = enlarged(frames);
    const int run = storeRun(large, options, scale, project_path);
    ProjectFile project = ProjectFile::open(project_path, ProjectFile::Mode::read_only);
    const RunStore store(project);
    ReplaySource source;
    source.options = options;
    source.scale = scale;
    source.pixels = [&](FrameIndex frame) { return large.at(static_cast<std::size_t>(frame)); };
    source.result_of = [&](FrameIndex frame) { return store.frameResult(run, frame); };
    Preview preview(source);
    const auto last = static_cast<FrameIndex>(large.size()) - 1;
    const int range = std::min(kRange, last);
    const auto slide = [&](const std::string& name, const std::function<void(ChainOptions&, int)>& move) {
        PreviewTimes::Moved moved;
        moved.parameter = name;
        std::vector<double> first;
        std::vector<double> final;
        for (int i = 1; i <= kPositions; ++i) {
            ChainOptions changed = options;
            move(changed, i);
            auto start = Clock::now();
            preview.now(last, changed, range, {});
            first.push_back(msSince(start));
            if (times.first_ms == 0) times.first_ms = first.back();
            if (i % 5 != 0) continue;
            start = Clock::now();
            preview.withTracks(last, changed, range, {}, {});
            final.push_back(msSince(start));
        }
        moved.median_ms = medianOf(first);
        moved.longest_ms = *std::max_element(first.begin(), first.end());
        moved.final_ms = medianOf(final);
        times.moved.push_back(std::move(moved));
    };
    slide("gradient.quantile", [](ChainOptions& o, int i) { o.detection.gradient.quantile *= 1 + 0.02 * i; });
    slide("sliding_window.decision_threshold",
          [](ChainOptions& o, int i) { o.detection.sliding_window.decision_threshold += 0.05 * i; });
    slide("clustering.along", [](ChainOptions& o, int i) { o.clustering.along_m *= 1 + 0.02 * i; });
    slide("motion.min_speed", [](ChainOptions& o, int i) { o.motion.min_speed_m_s *= 1 + 0.02 * i; });
    slide("tracking.min_overlap", [](ChainOptions& o, int i) { o.tracking.min_overlap *= 1 + 0.02 * i; });
    return times;
}

}  // namespace eyrie::cli
