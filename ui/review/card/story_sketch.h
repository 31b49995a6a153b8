#pragma once

#include <QWidget>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/values/scene_scale.h"
#include "ground/track_story.h"

namespace eyrie::ui {

/// Draws one view of a vehicle's story, small: how fast it was over time, or which way it drove over the ground. A mark
/// stands at one moment. A click tells the frame there; so do the arrow keys, Home and End, which move the mark.
class StorySketch : public QWidget {
    Q_OBJECT

 public:
    enum class Kind { speed, way };

    explicit StorySketch(Kind kind, QWidget* parent = nullptr);

    /// What is done with the frame that was clicked at.
    void setGoTo(std::function<void(FrameIndex)> go_to) { go_to_ = std::move(go_to); }
    void setPoints(std::vector<StoryPoint> points, const SceneScale& scale);
    /// The frame that is marked.
    void setMark(FrameIndex frame);

    /// "0 – 52 km/h" or "118 m"; empty without points.
    QString figureText() const;
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return {60, 40}; }

 protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

 private:
    /// The point to which a key moves the mark; nothing: it does not.
    std::optional<std::size_t> pointAfter(const QKeyEvent& key) const;
    /// The point of the mark, or the one next to it in time.
    std::size_t markedPoint() const;
    /// What the figure takes at the top, px; 0 where there is too little room for both.
    double figureHeight() const;
    /// Where the points lie in the widget.
    QPolygonF line() const;
    int nearest(QPointF place) const;

    Kind kind_;
    std::function<void(FrameIndex)> go_to_ = [](FrameIndex) {};
    std::vector<StoryPoint> points_;
    SceneScale scale_;
    FrameIndex mark_ = -1;
};

}  // namespace eyrie::ui
