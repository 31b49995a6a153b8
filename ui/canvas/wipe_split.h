#pragma once

#include <QWidget>

#include "canvas/video_view.h"

namespace eyrie::ui {

/// Two views of the same frame with one zoom: side by side, or one over the other with a border between them that can
/// be dragged. The pointer stands in both.
class WipeSplit : public QWidget {
    Q_OBJECT

 public:
    /// `overlays` must outlive the views.
    explicit WipeSplit(OverlaySettings& overlays, QWidget* parent = nullptr);

    VideoView& first() { return *first_; }
    VideoView& second() { return *second_; }
    bool wipe() const { return wipe_; }
    void setWipe(bool wipe);
    /// Where the border is, as a share of the width.
    double border() const { return border_; }
    void setBorder(double share);
    void setNames(const QString& first, const QString& second);
    void centreOn(QPointF image_point, double zoom);

 protected:
    void resizeEvent(QResizeEvent* event) override;

 private:
    class Handle;
    void arrange();
    void follow(const VideoView& from, VideoView& to);

    VideoView* first_;
    VideoView* second_;
    Handle* handle_;
    bool wipe_ = false;
    bool following_ = false;
    double border_ = 0.5;
};

}  // namespace eyrie::ui
