#pragma once

#include <functional>
#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace eyrie {

/// What was computed last, by what it was computed from. Several threads may ask at once: the first one computes, the
/// others wait for it.
template <class Value, class Key = std::string>
class Memo {
 public:
    /// `capacity` ≥ 1: how many values are kept; the one that was asked for longest ago goes first.
    explicit Memo(std::size_t capacity) : capacity_(capacity) {}

    /// The value of that key; `make` gives it where it is not there. What `make` throws reaches everyone who waits, and
    /// nothing is kept.
    std::shared_ptr<const Value> get(const Key& key, const std::function<std::shared_ptr<const Value>()>& make) {
        std::promise<std::shared_ptr<const Value>> promise;
        {
            std::unique_lock lock(mutex_);
            for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
                if (!(entry->first == key)) continue;
                entries_.splice(entries_.begin(), entries_, entry);
                const Future known = entries_.front().second;
                lock.unlock();
                return known.get();
            }
            entries_.emplace_front(key, promise.get_future().share());
            if (entries_.size() > capacity_) entries_.pop_back();
        }
        try {
            std::shared_ptr<const Value> value = make();
            promise.set_value(value);
            return value;
        } catch (...) {
            {
                const std::scoped_lock lock(mutex_);
                entries_.remove_if([&](const auto& entry) { return entry.first == key; });
            }
            promise.set_exception(std::current_exception());
            throw;
        }
    }

 private:
    using Future = std::shared_future<std::shared_ptr<const Value>>;
    std::size_t capacity_;
    std::mutex mutex_;
    std::list<std::pair<Key, Future>> entries_;  ///< newest first
};

}  // namespace eyrie
