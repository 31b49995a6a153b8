#pragma once

#include <cstddef>
#include <optional>
#include <vector>

/// What the chain finds while assuming one scale after the other, and what scale that tells.
namespace eyrie {

/// What a look at the traffic says about the scale of a video.
struct ScaleEstimate {
    double gsd_m_per_px = 0;  ///< metres per pixel at which the vehicles have the length of usual cars
    double uncertainty = 1;   ///< factor ≥ 1: in nine of ten videos the truth lies between GSD / this and GSD × this
    int vehicles = 0;         ///< tracks it rests on
};

/// How many scales are assumed, each coarser than the one before by the same factor.
inline constexpr int kScaleAssumptions = 9;
/// The i-th of them, m/px, from 0.
double assumedGsd(int i);

/// What the chain found under one assumption.
struct ScaleOutcome {
    double detections = 0;
    double looks = 0;     ///< detections that the classifier took for whole vehicles
    double decision = 0;  ///< sum of its decision values there
    double tracks = 0;
    double cars = 0;  ///< tracks of a car's size
    /// Tracks that look like whole vehicles, each counting by the share of the frames in which it does …
    double whole_tracks = 0;
    double whole_cars = 0;  ///< … and those of a car's size among them
    /// Of those that the classifier took for whole vehicles at least once, where the frame rate is known: their speeds,
    /// m/s under the assumption.
    std::vector<double> car_speeds_m_s = {};
    double in_dark = 0;  ///< of the detections, each as much as its picture is dark

    /// Share of the detections that look like whole vehicles.
    double alike() const;
    /// How dark the pictures were, 0 to 1.
    double darkness() const;
    /// Much that looks like vehicles and is as large as cars, and less that does not: where the assumption is too fine
    /// cars do not fit the window, where it is too coarse they fall into pieces, and neither relief nor glare looks
    /// like a car at any.
    double score() const;
    /// The same of what goes on looking like whole vehicles alone, and how sure the classifier is. Relief and haze,
    /// which show the more the coarser the assumption is, have no say here.
    double scoreAmidRelief() const;
    /// Whether enough looks like vehicles, and one of them is as large as a car: less is chance.
    bool showsTraffic() const;
};
/// Of both together.
ScaleOutcome operator+(const ScaleOutcome& a, const ScaleOutcome& b);

/// Whether a track of that length and width, m, is about as large as a car, as boxes have it.
bool isCarSized(double length_m, double width_m);

/// The middle of the scores around the best one, of one outcome for each assumption. On eight clips it lay between .83
/// and 1.21 of the truth; rather too fine than too coarse, since a scale too coarse by a tenth costs more. Nothing
/// where too little looks like vehicles. Where most of what is detected does not, it is less sure and a little coarser
/// than sizes say, since they are those of vehicles with the ground they light or darken, in the dark once more, and
/// where nearly nothing does, the scale that would be assumed without it has a say, too. The less sure it is, the more
/// counts how fast three quarters of the cars drive at most, as in towns: headlights and haze change sizes, not speeds.
std::optional<ScaleEstimate> estimateOfScale(const std::vector<ScaleOutcome>& outcomes);

/// Scores of outcomes, added up over several looks, and what they tell.
class ScaleScores {
 public:
    void add(const std::vector<ScaleOutcome>& outcomes);
    /// Of the sum of all outcomes that were added. Where most of what is detected looks like no vehicle, too fine an
    /// assumption may show hardly anything else and seem right: there a much coarser one is, if what goes on looking
    /// like whole vehicles says so.
    std::optional<ScaleEstimate> estimate(const std::vector<ScaleOutcome>& sums) const;

 private:
    std::vector<double> all_ = std::vector<double>(kScaleAssumptions);
    std::vector<double> amid_relief_ = std::vector<double>(kScaleAssumptions);
};

/// What several looks at a video tell together, each under all assumptions: their scores add up, so that a look that
/// tells scales apart counts more than one that does not.
class LooksTogether {
 public:
    /// What looks like a vehicle by chance must not add up to traffic: a look that shows none does not count.
    void add(const std::vector<ScaleOutcome>& outcomes);
    const std::optional<ScaleEstimate>& estimate() const { return estimate_; }
    /// Whether so many vehicles drive that no other look is needed.
    bool suffice() const;

 private:
    std::vector<ScaleOutcome> sums_ = std::vector<ScaleOutcome>(kScaleAssumptions);
    ScaleScores scores_;
    std::optional<ScaleEstimate> estimate_;
};

/// The place of the best of views that were tried: one that shows traffic, most of whose tracks are as large as a car.
std::optional<std::size_t> bestOfViews(const std::vector<ScaleOutcome>& outcomes);

}  // namespace eyrie
