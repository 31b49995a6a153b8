#pragma once

#include <QString>
#include <functional>
#include <memory>
#include <optional>

#include "explain/explanation.h"
#include "session/background/background_query.h"
#include "session/frames/open_run.h"

namespace eyrie::ui {

/// What was asked about one place, and the answer. Shared between threads, never changed once published.
struct ExplanationView {
    FrameIndex frame = 0;
    OrientedBox area;
    Explanation told;
    CornerVerdicts corners;  ///< on the corners in and around the area
};

/// What becomes of what an ExplanationLoader was asked.
struct ExplanationAnswers {
    std::function<void(const std::shared_ptr<const ExplanationView>& view)> show;
    std::function<void(const QString& message)> fail;
};

/// Explains places of a stored run in the background. Of several questions the newest wins. Answers arrive on the
/// thread it was made on.
class ExplanationLoader {
 public:
    explicit ExplanationLoader(ExplanationAnswers answers);
    ~ExplanationLoader();

    /// Touches neither video nor project before the first question.
    void useRun(std::optional<ReplayRun> run);
    /// Shows it or fails, unless a newer question comes first.
    void ask(FrameIndex frame, const OrientedBox& area);
    void cancel() { query_.cancel(); }

 private:
    class Worker;
    ExplanationAnswers answers_;
    std::unique_ptr<Worker> worker_;
    BackgroundQuery query_;  ///< last: stops before the worker goes
};

}  // namespace eyrie::ui
