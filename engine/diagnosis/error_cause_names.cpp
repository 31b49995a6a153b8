#include "diagnosis/error_cause.h"

namespace eyrie {

const char* nameOf(ErrorCause cause) {
    static constexpr const char* names[kErrorCauses] = {"unknown",
                                                        "not registered",
                                                        "just came into view",
                                                        "no corners",
                                                        "too slow",
                                                        "too few vectors",
                                                        "not clustered",
                                                        "not detected",
                                                        "removed as duplicate",
                                                        "removed as outlier",
                                                        "removed by size",
                                                        "not associated",
                                                        "track not confirmed",
                                                        "track left out",
                                                        "box off",
                                                        "merged",
                                                        "split",
                                                        "at the border",
                                                        "of another class",
                                                        "duplicate",
                                                        "ignored object",
                                                        "outside the image",
                                                        "coasting",
                                                        "shadow",
                                                        "parallax",
                                                        "nothing labelled",
                                                        "swapped",
                                                        "track ended",
                                                        "track left",
                                                        "clustered together",
                                                        "segmented together",
                                                        "tracked together",
                                                        "clustered apart",
                                                        "segmented apart"};
    return names[static_cast<std::size_t>(cause)];
}

const char* explanationOf(ErrorCause cause) {
    switch (cause) {
        case ErrorCause::unknown:
            return "Nothing that the run stored explains it.";
        case ErrorCause::unregistered:
            return "The camera's motion could not be measured in this frame or just before (registration.*).";
        case ErrorCause::too_new:
            return "It has not been in view long enough for its corners to be judged (motion.min_age).";
        case ErrorCause::no_corners:
            return "No corner was found in the box (registration.*: more, or weaker, corners).";
        case ErrorCause::too_slow:
            return "There are corners in the box, but none moves fast enough (motion.min_speed, motion.sigma_factor).";
        case ErrorCause::too_few_vectors:
            return "Too few motion vectors for a cluster (clustering.min_members, clustering.min_density_share).";
        case ErrorCause::not_clustered:
            return "Its motion vectors lie too far apart, move too differently or are together too large for a cluster "
                   "(clustering.along, clustering.across and others).";
        case ErrorCause::not_detected:
            return "It was clustered, but segmentation or classifier found no box there (detection.*).";
        case ErrorCause::removed_duplicate:
            return "It was detected, but fused into another detection (duplicates.*).";
        case ErrorCause::removed_outlier:
            return "It was detected, but too few motion vectors belong to it (outliers.min_vectors).";
        case ErrorCause::removed_size:
            return "It was detected, but its size was out of bounds (outliers.min_length and others).";
        case ErrorCause::not_associated:
            return "It was detected, but belongs to no track of the result (tracking.*).";
        case ErrorCause::tentative:
            return "It was followed, but the track was not confirmed (tracking.*).";
        case ErrorCause::track_dropped:
            return "It was followed, but the track was left out when the tracks were finished (finishing.*).";
        case ErrorCause::box_off:
            return "A box is there, but overlaps by less than T_ov.";
        case ErrorCause::merged:
            return "It was taken for one with a neighbour.";
        case ErrorCause::split:
            return "The object was found in several parts.";
        case ErrorCause::at_border:
            return "It was found, but its result lies so near to the image's edge that it was left out.";
        case ErrorCause::other_class:
            return "It was found, but its result names another class, which size and speed decide (classes.*).";
        case ErrorCause::duplicate:
            return "A second box on an object that is found already (duplicates.*).";
        case ErrorCause::ignored_object:
            return "It lies beside an ignored object, such as a person or a standing vehicle.";
        case ErrorCause::outside_image:
            return "Its middle lies outside the image: the track goes on after the object has left.";
        case ErrorCause::coasting:
            return "The track went on by prediction although nothing was detected (tracking.*).";
        case ErrorCause::shadow:
            return "It moves along beside an object: probably its shadow (motion.shadow_*).";
        case ErrorCause::parallax:
            return "It moves like the parallax of something that stands above the ground (motion.parallax_*).";
        case ErrorCause::unlabelled:
            return "It moves steadily, but no object is there. The ground truth may lack it.";
        case ErrorCause::swapped:
            return "The tracks of two objects were exchanged.";
        case ErrorCause::track_ended:
            return "The old track ended and another began.";
        case ErrorCause::track_left:
            return "The old track went on, but not on this object.";
        case ErrorCause::clustered_together:
            return "One motion cluster has vectors of both (clustering.across, clustering.along).";
        case ErrorCause::segmented_together:
            return "Two clusters, but one detection covers both (detection.*).";
        case ErrorCause::tracked_together:
            return "Two detections, but one track (tracking.*).";
        case ErrorCause::clustered_apart:
            return "Its motion vectors fell into several clusters (clustering.along).";
        case ErrorCause::segmented_apart:
            return "One cluster gave several detections (detection.*).";
    }
    return "";
}

}  // namespace eyrie
