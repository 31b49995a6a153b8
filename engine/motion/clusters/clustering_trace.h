#pragma once

#include <string>
#include <vector>

namespace eyrie {

/// Why linked motion vectors are no cluster.
enum class ClusterRefusal {
    none,        ///< they are one
    too_few,     ///< of them
    not_linked,  ///< of a place only: it has enough, but linkage keeps them apart
    split_off,   ///< too few were left of a larger group that was split
    too_long,
    too_wide,
    not_finite  ///< a velocity is no number
};

/// Linked motion vectors and what became of them, to be looked at.
struct TracedGroup {
    std::vector<int> members;  ///< positions in the list of motion vectors, ascending
    int cluster = -1;          ///< position in the list of clusters; −1: refused
    ClusterRefusal refusal = ClusterRefusal::none;
    double value = 0;       ///< what was compared: vectors, or px; split_off: the size of the group that was split, px
    double limit = 0;       ///< with what
    std::string parameter;  ///< that says the limit
    std::string split_by;   ///< parameter by which it was split from a larger group; empty: it was not
};

/// What clustering did in a frame.
struct ClusteringTrace {
    std::vector<TracedGroup> groups;  ///< every motion vector is in one of them
    int needed = 0;                   ///< motion vectors that make a cluster in this frame
    std::string needed_parameter;     ///< that says so
};

/// How two motion vectors stand to each other, as linkage compares them.
struct LinkageGap {
    int other = -1;         ///< position of the second in the list of motion vectors; −1: there is none
    double ahead = 0;       ///< px along their mean motion
    double aside = 0;       ///< px across it
    double difference = 0;  ///< px/frame between the velocities
    double allowed = 0;     ///< px/frame
    double distance = 0;    ///< in linkage distances; more than 1 is too far
    bool joined = false;
    std::string parameter;  ///< the limit that keeps them apart or that they come nearest to
};

/// What decided about the motion vectors of a place.
struct ClusteringVerdict {
    ClusterRefusal refusal = ClusterRefusal::none;  ///< none: some of them are in a cluster, or there are none
    int here = 0;                                   ///< motion vectors at the place
    int needed = 0;                                 ///< for a cluster in this frame
    std::vector<int> group;                         ///< the linked ones that came farthest
    double value = 0;                               ///< that decided; see TracedGroup
    double limit = 0;
    std::string parameter;
    LinkageGap gap;  ///< not_linked: to the next vector
};

}  // namespace eyrie
