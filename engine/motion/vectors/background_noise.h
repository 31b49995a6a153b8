#pragma once

#include <vector>

namespace eyrie {

/// How fast standing corners seem to move, by the number of frames their velocity was measured over. Speeds of a
/// background with normal errors follow a Rayleigh distribution; its deviation is taken from the median, which moving
/// objects hardly shift.
class BackgroundNoise {
 public:
    explicit BackgroundNoise(int longest_baseline);

    /// A speed in px/frame measured over `baseline` frames, 1 … longest.
    void add(int baseline, double speed);
    /// To be called between the last `add` and the first `sigma`.
    void finish();
    /// Deviation of one velocity component, px/frame. Baselines with few corners take the displacement error of all.
    double sigma(int baseline) const;
    /// Median of the speeds over `baseline` frames, px/frame.
    double usual(int baseline) const;

 private:
    std::vector<std::vector<float>> speeds_;  ///< [baseline]
    std::vector<double> sigma_;
};

}  // namespace eyrie
