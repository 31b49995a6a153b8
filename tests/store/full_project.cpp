#include "store/full_project.h"

#include <fstream>
#include <iterator>

#include "store/labels/annotation_store.h"
#include "store/labels/label_samples.h"
#include "store/labels/rejected_proposals.h"
#include "store/project/project_presets.h"
#include "store/review/review_samples.h"
#include "store/review/review_store.h"
#include "store/review/seen_store.h"
#include "store/samples.h"
#include "store/sweeps/comparison_store.h"
#include "store/sweeps/sweep_store.h"
#include "support/temporary_folder.h"

namespace eyrie::test {
namespace {

void makeFullProject(const std::filesystem::path& path) {
    writeSampleProject(path, kFullFrames, {400, 100, 6, 7, 5, {768, 576}});
    writeSampleProject(path, 10);
    ProjectFile project = ProjectFile::open(path);
    AnnotationStore labels(project, 1);
    for (int i = 0; i < kFullObjects; ++i) labels.apply(sampleEdit(labels.newObjectId()));
    AnnotationEdit rest;
    rest.name = "Rest";
    rest.regions.push_back({std::nullopt, sampleRegion(labels.newRegionId())});
    rest.reviews = TailChange<ReviewMark>{0, {}, {sampleMark(1)}};
    labels.apply(rest);
    labels.undo();
    ReviewStore review(project, 1);
    for (int i = 0; i < kFullVerdicts; ++i) review.apply(sampleJudging(review.newVerdictId()));
    for (int i = 0; i < kFullZones; ++i) review.apply(sampleZoning(review.newZoneId()));
    for (int i = 0; i < kFullCorrections; ++i) review.apply(sampleCorrecting(review.newCorrectionId()));
    review.apply(sampleBookmarking(review.newBookmarkId()));
    review.undo();
    addSeen(project, 1, "Ada", {{0, 20}, {40, 50}});
    rejectProposals(project, 1, {1, 2}, "Ada");
    savePreset(project, {"dusk", "", {{"gradient.quantile", "0.3"}, {"motion.min_speed", "2"}}});
    SweepStore sweeps(project);
    const int sweep = sweeps.add("quantile", 3, R"({"axes": []})");
    for (int i = 0; i < 3; ++i) sweeps.addPoint(sweep, {i, 1.5, R"({"f": 0.9})"});
    addComparison(project, "/videos/street.mp4", R"({"methods": []})");
}

}  // namespace

void writeFullProject(const std::filesystem::path& path) {
    static const std::string made = [] {
        const TemporaryFolder folder;
        makeFullProject(folder / "made.eyrie");
        return bytesOf(folder / "made.eyrie");
    }();
    writeBytes(path, made);
}

std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void writeBytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

}  // namespace eyrie::test
