#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>
#include <vector>

#include "core/parameter.h"
#include "core/values/picture_mask.h"
#include "registration/corners/corner_set.h"
#include "registration/pictures/image_pyramid.h"

namespace eyrie {

/// Parameters of burned-in graphics.
struct GraphicsOptions {
    bool leave_out_graphics = true;

    void describe(ParameterVisitor& visitor);
};

/// Learns where text, reticles and logos were drawn into the pictures, also a part of the aircraft or dirt: an edge
/// that stays where it is in the picture while the ground moves on across it by some hundred pixels belongs to no
/// ground. Of the gradient only the part along the ground's motion counts, since edges of the ground that run along it
/// (lanes below a flight along the road) stay where they are, too. Figures that change are found by the strokes that
/// they share, and by their neighbours. A vehicle that drives just as the camera flies stays in the picture, too, but
/// not to a fraction of a pixel, as corners on it tell. A camera that stands still over its ground teaches nothing.
class BurnedInGraphics {
 public:
    explicit BurnedInGraphics(const GraphicsOptions& options) : options_(options) {}

    /// Takes the next picture that was registered with its corners, and the way of the ground into it from the one
    /// before.
    void add(const ImagePyramid& picture, const CornerSet& corners, const cv::Matx33d& current_from_previous);
    /// The way into the next picture is not known: a frame failed.
    void loseWay();
    void reset();

    /// Where there are graphics, as far as is known.
    const PictureMask& mask() const { return mask_; }

    /// What is remembered of the pictures so far, written or read; see core/state_archive.h.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    void look(const PaddedPicture& picture);
    /// Pixels of the level whose gradient stays where it is.
    cv::Mat stayingEdges() const;
    /// What they are parts of, without specks: lines of text, marks. Empty where there is nothing.
    cv::Mat candidates() const;
    void findMask(const CornerSet& corners);
    cv::Size levelSize() const { return {size_.width >> level_, size_.height >> level_}; }
    std::size_t pixels() const { return std::size_t(levelSize().width) * std::size_t(levelSize().height); }

    GraphicsOptions options_;
    cv::Size size_;                         ///< of the pictures
    int level_ = 0;                         ///< of the pyramid, that is looked at
    cv::Matx33d way_ = cv::Matx33d::eye();  ///< of the ground since the last look
    std::uint32_t looks_ = 0;
    // Of every pixel of the level, row by row, fading over the looks; d is the gradient along the ground's motion, u
    // the direction of that motion, w the weight of a look.
    std::vector<float> along_x_;  ///< Σ w d u_x
    std::vector<float> along_y_;  ///< Σ w d u_y
    std::vector<float> energy_;   ///< Σ w d²
    std::vector<float> weight_;   ///< Σ w
    PictureMask mask_;
};

}  // namespace eyrie
