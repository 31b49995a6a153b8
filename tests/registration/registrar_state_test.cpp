// A registrar that was put away and taken up again goes on as if nothing had been.
#include <gtest/gtest.h>

#include "core/state_archive.h"
#include "registration/flight.h"
#include "registration/registrar.h"

namespace eyrie::registrar_state_test {
namespace {

using test::drift;
using test::Flight;
using test::frameOf;
using test::scaleOf;

void expectSame(const RegisteredFrame& a, const RegisteredFrame& b) {
    EXPECT_EQ(a.registration.state, b.registration.state);
    EXPECT_EQ(a.registration.current_from_previous.matrix, b.registration.current_from_previous.matrix);
    ASSERT_EQ(a.corners.size(), b.corners.size());
    for (std::size_t i = 0; i < a.corners.size(); ++i) {
        EXPECT_EQ(a.corners[i].id, b.corners[i].id);
        EXPECT_EQ(a.corners[i].current, b.corners[i].current);
        EXPECT_EQ(a.corners[i].age, b.corners[i].age);
    }
}

}  // namespace

TEST(RegistrarState, WhoIsTakenUpAgainGoesOnAsIfNothingHadBeen) {
    Flight flight;
    std::vector<cv::Mat> pictures;
    for (int i = 0; i < 8; ++i) {
        pictures.push_back(flight.picture());
        flight.move(drift());
    }
    pictures[4] = cv::Mat(test::kSize, CV_8UC1, cv::Scalar(0));  // black: corners outlive it
    Registrar whole({}, scaleOf(0.3));
    std::string before;  // as it was after the frame before; before the first nothing is remembered
    for (int i = 0; i < 8; ++i) {
        const Frame frame = frameOf(i, pictures[std::size_t(i)]);
        Registrar taken_up({}, scaleOf(0.3));
        if (i > 0) {
            StateReader reader(before, [&](FrameIndex at) { return pictures[std::size_t(at)]; });
            reader(taken_up);
            reader.end();
        }
        const RegisteredFrame result = whole.next(frame);
        expectSame(taken_up.next(frame), result);
        EXPECT_EQ(result.registration.state == RegistrationState::registered, i > 0 && i != 4) << i;
        StateWriter writer;
        writer(whole);
        before = writer.bytes();
    }
}

}  // namespace eyrie::registrar_state_test
