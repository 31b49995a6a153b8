#include "io/live/camera_reader.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace eyrie {
namespace {

/// In which a camera that works sends its next picture and is closed.
constexpr std::chrono::milliseconds kTimeToClose{500};
/// That may wait to be taken; further ones wait in the driver, which leaves out what it has no room for.
constexpr std::size_t kReadAhead = 2;

}  // namespace

struct CameraReader::Shared {
    std::mutex mutex;
    std::condition_variable_any changed;
    std::deque<CameraPicture> pictures;
    double frame_rate_hz = 0;
    std::exception_ptr refused;  ///< why it could not be opened
    bool unwanted = false;
    bool closed = false;

    bool isWanted() {
        const std::scoped_lock lock(mutex);
        return !unwanted;
    }

    /// Answers whether another picture is wanted.
    bool hand(CameraPicture picture, double rate_hz) {
        std::unique_lock lock(mutex);
        pictures.push_back(std::move(picture));
        frame_rate_hz = rate_hz;
        changed.notify_all();
        changed.wait(lock, [&] { return unwanted || pictures.size() < kReadAhead; });
        return !unwanted;
    }

    void read(const std::string& device, const CameraOpener& open) {
        std::exception_ptr failure;
        try {
            const std::unique_ptr<CameraDevice> camera = open(device);
            for (bool wanted = isWanted(); wanted;) {
                CameraPicture picture;
                if (!camera->read(picture.pixels) || picture.pixels.empty()) break;
                picture.came = std::chrono::steady_clock::now();
                wanted = hand(std::move(picture), camera->frameRate());
            }
        } catch (...) {
            failure = std::current_exception();
        }
        const std::scoped_lock lock(mutex);  // whoever is told may open the camera again
        refused = failure;
        closed = true;
        changed.notify_all();
    }
};

CameraReader::CameraReader(const std::string& device, const CameraOpener& open) : shared_(std::make_shared<Shared>()) {
    std::thread([shared = shared_, device, open] { shared->read(device, open); }).detach();
}

CameraReader::~CameraReader() {
    std::unique_lock lock(shared_->mutex);
    shared_->unwanted = true;
    shared_->changed.notify_all();
    shared_->changed.wait_for(lock, kTimeToClose, [&] { return shared_->closed; });
}

std::optional<CameraPicture> CameraReader::next(double seconds, const std::stop_token& stop) {
    std::unique_lock lock(shared_->mutex);
    shared_->changed.wait_for(lock, stop, std::chrono::duration<double>(seconds),
                              [&] { return shared_->closed || !shared_->pictures.empty(); });
    if (stop.stop_requested()) return std::nullopt;
    if (!shared_->pictures.empty()) {
        CameraPicture picture = std::move(shared_->pictures.front());
        shared_->pictures.pop_front();
        shared_->changed.notify_all();
        return picture;
    }
    if (shared_->refused) std::rethrow_exception(shared_->refused);
    return std::nullopt;
}

double CameraReader::frameRate() const {
    const std::scoped_lock lock(shared_->mutex);
    return shared_->frame_rate_hz;
}

}  // namespace eyrie
