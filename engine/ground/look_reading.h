#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "ground/track_looks.h"

namespace eyrie {

/// Answers a frame with its colours. Throws for one that cannot be read.
using ReadPicture = std::function<Frame(FrameIndex)>;

/// What the pictures of tracks told.
struct LooksRead {
    LooksByTrack looks;
    std::size_t pictures = 0;  ///< that were wanted
    std::size_t unread = 0;    ///< that could not be read
    std::string why;           ///< of the last of these

    /// For people: "3 of 40 pictures could not be read: …"; empty where all could.
    std::string missing() const;
};

/// Looks at tracks picture by picture; may be stopped and goes on where it was, so that no picture is read twice. For
/// one thread at a time.
class LookReading {
 public:
    /// As readLooks(), with what earlier calls saw. `tracks`: the same in every call.
    LooksRead goOn(const std::vector<EventTrack>& tracks, const std::function<ReadPicture()>& open,
                   const std::function<void(double share)>& tell, const std::stop_token& stop);

 private:
    std::optional<LookTaker> taker_;  ///< made by the first call
    std::vector<FrameIndex> frames_;  ///< to look at, ascending
    std::size_t next_ = 0;            ///< the first of these that was not looked at
    std::size_t unread_ = 0;
    std::string why_;
};

/// Looks at tracks in as few pictures as LookTaker wants. Pictures that cannot be read are counted; all are, where
/// `open` throws, which answers what reads them. `tell` gets the share done, 0 … 1, after each. When it is stopped,
/// what was seen so far is answered.
LooksRead readLooks(const std::vector<EventTrack>& tracks, const std::function<ReadPicture()>& open,
                    const std::function<void(double share)>& tell, const std::stop_token& stop);

}  // namespace eyrie
