#pragma once

#include <QElapsedTimer>
#include <QWidget>

#include "session/frames/playback.h"
#include "session/project_session.h"
#include "tune/compare/comparison_loader.h"
#include "widgets/delayed_call.h"

class QCheckBox;
class QLabel;
class QSlider;
class QTableWidget;
class QTabWidget;
class QToolButton;

namespace eyrie::ui {

class ComparisonHeader;
class OverlaySettings;
class PresetLibrary;
class WipeSplit;

/// A and B: two runs or sets of parameters over the same frames, side by side or with a wipe, playing in step with one
/// zoom; where they differ and in which parameters.
class ComparisonWindow : public QWidget {
    Q_OBJECT

 public:
    /// All must outlive the window.
    ComparisonWindow(ProjectSession& session, PresetLibrary& presets, OverlaySettings& overlays, QWidget* parent);

    /// Chooses two runs; by default the newest two over the video shown, the current one as A.
    void choose(int first, int second);
    ComparisonHeader& header() { return *header_; }
    /// The parameters of the form may have changed: where they are compared they are computed anew.
    void parametersEdited();
    /// The same once no other change follows for a moment.
    void parametersEditedSoon() { edited_.start(); }
    void goToFrame(FrameIndex frame);
    FrameIndex frame() const { return frame_; }
    WipeSplit& views() { return *views_; }
    /// What the two views draw.
    const OverlaySettings& drawn() const { return *drawn_; }
    QCheckBox& detections() { return *detections_; }
    QTableWidget& differences() { return *differences_; }
    QTableWidget& parameters() { return *parameters_; }
    Playback& playback() { return playback_; }
    /// Frames shown per second, over the last second of playing.
    double shownPerSecond() const { return shown_per_second_; }

 signals:
    void framesShown(FrameIndex frame);

 protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

 private:
    QWidget* buildTransport();
    QWidget* buildLists();
    ComparisonAnswers answers();
    /// Draws what the window does, and always what is compared: tracks or detections.
    void followOverlays();
    void playOn(FrameIndex frame);
    void usePair();
    void showPair(const ViewFrame& first, const ViewFrame& second);
    void showComparison();
    void goToDifference(int row);

    ProjectSession& session_;
    const OverlaySettings& overlays_;  ///< of the window
    OverlaySettings* drawn_;           ///< of the two views
    ComparisonLoader loader_;
    Playback playback_;
    FrameIndex frame_ = 0;
    int shown_ = 0;  ///< frames since `since_`
    double shown_per_second_ = 0;
    QElapsedTimer since_;
    std::shared_ptr<const SideComparison> comparison_;
    std::optional<ComparisonPair> pair_;
    DelayedCall edited_;                                      ///< computes anew once the hand rests
    std::optional<std::pair<FrameIndex, OrientedBox>> mark_;  ///< the difference that was gone to
    QString problem_;
    ComparisonHeader* header_;
    QToolButton* play_;
    QSlider* slider_;
    QLabel* place_;
    QCheckBox* detections_;
    QTabWidget* tabs_;
    QTableWidget* differences_;
    QTableWidget* parameters_;
    WipeSplit* views_;
};

}  // namespace eyrie::ui
