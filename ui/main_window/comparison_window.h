#pragma once

#include <QElapsedTimer>
#include <QWidget>

#include "session/comparison_loader.h"
#include "session/playback.h"
#include "session/project_session.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QSlider;
class QTableWidget;
class QTabWidget;
class QToolButton;

namespace eyrie::ui {

class OverlaySettings;
class WipeSplit;

/// A and B: two runs over the same frames, side by side or with a wipe, playing in step with one zoom; where they
/// differ and in which parameters.
class ComparisonWindow : public QWidget {
    Q_OBJECT

 public:
    /// Both must outlive the window.
    ComparisonWindow(ProjectSession& session, OverlaySettings& overlays, QWidget* parent);

    /// Chooses the runs; by default the newest two over the video shown, the current one as A.
    void choose(int first, int second);
    void goToFrame(FrameIndex frame);
    FrameIndex frame() const { return frame_; }
    WipeSplit& views() { return *views_; }
    QTableWidget& differences() { return *differences_; }
    QTableWidget& parameters() { return *parameters_; }
    Playback& playback() { return playback_; }
    /// Frames shown per second, over the last second of playing.
    double shownPerSecond() const { return shown_per_second_; }

 signals:
    void framesShown(FrameIndex frame);

 protected:
    void keyPressEvent(QKeyEvent* event) override;

 private:
    QWidget* buildHeader();
    QWidget* buildTransport();
    QWidget* buildLists();
    void fillRuns();
    void usePair();
    void showPair(const ViewFrame& first, const ViewFrame& second);
    void showComparison();
    void goToDifference(int row);
    QString runName(int run_id) const;

    ProjectSession& session_;
    ComparisonLoader loader_;
    Playback playback_;
    FrameIndex frame_ = 0;
    int shown_ = 0;  ///< frames since `since_`
    double shown_per_second_ = 0;
    QElapsedTimer since_;
    std::shared_ptr<const RunComparison> comparison_;
    std::optional<std::pair<FrameIndex, OrientedBox>> mark_;  ///< the difference that was gone to
    QString problem_;
    QComboBox* first_;
    QComboBox* second_;
    QToolButton* wipe_;
    QToolButton* play_;
    QSlider* slider_;
    QLabel* place_;
    QLabel* summary_;
    QCheckBox* detections_;
    QTabWidget* tabs_;
    QTableWidget* differences_;
    QTableWidget* parameters_;
    WipeSplit* views_;
};

}  // namespace eyrie::ui
