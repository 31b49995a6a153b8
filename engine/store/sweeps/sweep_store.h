#pragma once

#include <set>
#include <string>
#include <vector>

#include "store/project/project_file.h"

namespace eyrie {

/// A sweep as it is kept: what was planned, as text that the sweep room writes.
struct SweepRecord {
    int id = 0;
    std::string made_utc;  ///< ISO 8601
    std::string name;      ///< for people; may be empty
    int point_count = 0;   ///< planned
    int points_done = 0;
    std::string plan;
};

/// The figures of one point of a sweep.
struct SweepPointRecord {
    int position = 0;    ///< in the plan, from 0
    double seconds = 0;  ///< it took, wall clock
    std::string figures;
};

/// Sweeps of a project. Every function is one transaction, so that what was done survives whatever happens next. Throws
/// Error(project | output).
class SweepStore {
 public:
    /// `project` must outlive the store.
    explicit SweepStore(ProjectFile& project) : project_(project) {}

    std::vector<SweepRecord> sweeps() const;  ///< oldest first
    /// Adds a sweep without points; answers its id.
    int add(const std::string& name, int point_count, const std::string& plan);
    /// Adds a point; one that is there already stays as it is. False then.
    bool addPoint(int sweep, const SweepPointRecord& point);
    std::vector<SweepPointRecord> points(int sweep) const;  ///< ascending positions
    std::set<int> pointsDone(int sweep) const;
    void remove(int sweep);

 private:
    ProjectFile& project_;
};

}  // namespace eyrie
