#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "learning/models/window.h"

namespace eyrie {

/// A window that is known to show a vehicle or not.
struct Sample {
    cv::Mat window;  ///< CV_8UC1, 16 wide, 32 high, the vehicle's axis vertical; front and rear are not told apart
    bool vehicle = false;
    std::string source;      ///< the data set, e.g. the sheets' folder
    std::string group;       ///< samples of one group may show the same things: never split one
    bool duplicate = false;  ///< nearly equal to an earlier one
};

using SampleSet = std::vector<Sample>;

/// Reads a folder of patch sheets: `pos.png` and `neg.png` hold cells 32 wide and 16 high, the vehicle's axis
/// horizontal; `patches.csv` has at least the columns kind (pos | neg), row, column, group and duplicate, a line per
/// cell. The folder's name becomes the source. Sheets show a median car as in WindowFit{}; for another `fit` each
/// vehicle is cut out of the middle of its cell by the columns length_px and width_px, if the table has them (one that
/// its cell does not hold is left out), and of others what a median car would take. Without these columns cells are
/// taken as they are, for whoever cut them so. Throws Error(input) naming the file and line.
SampleSet readPatchSheets(const std::filesystem::path& folder, const WindowFit& fit = {});

/// Number of vehicles (or others) in a set.
int countOf(const SampleSet& samples, bool vehicle);

/// The window as seen in a mirror.
cv::Mat mirroredAcross(const cv::Mat& window);  ///< left and right exchanged
cv::Mat mirroredAlong(const cv::Mat& window);   ///< front and rear exchanged

/// How windows are cut out of labelled images.
struct SampleCutting {
    WindowFit fit;  ///< by default as in the patch sheets, with the ground around the vehicle that they have
    bool beside_vehicles = true;  ///< a quarter of the others lie beside or before a vehicle
    double most_covered = 0.05;   ///< share of another box at a random place that vehicles may cover

    /// To the letter of Teutsch §7.2: a vehicle's box fills the window; others are cut in the same way, at random
    /// places where no vehicle is visible.
    static SampleCutting thesis() { return {WindowFit::filled(), false, 0}; }
};

/// Cuts a vehicle out of a CV_8UC1 image, turned upright and scaled so that its box takes of the window what `fit`
/// says: by default it becomes 10 px wide and 21.5 px long, the size of a median car in the patch sheets. Beyond the
/// image its border is repeated. Throws Error(input) for boxes without area.
cv::Mat cutWindow(const cv::Mat& gray, const OrientedBox& vehicle, const WindowFit& fit = {});

/// An image with everything in it that is a vehicle.
struct LabelledImage {
    cv::Mat gray;  ///< CV_8UC1
    std::vector<OrientedBox> vehicles;
    std::vector<OrientedBox> unclear;  ///< neither vehicle nor background: nothing is cut here
    std::string source;
    std::string group;
};

/// Length and width in the middle of those of all vehicles; nothing (0, 0) where there are none.
OrientedBox medianVehicle(const std::vector<OrientedBox>& vehicles);

/// Samples from a labelled image: every vehicle of which at most a twentieth lies outside, and `others` windows of the
/// vehicles' median size (or `typical`, where there is none) at random places and headings that touch neither vehicles
/// nor unclear areas; by default a quarter of them beside or before a vehicle, overlapping its box by less than 0.45,
/// to teach where a vehicle ends.
SampleSet samplesFromImage(const LabelledImage& image, int others, const OrientedBox& typical, std::uint64_t seed,
                           const SampleCutting& cutting = {});

}  // namespace eyrie
