#pragma once

#include <QWidget>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/values/scene_scale.h"
#include "store/runs/run_store.h"

class QFormLayout;
class QLabel;
class QStackedLayout;
class QToolButton;

namespace eyrie::ui {

class EmptyState;
class OriginBar;

/// What is known of the selected track: its life, speed and size as a whole, and its state in the frame shown.
class TrackInspector : public QWidget {
    Q_OBJECT
 public:
    explicit TrackInspector(QWidget* parent = nullptr);

    /// `states` ascend by frame. A track without states shows as nothing. `rate_assumed`: nobody said the frame rate,
    /// from which speeds and times follow.
    void showTrack(TrackId track, std::vector<TrackFrame> states, const SceneScale& scale, TrackClass track_class,
                   bool rate_assumed = false);
    /// The track's probability of being a moving vehicle, in words, and that of what was detected there in the present
    /// frame; empty: not known.
    void showScore(const QString& score) { showOrDash(score_, score); }
    void showDetection(const QString& probability) { showOrDash(detection_, probability); }
    /// What was taken out of its boxes as shadow, in words; empty: nothing.
    void showShadow(const QString& taken) { showOrDash(shadow_, taken); }
    /// Who knows where a box of a frame points to over the ground: degrees clockwise from north; nothing where nobody
    /// does, and then the heading in the image is shown.
    using CourseOf = std::function<std::optional<double>(FrameIndex frame, const OrientedBox& box)>;
    void setCourse(CourseOf course_of) { course_of_ = std::move(course_of); }
    void setCurrentFrame(FrameIndex frame);
    /// The course may be another now.
    void showCourse();
    void clear();
    TrackId track() const { return track_; }
    /// All lines as "name<tab>value".
    QString text() const;

 signals:
    /// The user wants to see this frame.
    void frameActivated(int frame);

 private:
    QLabel* addLine(const QString& name);
    static void showOrDash(QLabel* label, const QString& text);
    void showWhole();
    void showNow();
    void showHeading(const OrientedBox& box);
    void activate(bool last);

    TrackId track_ = 0;
    std::vector<TrackFrame> states_;
    bool rate_assumed_ = false;
    SceneScale scale_;
    CourseOf course_of_ = [](FrameIndex, const OrientedBox&) { return std::nullopt; };
    TrackClass track_class_ = TrackClass::unknown;
    FrameIndex frame_ = 0;
    QStackedLayout* stack_;
    EmptyState* empty_;
    QFormLayout* form_;
    OriginBar* origins_;
    QLabel* title_;
    QLabel* class_;
    QLabel* score_;
    QLabel* life_;
    QLabel* speed_;
    QLabel* size_;
    QLabel* origin_counts_;
    QLabel* shadow_;
    QLabel* now_;
    QLabel* position_;
    QLabel* heading_;
    QLabel* speed_now_;
    QLabel* size_now_;
    QLabel* detection_;
};

}  // namespace eyrie::ui
