#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "store/project/project_file.h"
#include "store/sweeps/sweep_store.h"
#include "sweep/plan/sweep_plan.h"
#include "sweep/results/sweep_figures.h"
#include "sweep/sweep_runner.h"

namespace eyrie {

/// A sweep with what is known of its points.
struct SweepTable {
    int id = 0;  ///< in its project
    std::string name;
    std::string made_utc;
    SweepPlan plan;
    std::map<int, std::vector<SweepFigures>> points;  ///< by position

    std::vector<int> missing() const;  ///< ascending positions
};

/// Reads a sweep of a project; by default the last one. Throws Error(parameter) when there is none, Error(project).
SweepTable readSweep(ProjectFile& project, std::optional<int> id = {});

/// What becomes of a sweep that a project holds already.
enum class SweepFound {
    refused,  ///< nobody expected it: points of two sweeps are not mixed by chance
    resumed
};

/// Finds the sweep of this plan in the project, or adds it, and answers its number. Throws Error(parameter) when it is
/// there already and is refused.
int beginSweep(ProjectFile& project, const SweepPlan& plan, const std::string& name, SweepFound found);

/// The sweep of this plan, if the project holds it.
std::optional<SweepRecord> sweepOf(ProjectFile& project, const SweepPlan& plan);

/// Keeps a point. Throws Error(output | project).
void storePoint(ProjectFile& project, int sweep, const SweepPoint& point);

/// Joins the last sweeps of several files, which must have the same plan, in a new file or one that holds a part of
/// them already. Throws Error(parameter) naming the files and what differs, also where two files hold different figures
/// for one point, and where `out` is one of the files.
SweepTable mergeSweeps(const std::vector<std::filesystem::path>& files, const std::filesystem::path& out);

/// "gradient.quantile = 0.3, gradient.quantile = 0.31 and 12 others".
std::string listOf(const SweepPlan& plan, const std::vector<int>& positions, std::size_t at_most = 8);

}  // namespace eyrie
