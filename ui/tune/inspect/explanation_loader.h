#pragma once

#include <QObject>
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

/// Explains places of a stored run in the background. Of several questions the newest wins. Signals arrive on the
/// thread of this object.
class ExplanationLoader : public QObject {
    Q_OBJECT

 public:
    explicit ExplanationLoader(QObject* parent = nullptr);
    ~ExplanationLoader() override;

    /// Touches neither video nor project before the first question.
    void useRun(std::optional<ReplayRun> run);
    /// Answers with explained() or failed(), unless a newer question comes first.
    void ask(FrameIndex frame, const OrientedBox& area);
    void cancel() { query_.cancel(); }

 signals:
    void explained(const std::shared_ptr<const ExplanationView>& view);
    void failed(FrameIndex frame, const QString& message);

 private:
    class Worker;
    std::unique_ptr<Worker> worker_;
    BackgroundQuery query_;  ///< last: stops before the worker goes
};

}  // namespace eyrie::ui
