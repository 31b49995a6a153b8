#pragma once

#include <QObject>

class QWidget;

namespace eyrie::ui {

class CardDock;
class DockRegistry;
class EarthDock;
class EventsDock;
class LikeTracks;
class MessageBar;
class MosaicPanel;
class OverlaySettings;
class ProjectSession;
class ReviewDocks;
class SeenWatch;
class SteadyWatch;
class TimelineView;
class VideoView;
class WatchCommands;
class WatchedGround;
class WindowActions;

/// What watching works on. All must outlive it.
struct WatchingParts {
    ProjectSession& session;
    VideoView& canvas;
    TimelineView& timeline;
    ReviewDocks& review;
    EventsDock& events;
    DockRegistry& docks;
    WindowActions& actions;
    MessageBar& messages;
    OverlaySettings& overlays;
    QWidget& window;  ///< owns it
};

/// What an operator watches a run with: the ground under its tracks and all that is read off it (the steady view, the
/// mosaic, the card, tracks like one), where the video lies on the earth, and which frames were watched.
class WatchingDocks : public QObject {
    Q_OBJECT

 public:
    explicit WatchingDocks(const WatchingParts& parts);

    WatchedGround& ground() { return *ground_; }
    EarthDock& earth() { return *earth_; }
    WatchCommands& commands() { return *commands_; }
    SeenWatch& seen() { return *seen_; }
    CardDock& card() { return *card_; }
    MosaicPanel& mosaic() { return *mosaic_; }
    /// Labelling has tools and a ground of its own.
    void setActive(bool active);
    /// What can be used depends on whether there is a video.
    void enableActions();

 private:
    void showGround();
    void wireMosaic();

    WatchingParts parts_;
    WatchedGround* ground_;
    LikeTracks* like_;
    EarthDock* earth_;
    SteadyWatch* steady_;
    WatchCommands* commands_;
    SeenWatch* seen_;
    CardDock* card_;
    MosaicPanel* mosaic_;
};

}  // namespace eyrie::ui
