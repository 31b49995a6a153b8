#pragma once

#include <QString>
#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <utility>
#include <vector>

#include "diagnosis/run_evaluation.h"
#include "report/evaluation_report.h"
#include "session/background/background_query.h"
#include "session/project/media.h"

class QWidget;

namespace eyrie::ui {

/// What becomes of a report that a ReportWriter was asked for.
struct ReportAnswers {
    std::function<void(double share)> show_progress;
    std::function<void(const std::filesystem::path& path)> tell_written;
    std::function<void(const QString& message)> fail;
    /// Nothing was written, as stop() asked.
    std::function<void()> tell_stopped = [] {};
};

/// A report that is to be made and written.
struct WantedReport {
    std::filesystem::path path;
    std::vector<std::filesystem::path> read;  ///< what it is made from, and is not overwritten
    std::optional<Media> media;               ///< the video, for pictures; without it there are none
    /// Makes it on a thread of its own; `pixels` is null where the video cannot be read.
    std::function<ReportFile(FrameSource* pixels, const std::function<void(double)>& progress,
                             const std::stop_token& stop)>
        make;
};

/// Asks for a file to write a report to, suggested as `name` in the folder of the last one; empty when nobody chose.
QString askForReportFile(QWidget& window, const QString& name);

/// Writes reports in the background: PDF where the name ends so, else HTML. Answers arrive on the
/// thread it was made on.
class ReportWriter {
 public:
    explicit ReportWriter(ReportAnswers answers) : answers_(std::move(answers)) {}

    /// Nothing but another report is overwritten. One at a time.
    void write(WantedReport wanted);
    /// The report of an evaluation. `media`: the video, for chips. `project` holds the run.
    void write(const std::filesystem::path& path, const std::shared_ptr<const RunEvaluation>& evaluation,
               std::optional<Media> media, const std::filesystem::path& project = {});
    bool working() const { return working_; }
    /// What is said to who asks for another one meanwhile.
    static QString workingText();
    /// Gives up the report that is being written; what was under its name stays.
    void stop() { writing_.request_stop(); }

 private:
    ReportAnswers answers_;
    bool working_ = false;
    std::stop_source writing_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

/// The same as a PDF file, A4. Throws Error(output). May be called on any thread.
void writePdfReport(const std::filesystem::path& path, const ReportFile& report);

}  // namespace eyrie::ui
