#include "core/geometry/sound_map.h"

#include <array>

#include "core/geometry/homography_jacobian.h"

namespace eyrie {

bool isSoundMap(const cv::Matx33d& map, cv::Size image, double most_unlike) {
    const double right = image.width - 1;
    const double bottom = image.height - 1;
    const std::array<cv::Point2d, 4> corners{{{0, 0}, {right, 0}, {right, bottom}, {0, bottom}}};
    for (const cv::Point2d& corner : corners) {
        if (!(map(2, 0) * corner.x + map(2, 1) * corner.y + map(2, 2) > 0)) return false;
        const double scale = HomographyJacobian(map, corner).scale();
        if (!(scale < most_unlike && scale > 1 / most_unlike)) return false;
    }
    return true;
}

}  // namespace eyrie
