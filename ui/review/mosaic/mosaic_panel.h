#pragma once

#include <QWidget>
#include <memory>
#include <optional>

#include "review/mosaic/mosaic_maker.h"
#include "widgets/clock_of_frames.h"

class QComboBox;
class QLabel;
class QListWidget;
class QStackedLayout;

namespace eyrie::ui {

class CoverageLegend;
class EmptyState;
class MosaicView;
class OverlaySettings;
class ProjectSession;
class WatchedGround;

/// What the mosaic works on. All must outlive it.
struct MosaicParts {
    ProjectSession& session;
    OverlaySettings& overlays;
    WatchedGround& ground;
};

/// The ground that the run saw, with the ways of all tracks over it. A click on a place lists every time it was seen
/// and every track that crossed it; a line of the list goes there. Made once somebody looks.
class MosaicPanel : public QWidget {
    Q_OBJECT

 public:
    explicit MosaicPanel(const MosaicParts& parts, QWidget* parent = nullptr);
    ~MosaicPanel() override;

    /// Whether it is in sight: nothing is made until it is.
    void setLookedAt(bool looked_at);
    MosaicView& view() { return *view_; }
    QListWidget& list() { return *list_; }
    /// By what of its coverage in time the ground is tinted; a choice each of CoverageLook.
    QComboBox& coverage() { return *coverage_; }
    const CoverageLegend& legend() const { return *legend_; }
    const std::shared_ptr<const MosaicPicture>& mosaic() const { return maker_.mosaic(); }
    /// What time it was when the frames were taken; to be given again when that is known otherwise.
    void setClock(ClockOfFrames clock);
    /// What the line above the view says.
    QString headerText() const;
    /// Lists what is known of a place of the sheet shown.
    void askAbout(QPointF on_sheet);

 private:
    void makeIfWanted();
    void showMosaic();
    void showFrame();
    void fail(const QString& message);
    void explainNothing();
    void buildBar();
    void showCoverage();
    QStringList coverageTimes() const;
    QString timeOf(FrameIndex frame) const;
    void showHistory(int sheet, const PlaceHistory& history);
    void activate(int row);

    MosaicParts parts_;
    bool looked_at_ = false;
    std::shared_ptr<const RunGround> made_of_;
    QString failure_;  ///< why nothing, or not all, was laid out; else empty
    QStackedLayout* stack_;
    EmptyState* empty_;
    QWidget* bar_;
    QLabel* header_;
    QComboBox* coverage_;
    CoverageLegend* legend_;
    QLabel* place_;
    MosaicView* view_;
    QListWidget* list_;
    ClockOfFrames clock_;
    std::optional<QPointF> asked_;  ///< the place that is listed
    MosaicMaker maker_;
    BackgroundQuery place_query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
