#pragma once

#include <string>
#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/labels/annotation_edit.h"
#include "exchange/label_doubles.h"
#include "exchange/loose_boxes.h"
#include "formats/label_file.h"
#include "store/labels/annotation_store.h"

namespace eyrie {

/// What an import would do to a project: one edit, to be looked at and applied, or not.
struct LabelImport {
    AnnotationEdit edit;
    int objects = 0;
    int boxes = 0;      ///< of the file
    int keyframes = 0;  ///< made of them
    int regions = 0;
    int doubles = 0;      ///< objects and regions that the project has already and that were left out
    LooseBoxCount loose;  ///< boxes without id, and the objects made of them
    std::vector<std::string> notes;
};

/// What an import adds to: labels as they are, and the first numbers that are free. A value, so that a plan can be made
/// on any thread while the store goes its way.
struct ImportGround {
    explicit ImportGround(const AnnotationStore& store)
        : present(store.annotations()), first_object(store.nextObjectId()), first_region(store.nextRegionId()) {}

    AnnotationSet present;
    ObjectId first_object;  ///< this and all above; 1 in a project that never had an object
    int first_region;       ///< the same
};

/// Labels of a file as an edit of the video's labels. Few keyframes are chosen whose interpolation over the ground
/// stays within `tolerance_px` of every box; 0 makes every box a keyframe. Nothing that is there is touched. Ids of the
/// file are kept in a project that never had an object; otherwise they are the next free ones of `ground`. Boxes that
/// belong to no object become objects of their own, as `loose` says. Boxes behind the video's last frame are left out;
/// notes say how many. So are, unless `doubles` says otherwise, objects and regions that the project has already,
/// within a pixel: a file imported twice adds nothing.
LabelImport planImport(LabelFile labels, const SequenceRecord& sequence, const CameraMotion& camera,
                       const ImportGround& ground, double tolerance_px, Doubles doubles = Doubles::skip,
                       LooseBoxes loose = LooseBoxes::single);
/// The same for labels that nobody changes meanwhile.
LabelImport planImport(LabelFile labels, const SequenceRecord& sequence, const CameraMotion& camera,
                       AnnotationStore& store, double tolerance_px, Doubles doubles = Doubles::skip,
                       LooseBoxes loose = LooseBoxes::single);

}  // namespace eyrie
