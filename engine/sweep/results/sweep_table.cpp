#include "sweep/results/sweep_table.h"

#include <algorithm>

#include "core/error.h"

namespace eyrie {
namespace {

std::string placeOf(const ProjectFile& project, int id) {
    return project.path().string() + ", sweep " + std::to_string(id);
}

SweepTable tableOf(ProjectFile& project, const SweepRecord& record) {
    const std::string where = placeOf(project, record.id);
    SweepTable table;
    table.id = record.id;
    table.name = record.name;
    table.made_utc = record.made_utc;
    table.plan = planFrom(record.plan, where);
    for (const SweepPointRecord& point : SweepStore(project).points(record.id)) {
        if (point.position < 0 || point.position >= table.plan.pointCount()) {
            throw Error(ErrorKind::project, where + ": holds a point " + std::to_string(point.position) +
                                                ", but its plan has only " + std::to_string(table.plan.pointCount()));
        }
        table.points[point.position] = figuresFrom(point.figures, where + ", point " + std::to_string(point.position));
    }
    return table;
}

}  // namespace

std::vector<int> SweepTable::missing() const {
    std::vector<int> positions;
    for (int i = 0; i < plan.pointCount(); ++i) {
        if (!points.contains(i)) positions.push_back(i);
    }
    return positions;
}

SweepTable readSweep(ProjectFile& project, std::optional<int> id) {
    const SweepStore store(project);
    const std::vector<SweepRecord> all = store.sweeps();
    if (all.empty())
        throw Error(ErrorKind::parameter, project.path().string() + ": holds no sweep; make one with eyrie-cli sweep");
    if (!id) return tableOf(project, all.back());
    std::string known;
    for (const SweepRecord& record : all) {
        if (record.id == *id) return tableOf(project, record);
        known += (known.empty() ? "" : ", ") + std::to_string(record.id);
    }
    throw Error(ErrorKind::parameter,
                project.path().string() + ": there is no sweep " + std::to_string(*id) + "; it holds " + known);
}

std::optional<SweepRecord> sweepOf(ProjectFile& project, const SweepPlan& plan) {
    for (SweepRecord& record : SweepStore(project).sweeps()) {
        if (differenceOf(planFrom(record.plan, placeOf(project, record.id)), plan).empty()) return std::move(record);
    }
    return std::nullopt;
}

int beginSweep(ProjectFile& project, const SweepPlan& plan, const std::string& name, SweepFound found) {
    const auto known = sweepOf(project, plan);
    if (!known) return SweepStore(project).add(name, plan.pointCount(), textOf(plan));
    if (found == SweepFound::resumed) return known->id;
    throw Error(ErrorKind::parameter, project.path().string() + ": holds this sweep already, with " +
                                          std::to_string(known->points_done) + " of " +
                                          std::to_string(known->point_count) +
                                          " points; add --resume to do the others, or choose another file");
}

void storePoint(ProjectFile& project, int sweep, const SweepPoint& point) {
    SweepStore(project).addPoint(sweep, {point.position, point.seconds, textOf(point.figures)});
}

SweepTable mergeSweeps(const std::vector<std::filesystem::path>& files, const std::filesystem::path& out) {
    if (files.empty()) throw Error(ErrorKind::parameter, "there is no file to merge");
    struct Shard {
        std::filesystem::path file;
        SweepPlan plan;
        std::string name;
        std::vector<SweepPointRecord> points;
    };
    for (const std::filesystem::path& file : files) {
        std::error_code ignored;
        if (!std::filesystem::equivalent(file, out, ignored)) continue;
        throw Error(
            ErrorKind::parameter,
            out.string() + ": is one of the parts; write the whole sweep to another file, parts stay as they are");
    }
    std::vector<Shard> shards;
    for (const std::filesystem::path& file : files) {
        ProjectFile project = ProjectFile::open(file, ProjectFile::Mode::read_only);
        const SweepTable table = readSweep(project);  // also shows whether all of it can be read
        shards.push_back({file, table.plan, table.name, SweepStore(project).points(table.id)});
        const std::string difference = differenceOf(shards.front().plan, table.plan);
        if (difference.empty()) continue;
        throw Error(ErrorKind::parameter, shards.front().file.string() + " and " + file.string() +
                                              " are not parts of one sweep: " + difference);
    }
    // All points are compared before anything is written.
    std::map<int, std::pair<const Shard*, const SweepPointRecord*>> points;
    for (const Shard& shard : shards) {
        for (const SweepPointRecord& point : shard.points) {
            const auto [at, added] = points.try_emplace(point.position, &shard, &point);
            if (added || at->second.second->figures == point.figures) continue;
            throw Error(ErrorKind::parameter, at->second.first->file.string() + " and " + shard.file.string() +
                                                  " hold different figures for " + shard.plan.describe(point.position) +
                                                  "; were they made with other programs or on a damaged machine?");
        }
    }
    ProjectFile project = ProjectFile::openOrCreate(out);
    const int id = beginSweep(project, shards.front().plan, shards.front().name, SweepFound::resumed);
    SweepStore store(project);
    for (const auto& [position, known] : points) store.addPoint(id, *known.second);
    return readSweep(project, id);
}

std::string listOf(const SweepPlan& plan, const std::vector<int>& positions, std::size_t at_most) {
    std::string text;
    const std::size_t shown = std::min(at_most, positions.size());
    for (std::size_t i = 0; i < shown; ++i) text += (i > 0 ? "; " : "") + plan.describe(positions[i]);
    if (shown < positions.size()) text += " and " + std::to_string(positions.size() - shown) + " more";
    return text;
}

}  // namespace eyrie
