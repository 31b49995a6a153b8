#pragma once

#include <QWidget>
#include <memory>

#include "session/project_session.h"
#include "tune/inspect/vector_lifetimes.h"
#include "widgets/charts/histogram_chart.h"

class QComboBox;
class QLabel;
class QStackedLayout;

namespace eyrie::ui {

class EmptyState;

/// How often each speed occurs among motion vectors of these speeds, in px/frame or km/h (fig. 4.4). At most about
/// `most_bins` bins of a round width.
HistogramData speedHistogramOf(std::vector<double> speeds_px, const SceneScale& scale, int most_bins = 24);

/// Statistics of the motion vectors of the frame shown or of the run: how fast they are, how long they live, and how
/// long they belong to tracks. Reads nothing while it is not visible.
class MotionStatisticsPanel : public QWidget {
    Q_OBJECT

 public:
    /// The session must outlive the panel.
    explicit MotionStatisticsPanel(ProjectSession& session, QWidget* parent = nullptr);

    /// Whether the user sees the panel. A dock behind other tabs counts as visible for Qt.
    void setLookedAt(bool looked_at);
    const HistogramChart& speeds() const { return *speeds_; }
    const HistogramChart& lives() const { return *lives_; }
    QString speedTitle() const;
    QString lifeTitle() const;
    void showWholeRun(bool whole);

 private:
    void showFrame();
    void readLives();
    void showSpeeds();
    void showLives();
    bool wholeRun() const;

    ProjectSession& session_;
    VectorLifetimesReader reader_;
    bool looked_at_ = false;
    std::shared_ptr<const RunData> read_of_;              ///< the run, as far as it was done, whose lives are shown
    std::shared_ptr<const VectorLifeCounter> counted_;    ///< of that run; null until it was read
    std::shared_ptr<const VectorLifeCounter> shown_run_;  ///< whose whole statistics are shown
    QComboBox* scope_;
    QStackedLayout* pages_;
    EmptyState* empty_;
    QLabel* speed_title_;
    HistogramChart* speeds_;
    QLabel* life_title_;
    HistogramChart* lives_;
};

}  // namespace eyrie::ui
