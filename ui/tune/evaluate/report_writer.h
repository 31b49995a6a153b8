#pragma once

#include <QString>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>

#include "diagnosis/run_evaluation.h"
#include "report/evaluation_report.h"
#include "session/background/background_query.h"
#include "session/project/media.h"

namespace eyrie::ui {

/// What becomes of a report that a ReportWriter was asked for.
struct ReportAnswers {
    std::function<void(double share)> show_progress;
    std::function<void(const std::filesystem::path& path)> tell_written;
    std::function<void(const QString& message)> fail;
};

/// Writes the report of an evaluation in the background: PDF where the name ends so, else HTML. Answers arrive on the
/// thread it was made on.
class ReportWriter {
 public:
    explicit ReportWriter(ReportAnswers answers) : answers_(std::move(answers)) {}

    /// `media`: the video, for chips; without it there are none. `project` holds the run and is not overwritten, as
    /// nothing else is but another report. One at a time.
    void write(const std::filesystem::path& path, std::shared_ptr<const RunEvaluation> evaluation,
               std::optional<Media> media, const std::filesystem::path& project = {});
    bool working() const { return working_; }

 private:
    ReportAnswers answers_;
    bool working_ = false;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

/// The same as a PDF file, A4. Throws Error(output). May be called on any thread.
void writePdfReport(const std::filesystem::path& path, const EvaluationReportFile& report);

}  // namespace eyrie::ui
