#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// What a project holds, in short, whatever its schema; and what differs between two states of it.
namespace eyrie {

/// What a project holds, to tell two states of it apart.
struct ProjectContents {
    struct Run {
        std::string name;
        std::string started_utc;
        int frames = 0;
    };
    struct Sweep {
        std::string name;
        int points = 0;  ///< done
    };
    std::map<int, Run> runs;                         ///< by id
    std::map<int, std::string> objects;              ///< labelled ones by id, as bytes that tell equal from other
    std::map<std::string, std::int64_t> label_rows;  ///< rows of the other labels by table
    int keyframes = 0;
    int edits = 0;                               ///< steps that undo can take back
    std::map<int, std::string> verdicts;         ///< by id, as text that tells equal from other
    std::map<int, std::string> bookmarks;        ///< the same
    std::map<int, std::string> zones;            ///< the same
    std::map<int, std::string> corrections;      ///< the same
    std::int64_t seen = 0;                       ///< frames that persons watched, summed up
    int review_steps = 0;                        ///< steps of the review that undo can take back
    std::map<std::string, std::string> presets;  ///< by name, as text that tells equal from other
    std::map<int, Sweep> sweeps;                 ///< by id
    int comparisons = 0;
};

/// Changes nothing in the file. Throws Error(project | input).
ProjectContents contentsOf(const std::filesystem::path& project);

/// What would be different with `earlier` in place of `present`, a line each, for people; none when nothing we know of.
std::vector<std::string> differencesInWords(const ProjectContents& present, const ProjectContents& earlier);

}  // namespace eyrie
