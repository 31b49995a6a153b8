#include "events/review/stop_groups.h"

#include <gmock/gmock.h>

#include "events/review/review_queue.h"

namespace eyrie::stop_groups_test {
namespace {

using testing::ElementsAre;
using testing::Eq;

Event step(EventKind kind, FrameIndex first, FrameIndex last, TrackId track = 1) {
    Event event;
    event.kind = kind;
    event.tracks = {track};
    event.first_frame = event.frame = first;
    event.last_frame = last;
    return event;
}

}  // namespace

TEST(StopGroups, AStopIsFollowedToItsStart) {
    const auto stops =
        stopsOf({step(EventKind::appears, 0, 0), step(EventKind::stops, 10, 10), step(EventKind::stands, 10, 90),
                 step(EventKind::starts, 91, 91), step(EventKind::stops, 120, 120), step(EventKind::starts, 125, 125)});
    EXPECT_THAT(stops, ElementsAre(Eq(std::nullopt), Eq(0U), Eq(0U), Eq(0U), Eq(1U), Eq(1U)));
}

TEST(StopGroups, WhateverTheOrderAndOfEachVehicleAlone) {
    const auto stops = stopsOf({step(EventKind::starts, 91, 91, 1), step(EventKind::stands, 10, 90, 2),
                                step(EventKind::stops, 10, 10, 1), step(EventKind::starts, 91, 91, 2)});
    EXPECT_TRUE(stops[0] && stops[1]);
    EXPECT_EQ(stops[0], stops[2]);
    EXPECT_EQ(stops[1], stops[3]);
    EXPECT_NE(stops[0], stops[1]);
}

TEST(StopGroups, WhatIsAloneIsOfNone) {
    // It stood from the beginning of its track, drove off, and stopped for good.
    const auto stops = stopsOf({step(EventKind::starts, 20, 20), step(EventKind::stops, 80, 80)});
    EXPECT_THAT(stops, ElementsAre(Eq(std::nullopt), Eq(std::nullopt)));
    EXPECT_TRUE(stopsOf({}).empty());
}

TEST(StopGroups, WhatMovedInBetweenIsOfNoStop) {
    const auto none = [](const std::vector<Event>& events) {
        EXPECT_THAT(stopsOf(events), testing::Each(Eq(std::nullopt)));
    };
    none({step(EventKind::stops, 10, 10), step(EventKind::stops, 20, 20)});
    none({step(EventKind::stops, 10, 10), step(EventKind::stands, 11, 90)});
    none({step(EventKind::stops, 10, 10), step(EventKind::starts, 10, 10)});  // a start comes later
    none({step(EventKind::stands, 10, 90), step(EventKind::starts, 90, 90)});
    none({step(EventKind::stands, 10, 90), step(EventKind::starts, 80, 80)});
    none({step(EventKind::starts, 10, 10), step(EventKind::stands, 10, 90)});
}

TEST(StopGroups, OtherKindsAndSeveralVehiclesAreOfNone) {
    const auto stops =
        stopsOf({step(EventKind::appears, 10, 10), step(EventKind::stands, 10, 90), step(EventKind::leaves, 95, 95)});
    EXPECT_THAT(stops, testing::Each(Eq(std::nullopt)));
    Event together = step(EventKind::stands, 10, 90);
    together.tracks = {1, 2};
    EXPECT_THAT(stopsOf({together, step(EventKind::starts, 91, 91)}), testing::Each(Eq(std::nullopt)));
}

TEST(StopGroups, AStopInTwoStepsHasThemBoth) {
    EXPECT_THAT(stopsOf({step(EventKind::stands, 10, 90), step(EventKind::starts, 91, 91)}),
                ElementsAre(Eq(0U), Eq(0U)));
    EXPECT_THAT(stopsOf({step(EventKind::stops, 10, 10), step(EventKind::stands, 10, 90)}),
                ElementsAre(Eq(0U), Eq(0U)));
}

TEST(StopGroups, AreLookedAtWhereTheMostUrgentOfThemWouldBe) {
    // Stops and stands are many, only one vehicle starts again.
    std::vector<Event> events{step(EventKind::stops, 10, 10), step(EventKind::stands, 10, 90),
                              step(EventKind::starts, 91, 91)};
    for (int i = 0; i < 9; ++i) {
        events.push_back(step(EventKind::stops, 5, 5, 10 + i));
        events.push_back(step(EventKind::stands, 5, 99, 10 + i));
    }
    const auto queue = reviewQueue(events, {}, std::vector<bool>(events.size(), false));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(queue[i], (QueueItem{QueueGroup::rare, true, i}));
    EXPECT_EQ(queue[3].group, QueueGroup::rest);
}

}  // namespace eyrie::stop_groups_test
