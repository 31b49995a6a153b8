#include "ground/look_reading.h"

#include <exception>

namespace eyrie {

std::string LooksRead::missing() const {
    if (unread == 0) return {};
    return std::to_string(unread) + " of " + std::to_string(pictures) + " pictures could not be read: " + why;
}

LooksRead readLooks(const std::vector<EventTrack>& tracks, const std::function<ReadPicture()>& open,
                    const std::function<void(double share)>& tell, const std::stop_token& stop) {
    LookTaker taker(tracks);
    const std::vector<FrameIndex> frames = taker.frames();
    LooksRead read;
    read.pictures = frames.size();
    try {
        const ReadPicture picture = open();
        for (std::size_t i = 0; i < frames.size() && !stop.stop_requested(); ++i) {
            try {
                taker.look(picture(frames[i]));
            } catch (const std::exception& error) {
                ++read.unread;
                read.why = error.what();
            }
            tell(static_cast<double>(i + 1) / static_cast<double>(frames.size()));
        }
    } catch (const std::exception& error) {
        read.unread = frames.size();
        read.why = error.what();
    }
    read.looks = taker.looks();
    return read;
}

}  // namespace eyrie
