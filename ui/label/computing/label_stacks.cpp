#include "label/computing/label_stacks.h"

#include <algorithm>
#include <exception>

#include "annotation/keyframes/interpolation.h"
#include "session/background/lru_cache.h"

namespace eyrie::ui {

namespace {
constexpr int kWait_ms = 120;                                  ///< while keys are held nothing is made
constexpr std::size_t kStackBudget_bytes = 96U * 1024 * 1024;  ///< 25 grey frames of 2560×1440
/// An object that was just drawn lives in this frame only: for its stack it is followed a little to either side.
LabelledObject livedOn(LabelledObject object, FrameIndex frame, const GrayFrames& gray, const CameraMotion& camera,
                       const std::stop_token& stop) {
    constexpr FrameIndex kLongEnough = 3;
    constexpr FrameIndex kReach = 6;
    if (object.last_frame - firstFrameOf(object) + 1 >= kLongEnough) return object;
    const LabelledBox shown = boxAt(object, frame, camera);
    if (!shown.visible() || shown.box.length < 2 || shown.box.width < 2) return object;
    for (const FrameIndex last : {frame + kReach, std::max(0, frame - kReach)})
        for (const FollowedBox& box : followBox(shown.box, frame, last, gray, camera, {}, {}, stop).boxes)
            object = withBox(std::move(object), box.frame, box.box, true);
    return object;
}

}  // namespace

/// The pictures of one video, the last ones kept.
class LabelStacks::Pictures {
 public:
    cv::Mat gray(const Media& media, FrameIndex frame) {
        if (identity_ != media.identity) {
            kept_.clear();
            source_.reset();
            identity_ = media.identity;
        }
        if (const cv::Mat* known = kept_.find(frame)) return *known;
        if (!source_) source_ = media.open({}, {});
        cv::Mat picture = source_->read(frame, false).gray.clone();
        kept_.put(frame, picture, picture.total());
        return picture;
    }

 private:
    std::string identity_;
    std::unique_ptr<FrameSource> source_;
    LruCache<FrameIndex, cv::Mat> kept_{kStackBudget_bytes};
};

LabelStacks::LabelStacks(ProjectSession& session, LabelSession& labels, QObject* parent)
    : QObject(parent),
      session_(session),
      labels_(labels),
      due_(kWait_ms, [this] { begin(); }),
      pictures_(std::make_shared<Pictures>()) {}

LabelStacks::~LabelStacks() = default;

void LabelStacks::cancel() {
    due_.stop();
    query_.cancel();
}

void LabelStacks::request(ObjectId object, FrameIndex frame) {
    cancel();
    object_ = object;
    frame_ = frame;
    due_.start();
}

void LabelStacks::begin() {
    const LabelledObject* object = labels_.object(object_);
    if (object == nullptr || !session_.media()) return;
    query_.ask([this, object = *object, frame = frame_, media = *session_.media(), camera = labels_.sharedCamera(),
                pictures = pictures_](const BackgroundTask& task) {
        const GrayFrames gray = [&](FrameIndex index) {
            try {
                return pictures->gray(media, index);
            } catch (const std::exception&) {
                return cv::Mat();  // the canvas tells of pictures that cannot be read
            }
        };
        const ObjectStack stack =
            stackObject(livedOn(object, frame, gray, *camera, task.stop()), frame, *camera, gray, {}, task.stop());
        task.tell([this, id = object.id, stack] { emit ready(id, stack); });
    });
}

}  // namespace eyrie::ui

#include "moc_label_stacks.cpp"
