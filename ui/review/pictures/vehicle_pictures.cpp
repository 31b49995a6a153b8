#include "review/pictures/vehicle_pictures.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "canvas/drawing/image_convert.h"

namespace eyrie::ui {

namespace {

/// Some 250 pictures; many times what a screen shows, so that none goes while it is seen.
constexpr std::size_t kPictures_bytes = std::size_t{16} << 20U;
constexpr std::size_t kEntry_bytes = 256;  ///< of one without a picture

}  // namespace

/// The video that was read last.
struct VehiclePictures::Opened {
    std::string identity;
    std::unique_ptr<FrameSource> source;

    FrameSource& open(const Media& media, const std::stop_token& stop) {
        if (!source || identity != media.identity) {
            source = media.open({}, stop);
            identity = media.identity;
        }
        return *source;
    }
};

VehiclePictures::VehiclePictures(std::function<void()> came)
    : came_(std::move(came)), known_(kPictures_bytes), opened_(std::make_shared<Opened>()) {}

VehiclePictures::~VehiclePictures() = default;

void VehiclePictures::want(const Media& media, const std::vector<VehiclePlace>& places) {
    std::set<VehiclePlace> missing;  // by frame: going on in a video is cheaper than going back
    for (const VehiclePlace& place : places)
        if (!known_.contains(place)) missing.insert(place);
    // What is being read already comes sooner when it is not begun anew.
    if (std::includes(reading_.begin(), reading_.end(), missing.begin(), missing.end())) return;
    reading_ = missing;
    query_.ask([this, missing, media, opened = opened_](const BackgroundTask& task) {
        Frame frame;
        bool any_frame = false;
        for (const VehiclePlace& place : missing) {
            if (task.stop().stop_requested()) return;
            QImage picture;
            try {
                FrameSource& source = opened->open(media, task.stop());
                if (!any_frame || frame.index != place.frame) {
                    any_frame = false;
                    frame = source.read(place.frame, true);
                    any_frame = true;
                }
                const cv::Mat& pixels = frame.colour.empty() ? frame.gray : frame.colour;
                picture = imageForDisplay(pictureOfVehicle(pixels, place.box, {kWidth, kHeight}));
            } catch (const std::exception&) {
                // What cannot be read has no picture here; the canvas tells why.
                if (task.stop().stop_requested()) return;
            }
            task.tell([this, place, picture] { take(place, picture); });
        }
    });
}

void VehiclePictures::take(const VehiclePlace& place, const QImage& picture) {
    reading_.erase(place);
    known_.put(place, picture, kEntry_bytes + static_cast<std::size_t>(picture.sizeInBytes()));
    came_();
}

void VehiclePictures::letGo() {
    query_.cancel();
    reading_.clear();
    query_.post([opened = opened_](const BackgroundTask&) { opened->source.reset(); });
}

void VehiclePictures::forget() {
    letGo();
    known_.clear();
}

}  // namespace eyrie::ui
