#pragma once

#include <string>
#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "annotation/keyframes/keyframe_reduction.h"
#include "core/labels/annotation.h"
#include "core/labels/track_class.h"

namespace eyrie {

/// A track of a run, offered as an object. It is no part of the labels until it is accepted.
struct Proposal {
    TrackId track = 0;
    LabelledObject object;                         ///< id 0, origin proposal_accepted
    double max_corner_px = 0;                      ///< how far its interpolation is from the track at worst
    TrackClass track_class = TrackClass::unknown;  ///< what the run takes it for
    ObjectId same_as = 0;  ///< an object that is there already and overlaps it by half or more; 0: none
};

/// A track's boxes, ascending frames.
struct DenseTrack {
    TrackId id = 0;
    std::vector<FrameBox> boxes;
    TrackClass track_class = TrackClass::unknown;  ///< what the run takes it for
};

/// Which tracks are offered as objects, and with how many keyframes.
struct ProposalOptions {
    ReductionOptions reduction;
    double tolerance_of_length = 0.12;  ///< of the track's median length, where that is more than the reduction's own
    int min_frames = 5;                 ///< shorter tracks are not offered
    std::string object_class = "car";
    double min_overlap_with_object = 0.5;  ///< from here on a track counts as labelled already
};

/// Tracks as objects with few keyframes. Gaps of a track are interpolated. Tracks of what is labelled already say so
/// in `same_as`; nothing that is labelled is ever touched.
std::vector<Proposal> proposeTracks(const std::vector<DenseTrack>& tracks, const AnnotationSet& labelled,
                                    const CameraMotion& camera, const ProposalOptions& options = {});

/// The part of a proposal in the frames [first, last]; empty (no keyframes) where it has none.
LabelledObject cutToRange(const LabelledObject& object, FrameIndex first, FrameIndex last, const CameraMotion& camera);

/// The proposal as an object of the project.
LabelledObject accepted(const Proposal& proposal, ObjectId id, std::uint32_t colour);

/// The class of a proposal that is taken over: that of a labelled object that is the same vehicle for all that is
/// known, labelled in other frames or in some of these; else `drawn`, the class of what is drawn next, unless the run
/// takes the track for something else: then the commonest of that kind.
std::string classOfProposal(const Proposal& proposal, const AnnotationSet& labelled, const CameraMotion& camera,
                            const std::string& drawn);

/// What an object's origin is once a person changed its boxes: a proposal taken over becomes a corrected one.
ObjectOrigin originAfterChange(ObjectOrigin origin);

}  // namespace eyrie
