#include "io/video/frame_cache.h"

#include <algorithm>
#include <cstdlib>

#include "core/error.h"

namespace eyrie {

namespace {

std::size_t bytesOf(const Frame& frame) {
    return frame.gray.total() * frame.gray.elemSize() + frame.colour.total() * frame.colour.elemSize();
}

int framesThatFit(const VideoInfo& info, const FrameCacheOptions& options) {
    const auto pixels = static_cast<std::size_t>(std::max(1, info.size.area()));
    const std::size_t frames = options.max_bytes / (pixels * (options.with_colour ? 4U : 1U));
    return static_cast<int>(std::clamp<std::size_t>(frames, 1, 1U << 20U));
}

}  // namespace

FrameCache::FrameCache(std::unique_ptr<FrameSource> source, FrameCacheOptions options, Arrived arrived)
    : source_(std::move(source)),
      info_(source_->info()),
      options_(options),
      arrived_(std::move(arrived)),
      capacity_(framesThatFit(info_, options_)) {
    times_us_.reserve(static_cast<std::size_t>(info_.frame_count));
    for (FrameIndex index = 0; index < info_.frame_count; ++index) times_us_.push_back(source_->timeOf(index));
    thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

FrameCache::~FrameCache() {
    thread_.request_stop();
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
        wake_.notify_one();
        arrival_.wait(lock, [&] { return waiter.done; });
        waiters_.remove(&waiter);
    }
    if (!waiter.frame) throw Error(ErrorKind::input, waiter.error);
    return waiter.frame;
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

void FrameCache::planRun(FrameIndex first, FrameIndex last) {
    run_next_ = std::max(0, first);
    run_end_ = last + 1;
}

/// The frame to read now, or -1 when there is nothing to do. Those who wait come first, then the last request, then
/// what is likely to be asked for next.
FrameIndex FrameCache::chooseNext() {
    const auto waiting = std::find_if(waiters_.begin(), waiters_.end(), [](const Waiter* w) { return !w->done; });
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
        wake_.wait(lock, stop, [&] { return (index = chooseNext()) >= 0; });
        if (stop.stop_requested()) break;
        lock.unlock();
        std::shared_ptr<const Frame> frame;
        std::string error;
        try {
            frame = std::make_shared<const Frame>(source_->read(index, options_.with_colour));
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
    if (!frame) {
        errors_[index] = error;
    } else if (!frames_.contains(index)) {
        bytes_ += bytesOf(*frame);
        frames_.emplace(index, std::move(frame));
        makeRoom();
    }
    const bool announce = index == wanted_ && !announced_;
    announced_ = announced_ || announce;
    return announce;
}

void FrameCache::makeRoom() {
    const Window keep = window();
    while (bytes_ > options_.max_bytes && frames_.size() > 1) {
        const auto rank = [&](FrameIndex index) { return std::pair(!keep.holds(index), std::abs(index - wanted_)); };
        const auto last = std::max_element(frames_.begin(), frames_.end(),
                                           [&](const auto& a, const auto& b) { return rank(a.first) < rank(b.first); });
        bytes_ -= bytesOf(*last->second);
        frames_.erase(last);
    }
}

}  // namespace eyrie
