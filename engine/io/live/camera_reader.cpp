#include "io/live/camera_reader.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <map>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "core/error.h"

namespace eyrie {
namespace {

/// That may wait to be taken; further ones wait in the driver, which leaves out what it has no room for.
constexpr std::size_t kReadAhead = 2;

using Seconds = std::chrono::duration<double>;

/// The device itself, by whatever link it is named.
std::string deviceItself(const std::string& device) {
    std::error_code failed;
    const std::filesystem::path itself = std::filesystem::canonical(device, failed);
    return failed ? device : itself.string();
}

}  // namespace

struct CameraReader::Shared {
    std::mutex mutex;
    std::condition_variable_any changed;
    std::deque<CameraPicture> pictures;
    double frame_rate_hz = 0;
    std::exception_ptr refused;  ///< why it could not be opened
    bool unwanted = false;
    bool closed = false;

    bool isClosed() {
        const std::scoped_lock lock(mutex);
        return closed;
    }
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
        bool opened = false;
        try {
            const std::unique_ptr<CameraDevice> camera = open(device);
            opened = true;
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
        if (!opened) refused = failure;      // one that fails later on may be opened again
        closed = true;
        changed.notify_all();
    }

    /// Takes the place of the former reader of a device as soon as that one has closed it; false at `stop`.
    static bool takeOver(const std::string& device, const std::shared_ptr<Shared>& mine, double seconds,
                         const std::stop_token& stop);
};

/// The only state that a whole program shares: a device can be open once, whoever asks, and the thread that still has
/// it may belong to nobody any more.
bool CameraReader::Shared::takeOver(const std::string& device, const std::shared_ptr<Shared>& mine, double seconds,
                                    const std::stop_token& stop) {
    static std::mutex readers_mutex;
    static std::map<std::string, std::weak_ptr<Shared>> readers;
    const std::string itself = deviceItself(device);
    const auto deadline =
        std::chrono::steady_clock::now() + std::chrono::ceil<std::chrono::nanoseconds>(Seconds(seconds));
    while (true) {
        std::shared_ptr<Shared> former;
        {
            const std::scoped_lock lock(readers_mutex);
            former = readers[itself].lock();
            // One that has closed it is as good as none; of two who wait, the second waits for the first.
            if (!former || former->isClosed()) {
                readers[itself] = mine;
                return true;
            }
        }
        std::unique_lock lock(former->mutex);
        if (former->changed.wait_until(lock, stop, deadline, [&] { return former->closed; })) continue;
        if (stop.stop_requested()) return false;
        throw Error(ErrorKind::input,
                    device + (former->unwanted ? ": this camera hangs; disconnect it and connect it again"
                                               : ": this program uses this camera already; stop watching it first"));
    }
}

CameraReader::CameraReader(const std::string& device, const CameraOpener& open, const CameraPatience& patience,
                           const std::stop_token& stop)
    : patience_(patience), shared_(std::make_shared<Shared>()) {
    if (!Shared::takeOver(device, shared_, patience_.connect_s, stop)) {
        shared_->closed = true;
        return;
    }
    std::thread([shared = shared_, device, open] { shared->read(device, open); }).detach();
}

CameraReader::~CameraReader() {
    std::unique_lock lock(shared_->mutex);
    shared_->unwanted = true;
    shared_->changed.notify_all();
    shared_->changed.wait_for(lock, Seconds(patience_.close_s), [&] { return shared_->closed; });
}

std::optional<CameraPicture> CameraReader::next(double seconds, const std::stop_token& stop) {
    std::unique_lock lock(shared_->mutex);
    shared_->changed.wait_for(lock, stop, Seconds(seconds),
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
