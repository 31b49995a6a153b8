#include "io/video/frame_cache.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "core/error.h"

namespace eyrie {

namespace {

/// What a second decoder keeps for itself: some sixteen pictures without colours of their own, and where each frame
/// lies.
constexpr std::size_t kDecoderPictures = 6;
constexpr std::size_t kIndexBytes = 160;  ///< a frame

std::size_t bytesOf(const Frame& frame) {
    return frame.gray.total() * frame.gray.elemSize() + frame.colour.total() * frame.colour.elemSize();
}

std::size_t bytesOfFrame(const VideoInfo& info, const FrameCacheOptions& options) {
    return static_cast<std::size_t>(std::max(1, info.size.area())) * (options.with_colour ? 4U : 1U);
}

/// Frames that would fit instead of a second decoder.
int framesOfDecoder(const VideoInfo& info, const FrameCacheOptions& options) {
    const std::size_t index = kIndexBytes * static_cast<std::size_t>(std::max(0, info.frame_count));
    return static_cast<int>(kDecoderPictures + index / bytesOfFrame(info, options) + 1);
}

int framesThatFit(const VideoInfo& info, const FrameCacheOptions& options) {
    const std::size_t frames = options.max_bytes / bytesOfFrame(info, options);
    return static_cast<int>(std::clamp<std::size_t>(frames, 1, 1U << 20U));
}

}  // namespace

FrameCache::FrameCache(std::unique_ptr<FrameSource> source, FrameCacheOptions options, Arrived arrived)
    : source_(std::move(source)),
      info_(source_->info()),
      options_(options),
      arrived_(std::move(arrived)),
      capacity_(framesThatFit(info_, options_)),
      max_bytes_(options_.max_bytes) {
    source_->giveUpWhen([this] { return given_up_.load(); });
    times_us_.reserve(static_cast<std::size_t>(info_.frame_count));
    for (FrameIndex index = 0; index < info_.frame_count; ++index) times_us_.push_back(source_->timeOf(index));
    thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

FrameCache::~FrameCache() {
    thread_.request_stop();
    given_up_ = true;
    thread_.join();
}

std::string FrameCache::noSuchFrame(FrameIndex index) const {
    return info_.path.string() + ": there is no frame " + std::to_string(index) + "; the video has " +
           std::to_string(info_.frame_count) + " frames";
}

std::int64_t FrameCache::timeOf(FrameIndex index) const {
    if (index < 0 || index >= info_.frame_count) throw Error(ErrorKind::input, noSuchFrame(index));
    return times_us_[static_cast<std::size_t>(index)];
}

std::shared_ptr<const Frame> FrameCache::tryGet(FrameIndex index) {
    if (index < 0 || index >= info_.frame_count) return nullptr;
    const std::lock_guard lock(mutex_);
    request(index);
    const auto found = frames_.find(index);
    return found == frames_.end() ? nullptr : found->second;
}

std::shared_ptr<const Frame> FrameCache::get(FrameIndex index) {
    if (index < 0 || index >= info_.frame_count) throw Error(ErrorKind::input, noSuchFrame(index));
    std::unique_lock lock(mutex_);
    request(index);
    if (const auto found = frames_.find(index); found != frames_.end()) return found->second;
    Waiter waiter;
    waiter.index = index;
    if (const auto found = errors_.find(index); found != errors_.end()) {
        waiter.error = found->second;
    } else {
        waiters_.push_back(&waiter);
        idle_ = false;
        wake_.notify_one();
        arrival_.wait(lock, [&] { return waiter.done; });
        waiters_.remove(&waiter);
    }
    if (!waiter.frame) throw Error(ErrorKind::input, waiter.error);
    return waiter.frame;
}

void FrameCache::expect(std::vector<FrameIndex> frames) {
    std::erase_if(frames, [this](FrameIndex index) { return index < 0 || index >= info_.frame_count; });
    const std::lock_guard lock(mutex_);
    expected_ = std::move(frames);
    idle_wake_.notify_all();
}

std::size_t FrameCache::expectedThatFit() const {
    const Window near = window();
    const int decoder = second_decoder_ ? 0 : framesOfDecoder(info_, options_);
    const int room = capacity_ - decoder - (near.last - near.first + 1);
    return std::min(expected_.size(), static_cast<std::size_t>(std::max(0, room)));
}

std::optional<FrameIndex> FrameCache::missingExpected() const {
    if (!idle_) return std::nullopt;
    const auto end = expected_.begin() + static_cast<std::ptrdiff_t>(expectedThatFit());
    const auto missing = std::find_if(expected_.begin(), end, [this](FrameIndex index) { return !isKnown(index); });
    return missing == end ? std::nullopt : std::optional(*missing);
}

std::optional<FrameIndex> FrameCache::nextExpected(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    std::optional<FrameIndex> next;
    idle_wake_.wait(lock, stop, [&] { return (next = missingExpected()).has_value(); });
    if (stop.stop_requested()) return std::nullopt;
    if (!std::exchange(second_decoder_, true)) {
        const int decoder = framesOfDecoder(info_, options_);
        capacity_ -= decoder;
        max_bytes_ -= static_cast<std::size_t>(decoder) * bytesOfFrame(info_, options_);
        makeRoom();
    }
    return next;
}

bool FrameCache::hasTimeFor(FrameIndex expected) const {
    const std::lock_guard lock(mutex_);
    return idle_ && std::find(expected_.begin(), expected_.end(), expected) != expected_.end();
}

void FrameCache::putExpected(FrameIndex index, std::shared_ptr<const Frame> frame) {
    const std::lock_guard lock(mutex_);
    if (frame)
        keep(index, std::move(frame));
    else
        std::erase(expected_, index);
}

std::size_t FrameCache::bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
}

void FrameCache::request(FrameIndex index) {
    if (index == wanted_) return;
    const bool steps_back = wanted_ >= 0 && index < wanted_ && wanted_ - index <= 2 * options_.behind;
    direction_ = steps_back ? -1 : 1;
    wanted_ = index;
    announced_ = isKnown(index);
    idle_ = false;  // until the thread has looked
    if (reading_ahead_ >= 0 && !window().holds(reading_ahead_)) given_up_ = true;
    wake_.notify_one();
}

int FrameCache::stepsBack() const {
    return std::clamp(options_.behind, 0, (capacity_ - 1) * 2 / 3);
}

FrameCache::Window FrameCache::window() const {
    if (wanted_ < 0) return {};
    if (direction_ < 0) return {std::max(0, wanted_ - stepsBack() - stepsBack() / 2), wanted_};
    const int ahead = std::clamp(options_.ahead, 0, capacity_ - 1);
    return {wanted_, std::min(info_.frame_count - 1, wanted_ + ahead)};
}

std::list<FrameCache::Waiter*>::const_iterator FrameCache::nextWaiter() const {
    return std::find_if(waiters_.begin(), waiters_.end(), [](const Waiter* waiter) { return !waiter->done; });
}

void FrameCache::planRun(FrameIndex first, FrameIndex last) {
    run_next_ = std::max(0, first);
    run_end_ = last + 1;
}

/// The frame to read now, or -1 when there is nothing to do. Those who wait come first, then the last request, then
/// what is likely to be asked for next.
FrameIndex FrameCache::chooseNext() {
    const auto waiting = nextWaiter();
    const FrameIndex target = waiting != waiters_.end() ? (*waiting)->index : wanted_;
    if (target < 0) return -1;
    const Window keep = window();
    const bool urgent = waiting != waiters_.end() || !isKnown(target);
    if (urgent && (target < run_next_ || target >= run_end_))
        planRun(direction_ < 0 && target == wanted_ ? target - stepsBack() : target, target);
    while (run_next_ < run_end_ && (isKnown(run_next_) || !keep.holds(run_next_)) && !(urgent && run_next_ == target))
        ++run_next_;
    if (run_next_ < run_end_) return run_next_++;

    if (direction_ > 0) {
        for (FrameIndex next = wanted_ + 1; next <= keep.last; ++next)
            if (!isKnown(next)) return next;
        return -1;
    }
    for (FrameIndex before = wanted_ - 1; before >= std::max(0, wanted_ - stepsBack() / 2); --before) {
        if (isKnown(before)) continue;
        planRun(std::max(keep.first, before - stepsBack()), before);
        while (isKnown(run_next_)) ++run_next_;
        return run_next_++;
    }
    return -1;
}

void FrameCache::work(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
        FrameIndex index = -1;
        wake_.wait(lock, stop, [&] {
            index = chooseNext();
            becomeIdle(index < 0);
            return index >= 0;
        });
        if (stop.stop_requested()) break;
        reading_ahead_ = nextWaiter() == waiters_.end() && isKnown(wanted_) ? index : -1;
        given_up_ = false;
        lock.unlock();
        std::shared_ptr<const Frame> frame;
        std::string error;
        try {
            frame = std::make_shared<const Frame>(source_->read(index, options_.with_colour));
        } catch (const ReadingGivenUp&) {
            lock.lock();
            continue;
        } catch (const std::exception& failure) {
            error = failure.what();
        }
        lock.lock();
        const bool announce = store(index, std::move(frame), error);
        if (announce && arrived_ && !stop.stop_requested()) {
            lock.unlock();
            arrived_(index);
            lock.lock();
        }
    }
    for (Waiter* waiter : waiters_) {
        waiter->error = waiter->done ? waiter->error : "the video was closed";
        waiter->done = true;
    }
    arrival_.notify_all();
}

