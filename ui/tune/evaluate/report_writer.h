#pragma once

#include <QObject>
#include <filesystem>
#include <memory>

#include "diagnosis/run_evaluation.h"
#include "report/evaluation_report.h"
#include "session/background/background_query.h"
#include "session/project/media.h"

namespace eyrie::ui {

/// Writes the report of an evaluation in the background: PDF where the name ends so, else HTML. Signals arrive on the
/// thread of this object.
class ReportWriter : public QObject {
    Q_OBJECT

 public:
    explicit ReportWriter(QObject* parent = nullptr) : QObject(parent) {}

    /// `media`: the video, for chips; without it there are none. `project` holds the run and is not overwritten, as
    /// nothing else is but another report. Answers with written() or failed(); one at a time.
    void write(const std::filesystem::path& path, std::shared_ptr<const RunEvaluation> evaluation,
               std::optional<Media> media, const std::filesystem::path& project = {});
    bool working() const { return working_; }

 signals:
    void progress(double share);
    void written(const std::filesystem::path& path);
    void failed(const QString& message);

 private:
    bool working_ = false;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

/// The same as a PDF file, A4. Throws Error(output). May be called on any thread.
void writePdfReport(const std::filesystem::path& path, const EvaluationReportFile& report);

}  // namespace eyrie::ui
