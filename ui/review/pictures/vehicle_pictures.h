#pragma once

#include <QImage>
#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "review/pictures/vehicle_place.h"
#include "session/background/background_query.h"
#include "session/background/lru_cache.h"
#include "session/project/media.h"

namespace eyrie::ui {

/// Small pictures of vehicles, read in the background; of several wishes the newest counts. What was read is kept for a
/// while, and the video stays open for the next wish until letGo().
class VehiclePictures {
 public:
    static constexpr int kWidth = 168;  ///< px of a picture: twice of what is shown, for screens of fine pixels
    static constexpr int kHeight = 96;

    /// `came` is called for each picture that was read, or could not be.
    explicit VehiclePictures(std::function<void()> came);
    ~VehiclePictures();

    /// Reads what is not known of these, and nothing else any more.
    void want(const Media& media, const std::vector<VehiclePlace>& places);
    /// Null while it is not read; a null image where it cannot be. Valid until the next call.
    const QImage* find(const VehiclePlace& place) { return known_.find(place); }
    /// Lets the video go; what was read stays.
    void letGo();
    /// The same; and what was read is of another video.
    void forget();

 private:
    struct Opened;
    void take(const VehiclePlace& place, const QImage& picture);

    std::function<void()> came_;
    LruCache<VehiclePlace, QImage> known_;
    std::set<VehiclePlace> reading_;  ///< that were asked for, and did not come yet
    std::shared_ptr<Opened> opened_;  ///< used in the background alone
    BackgroundQuery query_;           ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
