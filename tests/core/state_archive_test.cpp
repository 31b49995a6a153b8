#include "core/state_archive.h"

#include <gtest/gtest.h>

#include "core/state_values.h"

namespace eyrie::state_archive_test {
namespace {

enum class Colour { red, green, blue };

struct Thing {
    int number = 0;
    Colour colour = Colour::red;
    bool on = false;
    std::vector<float> values;
    std::deque<std::string> words;
    std::map<int, cv::Point2d> places;
    std::optional<double> maybe;
    cv::Matx33d matrix;
    cv::Mat chip = cv::Mat(0, 0, CV_8UC1);
    FrameMotion motion;

    template <class Archive>
    void transfer(Archive& archive) {
        archive.word(colour, Colour::blue);
        archive(number, on, values, words, places, maybe, matrix, chip, motion);
    }
};

Thing sample() {
    Thing thing;
    thing.number = -7;
    thing.colour = Colour::blue;
    thing.on = true;
    thing.values = {1.5F, -0.0F, 1e-30F};
    thing.words = {"", "two"};
    thing.places = {{3, {0.1, 0.2}}, {9, {-1, 1e300}}};
    thing.maybe = 0.1;
    thing.matrix = cv::Matx33d(1, 2, 3, 4, 5, 6, 7, 8, 9);
    thing.chip = (cv::Mat_<std::uint8_t>(2, 3) << 1, 2, 3, 4, 5, 6);
    thing.motion.registration.failure = {RegistrationFault::too_few_agree, PictureQuality::blank, 12, 40};
    thing.motion.registration.state = RegistrationState::failed;
    thing.motion.motion_vectors = {{CornerId{1} << 40, {1, 2}, {3, 4}, 5}};
    return thing;
}

std::string bytesOf(Thing thing) {
    StateWriter writer;
    writer(thing);
    return writer.bytes();
}

cv::Mat noPicture(FrameIndex) {
    throw DamagedState{"no picture"};
}

Thing read(const std::string& bytes) {
    StateReader reader(bytes, noPicture);
    Thing thing;
    reader(thing);
    reader.end();
    return thing;
}

}  // namespace

TEST(StateArchive, GivesBackWhatWasWrittenToTheBit) {
    const std::string bytes = bytesOf(sample());
    const Thing thing = read(bytes);
    EXPECT_EQ(bytesOf(thing), bytes);
    EXPECT_EQ(thing.places, sample().places);
    EXPECT_EQ(thing.words, sample().words);
    EXPECT_EQ(thing.chip.at<std::uint8_t>(1, 2), 6);
    EXPECT_EQ(thing.motion.registration.failure,
              (RegistrationFailure{RegistrationFault::too_few_agree, PictureQuality::blank, 12, 40}));
    EXPECT_EQ(thing.motion.motion_vectors.at(0).id, CornerId{1} << 40);
}

TEST(StateArchive, RefusesEveryBeginningAndAnythingBehind) {
    const std::string bytes = bytesOf(sample());
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        EXPECT_THROW(read(bytes.substr(0, length)), DamagedState) << length;
    }
    EXPECT_THROW(read(bytes + "x"), DamagedState);
}

TEST(StateArchive, NeverTakesMemoryForWhatIsNotThere) {
    const std::string bytes = bytesOf(sample());
    // A wrong byte anywhere gives another value or is refused, whatever size it claims.
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(0xff);
        try {
            read(damaged);
        } catch (const DamagedState&) {
        }
    }
}

TEST(StateArchive, ChecksumsAreThoseOfTheStatesThatProjectsKeep) {
    EXPECT_EQ(checksumOf(std::string_view("")), 0xaf63bd4c29620a93ULL);
    EXPECT_EQ(checksumOf(std::string_view("eyrie")), 0xdd8517e1b2eb3d21ULL);
    EXPECT_EQ(checksumOf(std::string_view("12345678")), 0x991b59351ed9dd43ULL);
    EXPECT_EQ(checksumOf(std::string_view("123456789abc")), 0x39f9715d38e2827eULL);
    const cv::Mat gray = (cv::Mat_<std::uint8_t>(2, 3) << 1, 2, 3, 4, 5, 6);
    EXPECT_EQ(checksumOf(gray), 0x8aff28c43838ae7bULL);
}

TEST(StateArchive, AsksForPicturesInTheOrderOfTheVideo) {
    const cv::Mat gray(4, 9, CV_8UC1, cv::Scalar(7));
    StateWriter writer;
    for (FrameIndex frame : {9, 3, 8}) writer.picture(frame, gray);
    const std::string bytes = writer.bytes();
    std::vector<FrameIndex> asked;
    StateReader reader(bytes, [&](FrameIndex frame) {
        asked.push_back(frame);
        return gray;
    });
    FrameIndex frame = 0;
    for (int i = 0; i < 3; ++i) reader.picture(frame, {});
    reader.end();
    EXPECT_EQ(asked, (std::vector<FrameIndex>{3, 8, 9}));
}

TEST(StateArchive, NamesPicturesAndKnowsThemAgain) {
    cv::Mat gray(4, 9, CV_8UC1, cv::Scalar(7));
    StateWriter writer;
    FrameIndex frame = 12;
    writer.picture(frame, gray);
    writer.picture(frame, gray);
    const std::string bytes = writer.bytes();
    int asked = 0;
    const PictureSource source = [&](FrameIndex index) {
        EXPECT_EQ(index, 12);
        ++asked;
        return gray;
    };
    StateReader reader(bytes, source);
    FrameIndex first = 0;
    FrameIndex second = 0;
    EXPECT_EQ(reader.picture(first, {}).data, reader.picture(second, {}).data);
    EXPECT_EQ(first, 12);
    EXPECT_EQ(asked, 1) << "a picture is shared";
    cv::Mat other = gray.clone();
    other.at<std::uint8_t>(3, 8) = 8;
    StateReader changed(bytes, [&](FrameIndex) { return other; });
    EXPECT_THROW(changed.picture(first, {}), ChangedPicture);
}

}  // namespace eyrie::state_archive_test
