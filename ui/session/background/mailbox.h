#pragma once

#include <mutex>
#include <optional>
#include <utility>

namespace eyrie::ui {

/// One slot between two threads. The newest letter wins; nobody ever waits for the other side.
template <class Letter>
class Mailbox {
 public:
    /// Leaves a letter, replacing one that was not fetched. True when the slot was empty: then, and only then, the
    /// reader needs to be told.
    bool put(Letter letter) {
        const std::scoped_lock lock(mutex_);
        const bool was_empty = !letter_.has_value();
        letter_ = std::move(letter);
        return was_empty;
    }
    /// Takes the letter out, if there is one.
    std::optional<Letter> take() {
        const std::scoped_lock lock(mutex_);
        return std::exchange(letter_, std::nullopt);
    }

 private:
    std::mutex mutex_;
    std::optional<Letter> letter_;
};

}  // namespace eyrie::ui
