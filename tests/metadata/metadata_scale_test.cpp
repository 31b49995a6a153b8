#include "metadata/metadata_scale.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "metadata/collected.h"
#include "support/temporary_folder.h"

namespace eyrie::metadata_scale_test {
namespace {

/// A video of 25 frames a second, whose pictures nobody asks for.
class Film : public FrameSource {
 public:
    explicit Film(int frames, std::filesystem::path path = "film.ts", bool has_stamps = true)
        : has_stamps_(has_stamps) {
        known.path = std::move(path);
        known.size = {200, 100};
        known.frame_count = frames;
    }
    const VideoInfo& info() const override { return known; }
    Frame read(FrameIndex, bool) override { return {}; }
    std::int64_t timeOf(FrameIndex frame) const override { return frame * std::int64_t{40'000}; }
    std::vector<PictureStamp> pictureStamps() const override {
        std::vector<PictureStamp> stamps;
        for (int i = 0; has_stamps_ && i < known.frame_count; ++i) stamps.push_back({timeOf(i), timeOf(i)});
        return stamps;
    }

    VideoInfo known;

 private:
    bool has_stamps_;
};

/// Of frames that state the width of what they show; each set counts for its frame alone.
MetadataScale scaleOf(const std::map<FrameIndex, double>& gsds, FrameIndex first, FrameIndex last) {
    const Film film(400);
    MetadataStream stream;
    for (const auto& [frame, gsd] : gsds) {
        MetadataPacket packet;
        packet.stamp_us = film.timeOf(frame);
        packet.pictures_before = frame;
        packet.numbers = {{tag::kTargetWidth, 200 * gsd}};
        stream.packets.push_back(packet);
    }
    TimelineOptions alone;
    alone.longest_gap_s = alone.longest_hold_s = 0.01;
    const MetadataTimeline timeline(stream, film.pictureStamps(), alone);
    return scaleByMetadata(timeline, film, first, last);
}

std::map<FrameIndex, double> inTurn(const std::vector<double>& gsds) {
    std::map<FrameIndex, double> by_frame;
    for (const double gsd : gsds) by_frame[static_cast<FrameIndex>(by_frame.size())] = gsd;
    return by_frame;
}

/// Of the first frames, one after the other.
MetadataScale scaleOf(const std::vector<double>& gsds) {
    return scaleOf(inTurn(gsds), 0, static_cast<FrameIndex>(gsds.size()) - 1);
}

}  // namespace

TEST(MetadataScale, FiftyFramesAreAskedSpreadOverAll) {
    std::map<FrameIndex, double> every_other;
    for (FrameIndex frame = 100; frame < 200; frame += 2) every_other[frame] = 0.5;
    const MetadataScale spread = scaleOf(every_other, 100, 199);
    EXPECT_EQ(spread.frames_asked, 50);
    EXPECT_EQ(spread.frames_known, 50);
    EXPECT_NEAR(spread.gsd_m_per_px, 0.5, 1e-12);
    EXPECT_EQ(spread.source, GroundSource::target_width);
    // Of 99 from an odd one on, the steps are 1.98 frames: ⌊1.98 i⌋ = 2 i − 1, odd but for the first.
    EXPECT_EQ(scaleOf(every_other, 101, 199).frames_known, 49);
    // Of fewer each one.
    const MetadataScale few = scaleOf(inTurn(std::vector<double>(9, 0.5)), 3, 8);
    EXPECT_EQ(few.frames_asked, 6);
    EXPECT_EQ(few.frames_known, 6);
    const MetadataScale none = scaleOf(inTurn(std::vector<double>(9, 0.5)), 5, 4);
    EXPECT_EQ(none.frames_asked, 0);
    EXPECT_FALSE(none.usable());
    EXPECT_EQ(none.why_not, "they give no scale");
}

TEST(MetadataScale, IsTheMedianWhereHalfOfTheFramesHaveOne) {
    EXPECT_NEAR(scaleOf({0.9, 0.5, 0.6}).gsd_m_per_px, 0.6, 1e-12);
    EXPECT_NEAR(scaleOf({0.9, 0.5, 0.7, 0.6}).gsd_m_per_px, 0.7, 1e-12) << "of two in the middle the larger";
    EXPECT_TRUE(scaleOf(inTurn({0.5, 0.5}), 0, 3).usable()) << "two of four";
    const MetadataScale fewer = scaleOf(inTurn({0.5, 0.5}), 0, 4);
    EXPECT_FALSE(fewer.usable());
    EXPECT_EQ(fewer.why_not, "only 2 of 5 frames looked at have a scale");
    EXPECT_EQ(fewer.frames_known, 2);
}

TEST(MetadataScale, IsFromFiveMillimetresToFiveMetres) {
    EXPECT_TRUE(scaleOf({0.0051}).usable());
    EXPECT_TRUE(scaleOf({4.99}).usable());
    EXPECT_EQ(scaleOf({0.0049}).why_not, "0.0049 m/px is implausible");
    EXPECT_EQ(scaleOf({5.01}).why_not, "5.01 m/px is implausible");
    EXPECT_EQ(scaleOf({5.01}).gsd_m_per_px, 0);
}

TEST(MetadataScale, ChangesByNoMoreThanAFactorOfTwoButForATwentiethAtEitherEnd) {
    EXPECT_TRUE(scaleOf({0.5, 0.99}).usable());
    EXPECT_EQ(scaleOf({0.5, 1.25}).why_not, "the scale changes from 0.5 to 1.25 m/px");
    const auto astray = [](std::size_t count, double gsd) {
        std::vector<double> gsds(40, 1.0);
        std::fill_n(gsds.begin(), count, gsd);
        return scaleOf(gsds);
    };
    EXPECT_TRUE(astray(2, 0.1).usable());
    EXPECT_EQ(astray(3, 0.1).why_not, "the scale changes from 0.1 to 1 m/px");
    EXPECT_TRUE(astray(2, 3).usable());
    EXPECT_EQ(astray(3, 3).why_not, "the scale changes from 1 to 3 m/px");
}

TEST(MetadataScale, HasTheSourceOfMostFrames) {
    const auto source = [](int by_width, int by_range) {
        const Film film(20);
        MetadataStream stream;
        for (int frame = 0; frame < by_width + by_range; ++frame) {
            MetadataPacket packet;
            packet.stamp_us = film.timeOf(frame);
            packet.pictures_before = frame;
            // 100 m over 200 px; twice the arc tangent of a half at 100 m shows as much.
            packet.numbers = {{tag::kTargetWidth, 100}};
            if (frame >= by_width) packet.numbers = {{tag::kHorizontalView, 53.130102}, {tag::kSlantRange, 100}};
            stream.packets.push_back(packet);
        }
        TimelineOptions alone;
        alone.longest_gap_s = alone.longest_hold_s = 0.01;
        const MetadataTimeline timeline(stream, film.pictureStamps(), alone);
        const MetadataScale scale = scaleByMetadata(timeline, film, 0, by_width + by_range - 1);
        EXPECT_NEAR(scale.gsd_m_per_px, 0.5, 1e-6);
        return scale.source;
    };
    EXPECT_EQ(source(3, 2), GroundSource::target_width);
    EXPECT_EQ(source(2, 3), GroundSource::slant_range);
}

TEST(MetadataScale, OfAFileCountsWhereNobodyGaveOne) {
    const test::TemporaryFolder folder;
    const test::KlvBytes set = test::LocalSetWriter().range(tag::kTargetWidth, 100, 0, 10000).bytes();
    std::ofstream(folder / "film.klv", std::ios::binary)
        .write(reinterpret_cast<const char*>(set.data()), static_cast<std::streamsize>(set.size()));
    // Its set holds for a second; ten frames are shorter.
    Film film(10, folder / "film.klv");
    const auto stated = [&](FrameIndex first, FrameIndex last, double given = 0) {
        return statedScale(film, first, last, given, ScaleOrigin::given, {});
    };
    const StatedScale whole = stated(0, -1);
    EXPECT_NEAR(whole.gsd_m_per_px, 0.5, 0.001);  // two bytes over 10 km
    EXPECT_EQ(whole.origin, ScaleOrigin::metadata);
    EXPECT_EQ(whole.by_metadata.frames_asked, 10);
    EXPECT_EQ(whole.by_metadata.frames_known, 10);
    EXPECT_EQ(stated(7, -1).by_metadata.frames_asked, 3);
    EXPECT_EQ(stated(0, 3).by_metadata.frames_asked, 4);
    EXPECT_EQ(stated(2, 50).by_metadata.frames_asked, 8) << "to the end";
    const StatedScale given = stated(0, -1, 0.3);
    EXPECT_EQ(given.gsd_m_per_px, 0.3);
    EXPECT_EQ(given.origin, ScaleOrigin::given);
    EXPECT_EQ(given.by_metadata.frames_asked, 0);
    EXPECT_FALSE(scaleByMetadata(Film(10, folder / "film.klv", false), 0, 9).usable()) << "no video file";
    const MetadataScale lost = scaleByMetadata(Film(10, folder / "lost.klv"), 0, 9);
    EXPECT_FALSE(lost.usable());
    EXPECT_FALSE(lost.why_not.empty());
    film.known.gsd_m_per_px = 0.2;
    EXPECT_EQ(stated(0, -1).gsd_m_per_px, 0) << "its own counts";
    EXPECT_EQ(stated(0, -1).origin, ScaleOrigin::given);
    EXPECT_EQ(stated(0, -1).by_metadata.frames_asked, 0);
}

}  // namespace eyrie::metadata_scale_test
