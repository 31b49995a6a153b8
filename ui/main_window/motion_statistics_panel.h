#pragma once

#include <QWidget>
#include <memory>

#include "panels/histogram_chart.h"
#include "session/project_session.h"
#include "session/vector_lives.h"

class QLabel;
class QStackedLayout;

namespace eyrie::ui {

class EmptyState;

/// How often each speed occurs among motion vectors, px/frame or km/h (fig. 4.4). At most about `most_bins` bins of a
/// round width.
HistogramData speedHistogram(const std::vector<MotionVector>& vectors, const SceneScale& scale, int most_bins = 24);

/// Statistics of motion vectors: speeds in the frame shown, and how long the vectors of the run lived and belonged to
/// tracks. Reads nothing while it is not visible.
class MotionStatisticsPanel : public QWidget {
    Q_OBJECT

 public:
    /// The session must outlive the panel.
    explicit MotionStatisticsPanel(ProjectSession& session, QWidget* parent = nullptr);

    /// Whether the user sees the panel. A dock behind other tabs counts as visible for Qt.
    void setLookedAt(bool looked_at);
    const HistogramChart& speeds() const { return *speeds_; }
    const HistogramChart& lives() const { return *lives_; }

 private:
    void showFrame();
    void readLives();
    void showLives(const VectorLives& lives);

    ProjectSession& session_;
    VectorLivesReader reader_;
    bool looked_at_ = false;
    std::shared_ptr<const RunData> read_of_;  ///< the run, as far as it was done, whose lives are shown
    QStackedLayout* pages_;
    EmptyState* empty_;
    QLabel* speed_title_;
    HistogramChart* speeds_;
    QLabel* life_title_;
    HistogramChart* lives_;
};

}  // namespace eyrie::ui
