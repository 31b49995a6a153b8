#include "canvas/wipe_split.h"

#include <QMouseEvent>
#include <QPainter>

#include "canvas/drawing/mark_colours.h"

namespace eyrie::ui {

namespace {
constexpr int kHandleWidth = 9;  ///< logical px that take the mouse
constexpr int kWipeGap = 3;      ///< between the views
}  // namespace

/// The border between the views, to be dragged.
class WipeSplit::Handle : public QWidget {
 public:
    explicit Handle(WipeSplit& split) : QWidget(&split), split_(split) { setCursor(Qt::SplitHCursor); }

 protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        painter.fillRect(QRect(width() / 2 - 1, 0, 3, height()), QColor(0, 0, 0));
        painter.fillRect(QRect(width() / 2, 0, 1, height()), toolColour());
    }
    void mouseMoveEvent(QMouseEvent* event) override {
        split_.setBorder(static_cast<double>(mapToParent(event->pos()).x()) / std::max(1, split_.width()));
    }
    void mousePressEvent(QMouseEvent*) override {}

 private:
    WipeSplit& split_;
};

WipeSplit::WipeSplit(OverlaySettings& overlays, QWidget* parent)
    : QWidget(parent),
      first_(new VideoView(overlays, this)),
      second_(new VideoView(overlays, this)),
      handle_(new Handle(*this)) {
    setMinimumSize(320, 180);
    connect(first_, &VideoView::transformChanged, this, [this] { follow(*first_, *second_); });
    connect(second_, &VideoView::transformChanged, this, [this] { follow(*second_, *first_); });
    arrange();
}

void WipeSplit::setWipe(bool wipe) {
    if (wipe_ == wipe) return;
    wipe_ = wipe;
    arrange();
}

void WipeSplit::setBorder(double share) {
    border_ = std::clamp(share, 0.0, 1.0);
    arrange();
}

void WipeSplit::setNames(const QString& first, const QString& second) {
    first_->setBadge(first);
    second_->setBadge(second);
}

void WipeSplit::centreOn(QPointF image_point, double zoom) {
    first_->restore(zoom, image_point);
    follow(*first_, *second_);
}

void WipeSplit::resizeEvent(QResizeEvent*) {
    arrange();
}

void WipeSplit::arrange() {
    following_ = true;  // each view adapts to its size; they are made alike at the end
    handle_->setVisible(wipe_);
    if (wipe_) {
        const int border = static_cast<int>(border_ * width());
        first_->setGeometry(rect());
        second_->setGeometry(rect());
        first_->setMask(QRegion(0, 0, std::max(1, border), height()));
        second_->setMask(QRegion(border, 0, std::max(1, width() - border), height()));
        second_->raise();
        handle_->setGeometry(border - kHandleWidth / 2, 0, kHandleWidth, height());
        handle_->raise();
        second_->setBadgeOnRight(true);
    } else {
        const int half = (width() - kWipeGap) / 2;
        first_->clearMask();
        second_->clearMask();
        first_->setGeometry(0, 0, half, height());
        second_->setGeometry(width() - half, 0, half, height());
        second_->setBadgeOnRight(false);
    }
    following_ = false;
    follow(*first_, *second_);
}

void WipeSplit::follow(const VideoView& from, VideoView& to) {
    if (following_) return;
    following_ = true;
    const ViewTransform& transform = from.transform();
    if (transform.fitted())
        to.fit();
    else
        to.restore(transform.zoom(), transform.imageFromView(QPointF(from.width() / 2.0, from.height() / 2.0)));
    following_ = false;
}

}  // namespace eyrie::ui

#include "moc_wipe_split.cpp"
