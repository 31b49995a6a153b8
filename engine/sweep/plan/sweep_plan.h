#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chain/chain_options.h"
#include "core/labels/box_record.h"
#include "core/values/frame.h"
#include "evaluation/evaluation_options.h"

namespace eyrie {

/// A parameter and the values it takes, as text.
struct SweepAxis {
    std::string name;
    std::vector<std::string> values;
};

/// A sequence to sweep over, and what it is measured against.
struct SweepClip {
    std::string sequence;      ///< path of the video or image folder, or scene:NAME
    std::string ground_truth;  ///< path of the file; empty: the labels of the project
    int run = 0;               ///< number of the stored run whose motion vectors are used; 0: none
    std::string digest;        ///< of the first frame and the true boxes: whether two machines mean the same
    cv::Size size;             ///< px
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;  ///< included
    SceneScale scale;
    bool upright = false;  ///< enclosing upright boxes are compared, as wished or as the ground truth wants it
};

/// All that decides what a sweep gives.
struct SweepPlan {
    std::string engine_version;
    std::vector<SweepAxis> axes;                            ///< one or two; the first one changes slowest in positions
    std::vector<std::pair<std::string, std::string>> base;  ///< every parameter
    std::vector<SweepClip> clips;
    std::vector<double> overlaps{0.1, 0.2, 0.3};  ///< T_ov
    bool vehicles_only = false;
    std::optional<TrackClass> one_class;  ///< see EvaluationOptions
    std::optional<double> border;         ///< px, see EvaluationOptions

    int pointCount() const;
    /// Position of the values of a point on their axes; positions count from 0.
    std::vector<int> indicesOf(int position) const;
    int positionOf(const std::vector<int>& indices) const;
    std::vector<std::string> valuesOf(int position) const;
    /// The chain's parameters at a point. Throws Error(parameter) when this version does not know one of them.
    ChainOptions optionsOf(int position) const;
    ChainOptions baseOptions() const;
    EvaluationOptions evaluationOf(const SweepClip& clip) const;
    /// "gradient.quantile = 0.12, clustering.along = 3".
    std::string describe(int position) const;
};

/// More points than this are not begun unless somebody says that they are meant.
inline constexpr int kManyPoints = 10000;

/// Reads "name=A:STEP:B" (both ends included, for numbers) or "name=a,b,c". Throws Error(parameter): unknown parameter,
/// nothing between A and B, a step of 0, a value out of range or twice, more than ten million values.
SweepAxis parseAxis(const std::string& text, const ChainOptions& base);

/// How many values such a text names, without reading them; 0 where none can be told.
double countValues(const std::string& text);

/// Throws Error(parameter): no axis or more than two, the same twice, no sequence, overlaps outside (0, 1], more than
/// ten million points; Error(input) where a value names a model that cannot be used.
void check(const SweepPlan& plan);

/// Positions in the order in which they share most: the parameter of the earlier stage changes slowest.
std::vector<int> workOrder(const SweepPlan& plan);
/// The part of a work order that the `number`-th of `count` shards does, from 1. Throws Error(parameter).
std::vector<int> shardOf(const std::vector<int>& order, int number, int count);

/// As text for files (JSON) and back. Throws Error(project) naming `where` when it is no plan.
std::string textOf(const SweepPlan& plan);
SweepPlan planFrom(const std::string& text, const std::string& where);

/// What differs between two plans so that their points do not belong together, for people; empty when nothing does.
/// Where files lie does not count.
std::string differenceOf(const SweepPlan& a, const SweepPlan& b);

/// A short text that two equal clips share.
std::string digestOf(const Frame& first_frame, const BoxesByFrame& truth);

}  // namespace eyrie
