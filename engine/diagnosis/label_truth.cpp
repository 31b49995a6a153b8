#include "diagnosis/label_truth.h"

#include <algorithm>

#include "annotation/edits/ignore_regions.h"
#include "core/error.h"
#include "store/labels/annotation_store.h"

namespace eyrie {

BoxesByFrame labelTruth(ProjectFile& project, const RunRecord& run) {
    const AnnotationSet labels = readAnnotations(project, run.sequence.id);
    if (labels.objects.empty())
        throw Error(ErrorKind::project,
                    "There are no labels of this video in the project. Draw or import them in the Label workspace, or "
                    "choose a file of ground truth.");
    const RunStore store(project);
    GroundTruthOptions options;
    options.first_frame = 0;
    options.last_frame = std::max(0, run.sequence.frame_count - 1);
    options.image = run.sequence.size;
    return groundTruthBoxes(labels, CameraMotion::fromRegistrations(store.registrations(run.id)), options);
}

}  // namespace eyrie
