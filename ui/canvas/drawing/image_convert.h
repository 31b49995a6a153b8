#pragma once

#include <QImage>
#include <opencv2/core/mat.hpp>

namespace eyrie::ui {

/// `image` (CV_8UC1 or CV_8UC3 blue-green-red) as a QImage that shares its pixels and keeps them alive; nothing is
/// copied. The pixels must not be written afterwards. Null for an empty image; throws Error(internal) for other types.
QImage wrapImage(const cv::Mat& image);

/// `image` in the format that QPainter draws fastest (32 bit). One copy; meant for worker threads.
QImage imageForDisplay(const cv::Mat& image);

}  // namespace eyrie::ui
