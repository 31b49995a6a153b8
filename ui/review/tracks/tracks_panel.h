#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "review/tracks/track_doings.h"
#include "review/tracks/track_query.h"
#include "review/tracks/tracks_model.h"
#include "widgets/tables/table_panel.h"

class QLabel;
class QSlider;
class QToolButton;

namespace eyrie::ui {

class FilterChips;

/// What the list of tracks leads to.
struct TrackListCommands {
    std::function<void(int track)> select = [](int) {};
    /// The user wants to see a track: its first frame, or the last where that was clicked.
    std::function<void(int track, int frame)> go_to = [](int, int) {};
    /// Tracks with a lower score are not to be shown anywhere.
    std::function<void(double score)> use_min_score = [](double) {};
    /// What the tracks did is asked for: setDoings().
    std::function<void()> want_doings = [] {};
    /// The chips narrow to something else, or what they ask for is known otherwise: query().
    std::function<void()> query_changed = [] {};
    /// How like the others are to this track is asked for, setLikeness(), anew when what counts changes; none: no
    /// more.
    std::function<void(std::optional<TrackId> track)> want_likeness = [](std::optional<TrackId>) {};
};

/// The tracks of the shown run: clicking one goes to it.
class TracksPanel : public TablePanel {
    Q_OBJECT
 public:
    /// `model` must outlive the panel.
    explicit TracksPanel(TracksModel* model, QWidget* parent = nullptr);
    /// What the list is for, where it is empty.
    static QString aboutText();
    void setCommands(TrackListCommands commands) { commands_ = std::move(commands); }
    /// What the menu of a row offers beside going there: commands for the selected tracks, which outlive the panel.
    void setMenuActions(QList<QAction*> actions) { menu_actions_ = std::move(actions); }
    /// Whether tracks that were never confirmed are listed; at first they are not.
    void setTentativeShown(bool shown);
    /// Tracks of a lower score are no part of the result of the run that is listed: there the slider stands until
    /// somebody moves it.
    void setThreshold(double score);
    /// How unsure tracks may be that are listed, 0 … 100 %: at 100 all are, at 40 those with a score of 0.6 or more.
    QSlider* sensitivity() const { return sensitivity_; }
    /// What narrows the list further, by speed, life, length, score, direction, events, zones, time and state.
    FilterChips& chips() { return *chips_; }
    /// The chips as they narrow what happens to tracks; null where they narrow nothing.
    std::shared_ptr<const TrackQuery> query() const;
    /// What the tracks did, for the chips; null while nobody knows.
    void setDoings(const std::shared_ptr<const DoingsByTrack>& doings);
    /// The frame that is shown, for "moving now"; while it plays, the list follows now and then.
    void setShownFrame(FrameIndex frame);
    /// Lists tracks like this one, the most like first, until the chip that says so is removed; none: does not.
    void listLike(std::optional<TrackId> track);
    /// How like tracks are to the one that was asked about; of another one it counts for nothing.
    void setLikeness(const std::shared_ptr<const LikenessByTrack>& likeness);
    /// How many of the tracks are listed, "12 of 40 tracks, 3 rejected"; neither number counts rejected ones.
    QString countText() const;

 protected:
    void rowSelected(int track) override { commands_.select(track); }
    void rowClicked(int track, int column) override { activate(track, column); }
    void rowDoubleClicked(int track) override { activate(track, TracksModel::first_column); }
    void fillMenu(QMenu& menu, int track) override;
    QString hiddenText() const override;
    bool canShowHidden() const override { return true; }
    void showHidden() override;

 private:
    void activate(int track, int column);
    void useFilter();
    void tellQuery();
    /// Brings the column of likeness and its order, or takes them away again.
    void orderByLikeness(bool wanted);
    bool isOfTheRun(const TrackSummary& track) const;
    bool isListed(const TrackSummary& track) const;
    TrackFacts facts() const;
    void filterTracks();
    void showCount();
    double minScore() const;
    void useSensitivity();
    /// Where the slider stands for a score.
    int placeOf(double score) const;
    TracksModel* tracks_;
    TrackListCommands commands_;
    QList<QAction*> menu_actions_;
    QToolButton* tentative_;
    QSlider* sensitivity_;
    QLabel* count_;
    double threshold_ = 0;
    FilterChips* chips_;
    std::shared_ptr<const DoingsByTrack> doings_;
    std::shared_ptr<const LikenessByTrack> likeness_;
    std::optional<FrameIndex> shown_frame_;
    FrameOfDay frame_of_day_;      ///< of the clock as it was when the list was filtered last
    bool told_query_ = false;      ///< there was one
    std::optional<TrackId> like_;  ///< that was asked about
    LikenessChoice like_counts_;
    bool from_the_top_ = false;                          ///< the list is to begin with the most like
    std::pair<int, Qt::SortOrder> order_before_like_{};  ///< column and order
    DelayedCall now_due_;
};

}  // namespace eyrie::ui
