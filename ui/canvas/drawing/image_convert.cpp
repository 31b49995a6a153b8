#include "canvas/drawing/image_convert.h"

#include "core/error.h"

namespace eyrie::ui {

namespace {
void releaseMat(void* mat) {
    delete static_cast<cv::Mat*>(mat);
}
}  // namespace

QImage wrapImage(const cv::Mat& image) {
    if (image.empty()) return {};
    QImage::Format format = QImage::Format_Invalid;
    if (image.type() == CV_8UC1) format = QImage::Format_Grayscale8;
    if (image.type() == CV_8UC3) format = QImage::Format_BGR888;
    if (format == QImage::Format_Invalid)
        throw Error(ErrorKind::internal,
                    "an image of OpenCV type " + std::to_string(image.type()) + " cannot be shown");
    auto* keeper = new cv::Mat(image);
    const uchar* pixels = keeper->data;
    return {pixels, image.cols, image.rows, static_cast<qsizetype>(image.step), format, releaseMat, keeper};
}

QImage imageForDisplay(const cv::Mat& image) {
    return wrapImage(image).convertToFormat(QImage::Format_RGB32);
}

}  // namespace eyrie::ui
