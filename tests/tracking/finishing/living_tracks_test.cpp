#include <gtest/gtest.h>

#include "tracking/finishing/shared_frames.h"

namespace eyrie::living_tracks_test {
namespace {

TEST(LivingTracks, ThoseThatShareAFrameAreToldOnceAndInOrder) {
    LivingTracks living;
    living.add(7, 0, 1000);
    living.add(3, 100, 199);
    living.add(5, 200, 200);
    EXPECT_EQ(living.during(150, 199), (std::vector<std::size_t>{3, 7}));
    EXPECT_EQ(living.during(199, 200), (std::vector<std::size_t>{3, 5, 7}));
    EXPECT_EQ(living.during(200, 900), (std::vector<std::size_t>{5, 7}));
    EXPECT_EQ(living.during(1001, 2000), std::vector<std::size_t>{});
}

TEST(LivingTracks, AreThoseThatComparingAllWouldFind) {
    LivingTracks living;
    const auto first = [](int track) { return 37 * track % 500; };
    const auto last = [&](int track) { return first(track) + 53 * track % 190; };
    for (int track = 0; track < 100; ++track) living.add(static_cast<std::size_t>(track), first(track), last(track));
    for (int asked = 0; asked < 100; ++asked) {
        std::vector<std::size_t> meet;
        for (int track = 0; track < 100; ++track)
            if (first(track) <= last(asked) && first(asked) <= last(track))
                meet.push_back(static_cast<std::size_t>(track));
        EXPECT_EQ(living.during(first(asked), last(asked)), meet) << asked;
    }
}

}  // namespace
}  // namespace eyrie::living_tracks_test
