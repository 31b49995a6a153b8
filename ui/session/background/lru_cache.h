#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <utility>

namespace eyrie::ui {

/// Keeps the values used last within a budget of bytes. For one thread.
template <class Key, class Value>
class LruCache {
 public:
    explicit LruCache(std::size_t budget_bytes) : budget_(budget_bytes) {}

    /// The value, now the most recently used; null when absent. Valid until the next put().
    const Value* find(const Key& key) {
        const auto place = places_.find(key);
        if (place == places_.end()) return nullptr;
        entries_.splice(entries_.begin(), entries_, place->second);
        return &place->second->value;
    }
    bool contains(const Key& key) const { return places_.count(key) > 0; }
    /// Adds a value; the least recently used ones go until the budget holds, never the one just added.
    void put(const Key& key, Value value, std::size_t bytes) {
        erase(key);
        entries_.push_front({key, std::move(value), bytes});
        places_[key] = entries_.begin();
        used_ += bytes;
        while (used_ > budget_ && entries_.size() > 1) erase(entries_.back().key);
    }
    void clear() {
        entries_.clear();
        places_.clear();
        used_ = 0;
    }
    std::size_t bytes() const { return used_; }
    std::size_t count() const { return entries_.size(); }

 private:
    struct Entry {
        Key key;
        Value value;
        std::size_t bytes;
    };
    void erase(Key key) {
        const auto place = places_.find(key);
        if (place == places_.end()) return;
        used_ -= place->second->bytes;
        entries_.erase(place->second);
        places_.erase(place);
    }

    std::size_t budget_;
    std::size_t used_ = 0;
    std::list<Entry> entries_;
    std::map<Key, typename std::list<Entry>::iterator> places_;
};

}  // namespace eyrie::ui
