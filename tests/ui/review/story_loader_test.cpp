#include "review/card/story_loader.h"

#include <QTest>
#include <atomic>

#include "core/error.h"
#include "review/watch/watched_ground.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::story_loader_test {

using test::kPatience_ms;

namespace {

constexpr int kStoryFrames = 60;

/// Tells how many of its kind are open.
class CountedSource : public test::SceneSource {
 public:
    CountedSource(std::shared_ptr<std::atomic<int>> open, FrameIndex unreadable_from)
        : SceneSource(kStoryFrames,
                      [unreadable_from](FrameIndex frame) {
                          if (frame >= unreadable_from) throw Error(ErrorKind::input, "a scratch");
                      }),
          open_(std::move(open)) {
        ++*open_;
    }
    ~CountedSource() override { --*open_; }

 private:
    std::shared_ptr<std::atomic<int>> open_;
};

/// One vehicle that drives over ground that stands.
std::shared_ptr<const RunGround> driven() {
    auto run = std::make_shared<StoredTracks>();
    run->footage.image_size = {240, 180};
    run->footage.last_frame = kStoryFrames - 1;
    std::vector<Homography> steps;
    for (int frame = 1; frame < kStoryFrames; ++frame) {
        Homography step;
        step.from_frame = frame - 1;
        step.to_frame = frame;
        steps.push_back(step);
    }
    run->footage.camera = CameraMotion(steps);
    EventTrack track;
    track.id = 1;
    for (int frame = 0; frame < kStoryFrames; ++frame)
        track.boxes.push_back({frame, {{30.0 + 3 * frame, 55}, 22, 11, 0}});
    run->tracks.push_back(track);
    return std::make_shared<const RunGround>(run);
}

}  // namespace

/// The story of a vehicle, read in the background.
class StoryLoaderTest : public QObject {
    Q_OBJECT

    std::shared_ptr<std::atomic<int>> open_ = std::make_shared<std::atomic<int>>(0);
    std::shared_ptr<const VehicleStory> story_;

    StoryWish wish(FrameIndex unreadable_from) const {
        Media media;
        media.name = "scene.mp4";
        media.identity = "/nowhere/scene.mp4";
        media.open = [open = open_, unreadable_from](const IndexProgress&, std::stop_token) {
            return std::make_unique<CountedSource>(open, unreadable_from);
        };
        return {driven(), media, 1, 25};
    }

 private slots:
    void theVideoIsLetGo() {
        StoryLoader loader([this](const auto& story) { story_ = story; });
        loader.ask(wish(kStoryFrames));
        QTRY_VERIFY_WITH_TIMEOUT(story_ && story_->chips.size() == 24, kPatience_ms);
        QCOMPARE(story_->shown.size(), std::size_t(24));
        QCOMPARE(open_->load(), 1);
        loader.close();
        QTRY_COMPARE_WITH_TIMEOUT(open_->load(), 0, kPatience_ms);
    }

    void theVehicleIsStackedOverManyFrames() {
        StoryLoader loader([this](const auto& story) { story_ = story; });
        story_.reset();
        loader.ask(wish(kStoryFrames));
        QTRY_VERIFY_WITH_TIMEOUT(story_ && !story_->stack.isNull(), kPatience_ms);
        QCOMPARE(story_->chips.size(), std::size_t(24));
        QVERIFY2(story_->stack.width() > story_->stack.height(), "it heads to the right and is longer than wide");
    }

    void framesThatCannotBeReadCostTheirOwnChipsOnly() {
        StoryLoader loader([this](const auto& story) { story_ = story; });
        story_.reset();
        loader.ask(wish(30));
        QTRY_VERIFY_WITH_TIMEOUT(story_ && !story_->chips.empty(), kPatience_ms);
        QCOMPARE(story_->shown.size(), story_->chips.size());
        QVERIFY(story_->shown.back().frame < 30);
        QVERIFY(!story_->points.empty() && story_->points.back().frame == kStoryFrames - 1);
    }
};

}  // namespace eyrie::ui::story_loader_test

EYRIE_UI_TEST(QApplication, story_loader_test, StoryLoaderTest)
#include "story_loader_test.moc"
