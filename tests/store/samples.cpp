#include "store/samples.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "store/project/schema.h"
#include "store/runs/result_writer.h"

namespace eyrie::test {
namespace {

class Dice {
 public:
    explicit Dice(unsigned seed) : engine_(seed) {}
    double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    float single(double low, double high) { return static_cast<float>(real(low, high)); }
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
    OrientedBox box(cv::Size image) {
        return {{real(0, image.width), real(0, image.height)}, real(8, 40), real(4, 15), real(-3, 3)};
    }
    std::vector<int> indices(int count) {
        std::vector<int> some;
        for (int index = whole(0, 3); index < count; index += whole(1, 5)) some.push_back(index);
        return some;
    }

 private:
    std::mt19937 engine_;
};

void fillMotion(Dice& dice, FrameIndex frame, const SampleSize& size, FrameMotion& motion) {
    motion.frame = frame;
    motion.time_us = frame * 40000LL + dice.whole(0, 9);
    motion.image_size = size.image;
    motion.registration.state = static_cast<RegistrationState>(frame % 4);
    if (frame % 4 == 3)
        motion.registration.failure = {RegistrationFault::too_few_found_again, PictureQuality::blurred, 12, 40};
    Homography& homography = motion.registration.current_from_previous;
    for (double& element : homography.matrix.val) element = dice.real(-2, 2);
    homography.from_frame = frame - 1;
    homography.to_frame = frame;
    homography.inliers = dice.whole(100, 9000);
    homography.rms_px = dice.real(0, 1);
    for (int i = 0; i < size.motion_vectors; ++i) {
        motion.motion_vectors.push_back({10'000'000'000LL + i,
                                         {dice.single(0, size.image.width), dice.single(0, size.image.height)},
                                         {dice.single(-9, 9), dice.single(-9, 9)},
                                         dice.whole(5, 400)});
    }
    for (int i = 0; i < size.stationary_corners; ++i) {
        motion.stationary_corners.emplace_back(dice.single(0, size.image.width - 1),
                                               dice.single(0, size.image.height - 1));
    }
    motion.corner_count = size.motion_vectors + size.stationary_corners + 3;
    motion.background_speed_sigma = dice.real(0, 0.3);
}

}  // namespace

FrameResult sampleFrame(FrameIndex frame, const SampleSize& size) {
    Dice dice(static_cast<unsigned>(frame) + 1);
    FrameResult result;
    fillMotion(dice, frame, size, result.motion);
    for (int i = 0; i < size.clusters; ++i) {
        result.clusters.push_back(
            {dice.box(size.image), {dice.real(-5, 5), dice.real(-5, 5)}, dice.indices(size.motion_vectors)});
        result.rois.push_back(result.clusters.back().box.scaled(2, 1.25));
    }
    for (int i = 0; i < size.detections; ++i) {
        result.detections.push_back({dice.box(size.image),
                                     dice.real(0, 1),
                                     {dice.real(-5, 5), dice.real(-5, 5)},
                                     dice.whole(-1, 5),
                                     dice.indices(size.motion_vectors),
                                     static_cast<Rejection>(i % 4),
                                     i % 3 == 0});
        if (i % 2 == 0) result.detections.back().decision = i - 2.5;
    }
    for (int i = 0; i < size.tracks; ++i) {
        result.tracks.push_back({i + 1,
                                 dice.box(size.image),
                                 {dice.real(-5, 5), dice.real(-5, 5)},
                                 static_cast<TrackStatus>(i % 3),
                                 static_cast<StateOrigin>((i + frame) % 3),
                                 frame + i,
                                 frame,
                                 dice.real(0, 1)});
    }
    for (float& ms : result.stage_ms) ms = dice.single(0, 20);
    return result;
}

RunRecord sampleRun() {
    RunRecord run;
    run.sequence.path = "/videos/street.mp4";
    run.sequence.size = {768, 576};
    run.sequence.frame_count = 100;
    run.sequence.frame_rate_hz = 29.97;
    run.sequence.rate_assumed = true;
    run.rate_assumed = true;
    run.name = "first try";
    run.engine_version = "0.1.0";
    run.preset = "thesis";
    run.scale = {0.345, 29.97, true};
    run.first_frame = 0;
    run.last_frame = 99;
    return run;
}

std::vector<FrameResult> twoTracks() {
    std::vector<FrameResult> frames(3);
    for (int i = 0; i < 3; ++i) {
        frames[static_cast<std::size_t>(i)].motion.frame = 4 + i;
        TrackState state;
        state.id = 1;
        state.velocity = {3, 4};
        state.box = {{10.0 + 3 * i, 20.0 + 4 * i}, 12.0 + i, 6, 0.5};
        state.status = i == 2 ? TrackStatus::confirmed : TrackStatus::tentative;
        state.score = 0.25 * i;
        frames[static_cast<std::size_t>(i)].tracks.push_back(state);
    }
    TrackState second;
    second.id = 2;
    frames[1].tracks.push_back(second);
    return frames;
}

namespace {

void expectSameBox(const OrientedBox& read, const OrientedBox& written) {
    EXPECT_EQ(read.centre, written.centre);
    EXPECT_EQ(read.length, written.length);
    EXPECT_EQ(read.width, written.width);
    EXPECT_EQ(read.heading, written.heading);
}

void expectSameMotion(const FrameMotion& read, const FrameMotion& written) {
    EXPECT_EQ(read.frame, written.frame);
    EXPECT_EQ(read.time_us, written.time_us);
    EXPECT_EQ(read.image_size, written.image_size);
    EXPECT_EQ(read.registration.state, written.registration.state);
    EXPECT_EQ(read.registration.failure, written.registration.failure);
    EXPECT_EQ(read.registration.elapsed, written.registration.elapsed);
    EXPECT_EQ(read.registration.zoom, written.registration.zoom);
    const Homography& a = read.registration.current_from_previous;
    const Homography& b = written.registration.current_from_previous;
    EXPECT_EQ(a.matrix, b.matrix);
    EXPECT_EQ(a.from_frame, b.from_frame);
    EXPECT_EQ(a.to_frame, b.to_frame);
    EXPECT_EQ(a.inliers, b.inliers);
    EXPECT_EQ(a.rms_px, b.rms_px);
    EXPECT_EQ(read.corner_count, written.corner_count);
    EXPECT_EQ(read.background_speed_sigma, written.background_speed_sigma);
    ASSERT_EQ(read.motion_vectors.size(), written.motion_vectors.size());
    for (std::size_t i = 0; i < read.motion_vectors.size(); ++i) {
        EXPECT_EQ(read.motion_vectors[i].id, written.motion_vectors[i].id);
        EXPECT_EQ(read.motion_vectors[i].position, written.motion_vectors[i].position);
        EXPECT_EQ(read.motion_vectors[i].velocity, written.motion_vectors[i].velocity);
        EXPECT_EQ(read.motion_vectors[i].age, written.motion_vectors[i].age);
    }
    ASSERT_EQ(read.stationary_corners.size(), written.stationary_corners.size());
    for (std::size_t i = 0; i < read.stationary_corners.size(); ++i) {
        EXPECT_NEAR(read.stationary_corners[i].x, written.stationary_corners[i].x, 1.0 / 32);
        EXPECT_NEAR(read.stationary_corners[i].y, written.stationary_corners[i].y, 1.0 / 32);
    }
}

void expectSameTrack(const TrackState& read, const TrackState& written) {
    EXPECT_EQ(read.id, written.id);
    expectSameBox(read.box, written.box);
    EXPECT_EQ(read.velocity, written.velocity);
    EXPECT_EQ(read.status, written.status);
    EXPECT_EQ(read.origin, written.origin);
    EXPECT_EQ(read.age, written.age);
    EXPECT_EQ(read.hits, written.hits);
    EXPECT_EQ(read.score, written.score);
}

}  // namespace

void expectSame(const FrameResult& read, const FrameResult& written) {
    SCOPED_TRACE("frame " + std::to_string(written.motion.frame));
    expectSameMotion(read.motion, written.motion);
    ASSERT_EQ(read.clusters.size(), written.clusters.size());
    for (std::size_t i = 0; i < read.clusters.size(); ++i) {
        expectSameBox(read.clusters[i].box, written.clusters[i].box);
        EXPECT_EQ(read.clusters[i].velocity, written.clusters[i].velocity);
        EXPECT_EQ(read.clusters[i].members, written.clusters[i].members);
    }
    ASSERT_EQ(read.rois.size(), written.rois.size());
    for (std::size_t i = 0; i < read.rois.size(); ++i) expectSameBox(read.rois[i], written.rois[i]);
    ASSERT_EQ(read.detections.size(), written.detections.size());
    for (std::size_t i = 0; i < read.detections.size(); ++i) {
        expectSameBox(read.detections[i].box, written.detections[i].box);
        EXPECT_EQ(read.detections[i].score, written.detections[i].score);
        EXPECT_EQ(read.detections[i].velocity, written.detections[i].velocity);
        EXPECT_EQ(read.detections[i].cluster, written.detections[i].cluster);
        EXPECT_EQ(read.detections[i].vectors, written.detections[i].vectors);
        EXPECT_EQ(read.detections[i].rejection, written.detections[i].rejection);
        EXPECT_EQ(read.detections[i].complete, written.detections[i].complete);
        EXPECT_TRUE(read.detections[i].decision == written.detections[i].decision ||
                    (std::isnan(read.detections[i].decision) && std::isnan(written.detections[i].decision)));
    }
    ASSERT_EQ(read.tracks.size(), written.tracks.size());
    for (std::size_t i = 0; i < read.tracks.size(); ++i) expectSameTrack(read.tracks[i], written.tracks[i]);
    EXPECT_EQ(ofTheChain(read.stage_ms), ofTheChain(written.stage_ms));
}

StageTimes ofTheChain(StageTimes times) {
    times[static_cast<std::size_t>(Stage::store)] = 0;
    return times;
}

int writeSampleProject(const std::filesystem::path& path, int frames, const SampleSize& size) {
    ProjectFile::openOrCreate(path);
    ResultWriter writer(path, sampleRun(), {{"motion.min_speed", "0.5"}, {"detection.method", "gradient"}});
    for (int frame = 0; frame < frames; ++frame) writer.write(sampleFrame(frame, size));
    writer.finish(RunState::finished, "");
    return writer.runId();
}

void writeRunsOfSchemaEleven(const std::filesystem::path& path) {
    SQLite::Database database(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    schema::migrate(database, schema::migrations().first(11));
    database.exec("PRAGMA application_id = " + std::to_string(schema::kApplicationId));
    database.exec(
        "INSERT INTO sequence (id, path, width, height, frame_count, frame_rate_hz) "
        "VALUES (1, '/videos/old.mp4', 64, 48, 20, 25)");
    for (const char* scale : {"0.3, 1", "0.25, 0", "0.091, 0", "0.25, 1"}) {
        database.exec(std::string("INSERT INTO run (sequence_id, name, started_utc, engine_version, preset, "
                                  "gsd_m_per_px, gsd_known, frame_rate_hz, first_frame, last_frame, state, message) "
                                  "VALUES (1, 'old', '', '', '', ") +
                      scale + ", 25, 0, 19, 'stopped', '')");
    }
}

void expectOriginsOfSchemaEleven(ProjectFile& project) {
    const RunStore store(project);
    const ScaleOrigin expected[] = {ScaleOrigin::given, ScaleOrigin::assumed, ScaleOrigin::estimated,
                                    ScaleOrigin::given};
    for (int run = 1; run <= 4; ++run) {
        EXPECT_EQ(store.run(run)->scale_basis, ScaleBasis{expected[run - 1]}) << run;
    }
}

void readEverything(const std::filesystem::path& path) {
    ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
    const RunStore store(project);
    for (const RunRecord& run : store.runs()) {
        store.parameters(run.id);
        for (const FrameSummary& summary : store.frameSummaries(run.id)) store.frameResult(run.id, summary.frame);
        for (const TrackSummary& track : store.tracks(run.id)) store.trackStates(run.id, track.id);
        store.trackBoxes(run.id);
        store.detectionBoxes(run.id);
        store.trackStatesUpTo(run.id, run.last_frame, 50);
    }
}

}  // namespace eyrie::test
