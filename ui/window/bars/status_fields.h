#pragma once

#include <QPointF>
#include <QWidget>
#include <optional>

#include "session/project_session.h"

class QLabel;
class QProgressBar;
class QStatusBar;
class QToolButton;

namespace eyrie::ui {

/// The fields of the status bar: frame, time, cursor, zoom; and, while something works, its progress with a cross.
class StatusFields : public QObject {
    Q_OBJECT

 public:
    /// Adds its fields to `bar`, which owns them.
    StatusFields(ProjectSession& session, QStatusBar& bar);

    void showCursor(std::optional<QPointF> image_point);
    void showZoom(double zoom);

 private:
    void stop();
    void showFrame();
    void showRun(const RunProgress& progress);
    void showOpening(const QString& name, double share);
    void showProgress();
    void hideProgress();
    void showPreparing();

    ProjectSession& session_;
    QLabel* frame_;
    QLabel* cursor_;
    QLabel* zoom_;
    QLabel* work_;
    QProgressBar* bar_;
    QToolButton* stop_;
};

}  // namespace eyrie::ui
