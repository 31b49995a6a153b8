#include "review/card/story_loader.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "canvas/drawing/image_convert.h"
#include "review/watch/watched_ground.h"

namespace eyrie::ui {

namespace {

constexpr int kMostChips = 24;
constexpr double kBefore_s = 2;
constexpr double kAfter_s = 2;
constexpr double kSurroundingLengths = 4;  ///< of the vehicle
constexpr double kLeastSurroundings = 40;  ///< px

}  // namespace

/// The video that was read last.
struct StoryLoader::Opened {
    std::string identity;
    std::unique_ptr<FrameSource> source;
};

StoryLoader::StoryLoader(Came came) : came_(std::move(came)), opened_(std::make_shared<Opened>()) {}

StoryLoader::~StoryLoader() = default;

void StoryLoader::cancel() {
    query_.cancel();
}

void StoryLoader::close() {
    query_.cancel();
    query_.post([opened = opened_](const BackgroundTask&) { opened->source.reset(); });
}

void StoryLoader::ask(const StoryWish& wish) {
    query_.ask([this, wish, opened = opened_](const BackgroundTask& task) {
        auto story = std::make_shared<VehicleStory>();
        story->wish = wish;
        story->points = storyOf(*wish.ground->run, wish.ground->stretches, wish.track, wish.frame);
        story->shown = chosenAround(story->points, wish.frame, kBefore_s, kAfter_s, kMostChips);
        task.tell([this, known = std::make_shared<const VehicleStory>(*story)] { came_(known); });
        double length = 0;
        for (const StoryPoint& point : story->shown) length = std::max(length, point.length_px);
        const double side = std::max(kLeastSurroundings, kSurroundingLengths * length);
        try {
            if (!opened->source || opened->identity != wish.media.identity) {
                opened->source = wish.media.open({}, task.stop());
                opened->identity = wish.media.identity;
            }
            for (const StoryPoint& point : story->shown) {
                if (task.stop().stop_requested()) return;
                const Frame frame = opened->source->read(point.frame, true);
                const cv::Mat& picture = frame.colour.empty() ? frame.gray : frame.colour;
                story->chips.push_back(imageForDisplay(chipOf(picture, point.image, side, kChipSize)));
            }
        } catch (const std::exception&) {
            // What cannot be read has no chip; those before it are shown. The canvas tells why.
            opened->source.reset();
            if (task.stop().stop_requested()) return;
            story->shown.resize(story->chips.size());
        }
        task.tell([this, shown = std::make_shared<const VehicleStory>(*story)] { came_(shown); });
        if (!opened->source) return;
        const ObjectStack stack =
            stackOfTrack(*wish.ground->run, wish.track, wish.frame, grayReader(*opened->source), task.stop());
        if (stack.stacked.empty() || task.stop().stop_requested()) return;
        story->stack = imageForDisplay(stack.stacked);
        task.tell([this, shown = std::make_shared<const VehicleStory>(*story)] { came_(shown); });
    });
}

}  // namespace eyrie::ui