/// Keeps a frame or its error; true when its arrival is to be told.
bool FrameCache::store(FrameIndex index, std::shared_ptr<const Frame> frame, const std::string& error) {
    for (Waiter* waiter : waiters_) {
        if (waiter->index != index || waiter->done) continue;
        waiter->frame = frame;
        waiter->error = error;
        waiter->done = true;
    }
    arrival_.notify_all();
    if (frame)
        keep(index, std::move(frame));
    else
        errors_[index] = error;
    const bool announce = index == wanted_ && !announced_;
    announced_ = announced_ || announce;
    return announce;
}

void FrameCache::becomeIdle(bool idle) {
    if (std::exchange(idle_, idle) || !idle) return;
    reading_ahead_ = -1;
    idle_wake_.notify_all();
}

void FrameCache::keep(FrameIndex index, std::shared_ptr<const Frame> frame) {
    if (frames_.contains(index)) return;
    bytes_ += bytesOf(*frame);
    frames_.emplace(index, std::move(frame));
    makeRoom();
}

void FrameCache::makeRoom() {
    const Window near = window();
    const auto end = expected_.begin() + static_cast<std::ptrdiff_t>(expectedThatFit());
    while (bytes_ > max_bytes_ && frames_.size() > 1) {
        const auto rank = [&](FrameIndex index) {
            const bool is_expected = std::find(expected_.begin(), end, index) != end;
            return std::pair(near.holds(index) ? 0 : is_expected ? 1 : 2, std::abs(index - wanted_));
        };
        const auto last = std::max_element(frames_.begin(), frames_.end(),
                                           [&](const auto& a, const auto& b) { return rank(a.first) < rank(b.first); });
        bytes_ -= bytesOf(*last->second);
        frames_.erase(last);
    }
}

}  // namespace eyrie
