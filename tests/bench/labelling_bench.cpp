// 1,000 objects over 10,000 frames: what opening, stepping, moving a box, undo and the rest of a labelling session
// cost.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "annotation/edits/identity_edits.h"
#include "annotation/keyframes/interpolation.h"
#include "annotation/review/attention.h"
#include "annotation/review/review_state.h"
#include "store/labels/annotation_store.h"
#include "support/temporary_folder.h"

namespace eyrie {
namespace {

constexpr int kObjects = 1000;
constexpr int kFrames = 10000;

double msOf(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void show(const char* what, std::vector<double> ms) {
    std::sort(ms.begin(), ms.end());
    std::printf("%-44s median %8.3f ms   95 %% %8.3f   worst %8.3f   (%zu times)\n", what, ms[ms.size() / 2],
                ms[ms.size() * 95 / 100], ms.back(), ms.size());
}

CameraMotion flyingCamera() {
    std::vector<Homography> steps;
    for (int frame = 1; frame < kFrames; ++frame) {
        Homography step;
        const double turn = 0.001 * std::sin(frame / 500.0);
        step.matrix = {1, -turn, 0.5 * std::sin(frame / 90.0), turn, 1, -0.3 * std::cos(frame / 70.0), 1e-8, 0, 1};
        step.from_frame = frame - 1;
        step.to_frame = frame;
        steps.push_back(step);
    }
    return CameraMotion(steps);
}

/// Every object lives through the whole video, with a keyframe every `spacing` frames.
AnnotationEdit everything(int spacing) {
    std::mt19937 dice(1);
    std::uniform_real_distribution<double> place(0, 2000);
    AnnotationEdit edit;
    edit.name = "Import";
    for (int id = 1; id <= kObjects; ++id) {
        LabelledObject object;
        object.id = id;
        object.last_frame = kFrames - 1;
        cv::Point2d centre(place(dice), place(dice));
        for (int frame = 0; frame < kFrames; frame += spacing) {
            Keyframe keyframe;
            keyframe.frame = frame;
            keyframe.box = {centre, 20, 9, 0.1};
            object.keyframes.push_back(keyframe);
            centre += cv::Point2d(0.02 * (place(dice) - 1000), 0.01 * (place(dice) - 1000));
        }
        edit.objects.push_back({std::nullopt, object});
    }
    return edit;
}

void measure(int spacing) {
    const test::TemporaryFolder folder;
    const auto path = folder / "bench.eyrie";
    std::printf("\n%d objects, %d frames, a keyframe every %d frames (%d in all)\n", kObjects, kFrames, spacing,
                kObjects * ((kFrames + spacing - 1) / spacing));
    const CameraMotion camera = flyingCamera();
    std::mt19937 dice(2);
    {
        ProjectFile project = ProjectFile::create(path);
        SequenceRecord sequence;
        sequence.path = "/videos/bench.mp4";
        sequence.size = {1920, 1080};
        sequence.frame_count = kFrames;
        AnnotationStore store(project, ensureSequence(project, sequence));
        show("import of all in one step", {msOf([&] { store.apply(everything(spacing)); })});
    }
    std::vector<double> opening;
    for (int i = 0; i < 3; ++i) {
        opening.push_back(msOf([&] {
            ProjectFile project = ProjectFile::open(path);
            const AnnotationStore store(project, 1);
            if (store.annotations().objects.size() != kObjects) std::abort();
        }));
    }
    show("open", opening);

    ProjectFile project = ProjectFile::open(path);
    AnnotationStore store(project, 1);
    std::vector<double> step, jump, move, undo, redo, split, review, attention, index;
    std::size_t boxes = 0;
    for (int i = 0; i < 200; ++i) {
        step.push_back(msOf([&] { boxes += boxesAt(store.annotations(), 5000 + i, camera).size(); }));
        const int frame = static_cast<int>(dice() % kFrames);
        jump.push_back(msOf([&] { boxes += boxesAt(store.annotations(), frame, camera).size(); }));
    }
    for (int i = 0; i < 200; ++i) {
        const auto& object = store.annotations().objects.at(1 + static_cast<int>(dice() % kObjects));
        const int frame = static_cast<int>(dice() % kFrames);
        move.push_back(msOf([&] {
            OrientedBox box = boxAt(object, frame, camera).box;
            box.centre.x += 1;
            store.apply(editOf("Move box", store.annotations(), {withBox(object, frame, box, false)}));
            boxes += boxesAt(store.annotations(), frame, camera).size();
        }));
    }
    for (int i = 0; i < 200; ++i) undo.push_back(msOf([&] { store.undo(); }));
    for (int i = 0; i < 200; ++i) redo.push_back(msOf([&] { store.redo(); }));
    for (int i = 0; i < 50; ++i) {
        const auto& object = store.annotations().objects.at(1 + static_cast<int>(dice() % kObjects));
        const int frame = 1 + static_cast<int>(dice() % 5000);
        split.push_back(msOf([&] {
            store.apply(editOf("Split", store.annotations(), splitAt(object, frame, store.newObjectId(), camera)));
        }));
        review.push_back(msOf([&] {
            store.apply(reviewEdit("Check", store.annotations(),
                                   {{object.id, 0, frame, ReviewState::checked, "Ada", "2026-11-21T08:00:00Z"}}));
        }));
    }
    AttentionOptions options;
    options.image = {1920, 1080};
    options.frame_count = kFrames;
    for (int i = 0; i < 3; ++i) {
        attention.push_back(msOf([&] { boxes += attentionList(store.annotations(), camera, options).size(); }));
        index.push_back(msOf([&] { boxes += ReviewIndex(store.annotations()).checkedShare() > 0 ? 1 : 0; }));
    }
    show("step a frame (all its boxes)", step);
    show("jump to a frame (all its boxes)", jump);
    show("move a box, commit, all boxes again", move);
    show("undo", undo);
    show("redo", redo);
    show("split an object, commit", split);
    show("check a range, commit", review);
    show("attention list", attention);
    show("review index and share checked", index);
    if (boxes == 0) std::abort();
}

}  // namespace
}  // namespace eyrie

int main() {
    eyrie::measure(500);
    eyrie::measure(50);
    eyrie::measure(10);
}
