#pragma once

#include <QWidget>
#include <array>
#include <vector>

#include "widgets/charts/stage_times_data.h"

class QCPGraph;
class QCPItemStraightLine;
class QCPLayoutGrid;
class QCustomPlot;
class QLabel;
class QStackedLayout;

namespace eyrie::ui {

class EmptyState;

/// Milliseconds per stage over the frames of a run, as bands on top of each other. The wheel zooms and dragging moves
/// along the frames, a click goes to a frame, a double click shows everything again.
class StageTimesChart : public QWidget {
    Q_OBJECT
 public:
    explicit StageTimesChart(QWidget* parent = nullptr);
    ~StageTimesChart() override;

    /// Shows a run. Cheap when `frames` only continues what is shown.
    void setFrames(const std::vector<FrameSummary>& frames);
    /// Adds the newest frame of a run that works.
    void append(const FrameSummary& frame);
    void clear();
    /// Marks the frame that the canvas shows.
    void setCurrentFrame(FrameIndex frame);
    /// A line at the time a frame may take to keep up with the video, ms; 0: none.
    void setBudgetMs(double ms);

    const StageTimesData& data() const { return data_; }
    QPixmap picture() const;
    /// Whether it will be drawn again with what it was given last.
    bool refreshDue() const { return refresh_scheduled_; }
    QString text() const { return data_.text(); }

 signals:
    void frameActivated(int frame);

 protected:
    void changeEvent(QEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

 private:
    void makePlot();
    void connectPlot();
    void placeLegend(bool below);
    void arrangeLegend();
    void fillGraphs();
    void refreshLater();
    void refresh();
    void listUsedStages();
    void showAll();
    void applyColours();
    void describeFrame(FrameIndex frame);
    void copyPicture() const;
    void copyText() const;

    StageTimesData data_;
    QStackedLayout* stack_;
    EmptyState* empty_;
    QLabel* readout_;
    QCustomPlot* plot_;
    QCPLayoutGrid* side_ = nullptr;  ///< holds the legend
    bool legend_below_ = false;
    std::array<QCPGraph*, kStageCount> graphs_{};
    QCPGraph* peaks_ = nullptr;  ///< the slowest frame where several are drawn as one
    QCPItemStraightLine* marker_ = nullptr;
    QCPItemStraightLine* budget_ = nullptr;
    FrameIndex current_frame_ = 0;
    bool follows_ = true;  ///< shows all frames; false once the user zoomed or moved
    bool refresh_scheduled_ = false;
};

}  // namespace eyrie::ui
