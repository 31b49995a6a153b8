#include "ground/look_reading.h"

#include <exception>

namespace eyrie {

std::string LooksRead::missing() const {
    if (unread == 0) return {};
    return std::to_string(unread) + " of " + std::to_string(pictures) + " pictures could not be read: " + why;
}

LooksRead LookReading::goOn(const std::vector<EventTrack>& tracks, const std::function<ReadPicture()>& open,
                            const std::function<void(double share)>& tell, const std::stop_token& stop) {
    if (!taker_) {
        taker_.emplace(tracks);
        frames_ = taker_->frames();
    }
    try {
        // Nothing is opened for what was seen already.
        const ReadPicture picture = next_ < frames_.size() ? open() : ReadPicture();
        while (next_ < frames_.size() && !stop.stop_requested()) {
            const FrameIndex frame = frames_[next_++];
            try {
                taker_->look(picture(frame));
            } catch (const std::exception& error) {
                ++unread_;
                why_ = error.what();
            }
            tell(static_cast<double>(next_) / static_cast<double>(frames_.size()));
        }
    } catch (const std::exception& error) {
        why_ = error.what();
        if (!stop.stop_requested()) {  // what was stopped while it was opened may be opened the next time
            unread_ += frames_.size() - next_;
            next_ = frames_.size();
        }
    }
    LooksRead read;
    read.looks = taker_->looks();
    read.pictures = frames_.size();
    read.unread = unread_;
    read.why = why_;
    return read;
}

LooksRead readLooks(const std::vector<EventTrack>& tracks, const std::function<ReadPicture()>& open,
                    const std::function<void(double share)>& tell, const std::stop_token& stop) {
    return LookReading().goOn(tracks, open, tell, stop);
}

}  // namespace eyrie
