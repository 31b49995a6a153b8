#include "tune/evaluate/error_chips.h"

#include <QPainter>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace eyrie::ui {

namespace {
constexpr double kAround = 2.4;  ///< size of the chip in sizes of the box
constexpr double kLeast_px = 18;
constexpr double kShape = 1.5;  ///< width of a chip by its height
}  // namespace

QImage errorChip(const cv::Mat& gray, const OrientedBox& box, int height_px) {
    const OrientedBox upright = box.upright();
    const double needed = std::max({kLeast_px, upright.width * kAround, upright.length * kAround / kShape});
    const double scale = height_px / needed;
    const cv::Size size(static_cast<int>(std::lround(height_px * kShape)), height_px);
    const cv::Matx23d image_from_chip(1 / scale, 0, box.centre.x - (size.width - 1) / 2.0 / scale,  //
                                      0, 1 / scale, box.centre.y - (size.height - 1) / 2.0 / scale);
    cv::Mat chip;
    cv::warpAffine(gray, chip, image_from_chip, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT,
                   cv::Scalar(60));
    QImage image = QImage(chip.data, chip.cols, chip.rows, static_cast<qsizetype>(chip.step), QImage::Format_Grayscale8)
                       .convertToFormat(QImage::Format_RGB32);
    QPainter painter(&image);
    painter.setRenderHint(QPainter::Antialiasing);
    QPolygonF outline;
    for (const cv::Point2d& corner : box.corners())
        outline << QPointF((corner.x - box.centre.x) * scale + size.width / 2.0,
                           (corner.y - box.centre.y) * scale + size.height / 2.0);
    painter.setPen(QPen(QColor(0, 0, 0, 160), 2.4));
    painter.drawPolygon(outline);
    painter.setPen(QPen(QColor(255, 225, 90), 1.2));
    painter.drawPolygon(outline);
    return image;
}

void ErrorChips::setMedia(std::optional<Media> media) {
    media_ = std::move(media);
    query_.cancel();
}

void ErrorChips::request(std::vector<ChipWish> wishes) {
    query_.cancel();
    if (!media_ || wishes.empty()) return;
    std::sort(wishes.begin(), wishes.end(), [](const ChipWish& a, const ChipWish& b) {
        return a.frame != b.frame ? a.frame < b.frame : a.id < b.id;
    });
    query_.ask([this, media = *media_, wishes = std::move(wishes)](const BackgroundTask& task) {
        try {
            if (!source_ || source_of_ != media.identity) {
                source_.reset();
                source_ = media.open({}, task.stop());
                source_of_ = media.identity;
            }
            cv::Mat gray;
            FrameIndex shown = -1;
            for (const ChipWish& wish : wishes) {
                if (task.stop().stop_requested()) return;
                if (wish.frame != shown) gray = source_->read(wish.frame, false).gray;
                shown = wish.frame;
                task.tell(
                    [this, id = wish.id, chip = errorChip(gray, wish.box, wish.height_px)] { emit ready(id, chip); });
            }
        } catch (const std::exception&) {
            // A picture that cannot be read is told by the canvas; the list works without chips.
            source_.reset();
        }
    });
}

}  // namespace eyrie::ui

#include "moc_error_chips.cpp"
