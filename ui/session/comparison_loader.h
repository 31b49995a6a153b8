#pragma once

#include <QObject>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "evaluation/result_difference.h"
#include "session/live_preview.h"
#include "session/media.h"
#include "session/task_thread.h"
#include "view/view_frame.h"

namespace eyrie::ui {

/// Two runs of a project over one video.
struct RunPair {
    Media media;
    std::filesystem::path project;
    int first = 0;
    int second = 0;
};

/// What two runs differ in.
struct RunComparison {
    std::vector<ResultDifference> tracks;
    std::vector<ResultDifference> detections;
    std::vector<ParameterDifference> parameters;
};

/// Reads the frames of two runs together, and compares them, on its own thread. Of several frames asked for the newest
/// wins. Signals arrive on the thread of this object.
class ComparisonLoader : public QObject {
    Q_OBJECT

 public:
    explicit ComparisonLoader(QObject* parent = nullptr);
    ~ComparisonLoader() override;

    /// Opens video and project; answers with compared() or failed().
    void usePair(const RunPair& pair);
    /// Answers with loaded(), unless a newer request comes first.
    void request(FrameIndex frame);

 signals:
    void compared(const std::shared_ptr<const RunComparison>& comparison);
    /// Both show the same picture.
    void loaded(const ViewFrame& first, const ViewFrame& second);
    void failed(const QString& message);

 private:
    class Worker;
    std::unique_ptr<Worker> worker_;
    std::stop_source pair_;
    TaskThread comparing_;
    TaskThread thread_;  ///< last: stops before the worker goes
};

}  // namespace eyrie::ui
