#pragma once

#include <QPointer>
#include <QWidget>
#include <functional>
#include <memory>

#include "review/tracks/track_filter.h"

class QFrame;
class QHBoxLayout;
class QLineEdit;
class QMenu;
class QToolButton;
class QVBoxLayout;

namespace eyrie::ui {

/// A row of chips that narrow the list of tracks: a button that adds one, and a chip for each quality that is limited,
/// which opens its limits and can be removed. Filters are kept by name in the person's settings.
class FilterChips : public QWidget {
    Q_OBJECT

 public:
    explicit FilterChips(QWidget* parent = nullptr);

    const TrackFilter& filter() const { return filter_; }
    void setFilter(const TrackFilter& filter);
    void clear() { setFilter({}); }
    /// Tracks like this one; none: of any kind.
    void setLike(std::optional<TrackId> track);
    /// What its chip waits for, e.g. "when the run ends"; empty: for nothing.
    void setLikeWaiting(const QString& why);
    /// The units of the limits.
    void setScale(const SceneScale& scale);
    /// Whether times of the day are known, so that one may be asked for.
    void setClockKnown(bool known) { clock_known_ = known; }
    /// What there is to choose from; null while nobody knows.
    void setDoings(std::shared_ptr<const DoingsByTrack> doings);

    /// Opens the limits of a quality, as a click on its chip does.
    QFrame* openLimits(TrackQuality quality);
    /// Names of kept filters.
    QStringList keptNames() const;
    void keepAs(const QString& name);
    void useKept(const QString& name);
    void forgetKept(const QString& name);

 signals:
    void edited();
    /// Directions, events and zones are asked for: somebody should look for them.
    void doingsWanted();

 private:
    struct Chip {
        QWidget* whole = nullptr;
        QToolButton* button = nullptr;
    };

    void makeChip(TrackQuality quality);
    void fillAddMenu(QMenu& menu);
    void fillRange(QVBoxLayout& rows, TrackQuality quality);
    void fillDirections(QVBoxLayout& rows);
    void fillEvents(QVBoxLayout& rows);
    void fillZones(QVBoxLayout& rows);
    void fillLike(QVBoxLayout& rows);
    void addLikeSwitches(QVBoxLayout& rows);
    void fillTime(QVBoxLayout& rows);
    void fillStates(QVBoxLayout& rows);
    /// A field for a text; `take` answers whether it understands what it is given.
    QLineEdit* addText(QHBoxLayout& line, const QString& name, const QString& text,
                       const std::function<bool(const QString&)>& take);
    /// A field for a number that may be missing, and must not be negative.
    QLineEdit* addField(QHBoxLayout& line, const QString& name, const std::optional<double>& value,
                        const std::function<void(std::optional<double>)>& take);
    void change(const std::function<void(TrackFilter&)>& what);
    void askForName();
    void refresh();

    TrackFilter filter_;
    QString like_waits_;
    bool clock_known_ = false;
    SceneScale scale_;
    std::shared_ptr<const DoingsByTrack> doings_;
    QToolButton* add_;
    std::array<Chip, kTrackQualities> chips_;
    QPointer<QFrame> popup_;
};

}  // namespace eyrie::ui
