#include "io/video/parts/part_source.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/values/last_frame.h"
#include "io/atomic_file.h"
#include "io/file_digest.h"
#include "io/file_kind.h"
#include "io/tables/number_text.h"
#include "io/tables/size_text.h"
#include "io/video/image_sequence.h"
#include "io/video/index_cache.h"
#include "io/video/video_reader.h"

namespace eyrie {
namespace {

namespace fs = std::filesystem;

/// Going on over a seam, and back, opens nothing twice.
constexpr std::size_t kMostOpen = 2;

/// Share by which the rates of parts may differ, and of those whose rate varies: each is the mean of its own frames.
constexpr double kLikeRate = 0.01;
constexpr double kLikeVariableRate = 0.1;
constexpr double kStampStep_s = 0.001;  ///< to which containers round

fs::path absoluteOf(const fs::path& path) {
    return fs::absolute(path).lexically_normal();
}

std::string rateText(double rate_hz) {
    return fixedText(rate_hz, 2) + " frames/s";
}

}  // namespace

PartSource::PartSource(fs::path list, std::vector<ListedPart> parts, const SourceOptions& options,
                       const IndexProgress& progress, const std::stop_token& stop)
    : listed_(std::move(parts)) {
    info_.path = absoluteOf(list);
    options_.index_folder = options.index_folder;
    const bool remembered = options.frame_rate_hz <= 0 && options.remembered_rate_hz > 0;
    survey(options.frame_rate_hz, remembered, progress, stop);
    if (remembered && (rates_differ_ || overridingRate(options, info_.frame_rate_hz) > 0))
        survey(options.remembered_rate_hz, false, {}, stop);
}

PartSource::~PartSource() = default;

void PartSource::survey(double frame_rate_hz, bool rate_is_known, const IndexProgress& progress,
                        const std::stop_token& stop) {
    info_ = VideoInfo{.path = info_.path, .size = {}, .codec = {}, .container = {}};
    times_us_.clear();
    open_.clear();
    rated_s_ = 0;
    rated_frames_ = 0;
    pictures_ = 0;
    rates_differ_ = false;
    options_.frame_rate_hz = frame_rate_hz;
    // Before hours of files are read through.
    for (std::size_t number = 0; number < listed_.size(); ++number) {
        checkPart(info_.path, listed_, number);
        listed_[number].bytes = fs::file_size(listed_[number].file);
    }
    const double all_bytes =
        std::accumulate(listed_.begin(), listed_.end(), 1.0,
                        [](double sum, const ListedPart& part) { return sum + static_cast<double>(part.bytes); });
    double bytes_done = 0;
    for (std::size_t number = 0; number < listed_.size(); ++number) {
        if (stop.stop_requested()) throw Error(ErrorKind::input, info_.path.string() + ": stopped while indexing");
        const auto bytes = static_cast<double>(listed_[number].bytes);
        const auto share = [&](double of_part) {
            if (progress) progress((bytes_done + of_part * bytes) / all_bytes);
        };
        const VideoReader reader(listed_[number].file, options_, share, stop);
        checkLike(number, reader.info());
        if (const std::string other = whyOtherRate(reader.info()); !other.empty()) {
            rates_differ_ = true;
            if (!rate_is_known) refuse(number, other, ", or say which rate holds for all (--fps)");
        }
        add(number, reader);
        bytes_done += bytes;
        share(0);
    }
    if (frame_rate_hz > 0)
        info_.frame_rate_hz = frame_rate_hz;
    else if (rated_frames_ > 0)
        info_.frame_rate_hz = rated_frames_ / rated_s_;
}

void PartSource::add(std::size_t number, const VideoReader& reader) {
    const VideoInfo& found = reader.info();
    ListedPart& listed = listed_[number];
    if (number == 0) {
        info_.size = found.size;
        info_.frame_rate_hz = found.frame_rate_hz;
        info_.codec = found.codec;
        info_.container = found.container;
    }
    if (listed.frames > 0 && listed.frames != found.frame_count)
        throw Error(ErrorKind::input, info_.path.string() + ": part " + std::to_string(number + 1) + " of " +
                                          std::to_string(listed_.size()) + ", " + listed.file.string() + ", has " +
                                          std::to_string(found.frame_count) + " frames, not the " +
                                          std::to_string(listed.frames) +
                                          " that the list says; put the old file back, or open the files anew");
    listed.frames = found.frame_count;
    if (listed.digest.empty()) listed.digest = edgeDigestOf(listed.file);
    if (found.frame_count > 1) {
        rated_frames_ += found.frame_count;
        rated_s_ += found.frame_count / found.frame_rate_hz;
    }
    info_.variable_frame_rate = info_.variable_frame_rate || found.variable_frame_rate;

    VideoPart part;
    part.file = listed.file;
    part.start_utc_us = listed.start_utc_us;
    part.created_utc_us = found.created_utc_us;
    part.first_frame = info_.frame_count;
    part.frame_count = found.frame_count;
    const double rate = found.frame_count > 1 ? found.frame_rate_hz : info_.frame_rate_hz;
    if (!times_us_.empty()) part.first_time_us = times_us_.back() + std::llround(1e6 / rate);
    part.first_picture = pictures_;
    for (FrameIndex frame = 0; frame < found.frame_count; ++frame)
        times_us_.push_back(part.first_time_us + reader.timeOf(frame));
    info_.frame_count += found.frame_count;

    const std::vector<PictureStamp> stamps = reader.pictureStamps();
    pictures_ += static_cast<int>(stamps.size());
    const auto first = std::find_if(stamps.begin(), stamps.end(), [](const PictureStamp& picture) {
        return picture.time_us == 0 && picture.stamp_us != kNoStamp;
    });
    if (first != stamps.end() && __builtin_sub_overflow(part.first_time_us, first->stamp_us, &part.stamp_shift_us))
        part.stamp_shift_us = 0;
    info_.parts.push_back(part);
}

void PartSource::refuse(std::size_t number, const std::string& what, const std::string& remedy) const {
    throw Error(ErrorKind::input, info_.path.string() + ": part " + std::to_string(number + 1) + " of " +
                                      std::to_string(listed_.size()) + ", " + listed_[number].file.string() + ", " +
                                      what + "; all parts of a video must be alike: leave it out, convert it" + remedy);
}

void PartSource::checkLike(std::size_t number, const VideoInfo& part) const {
    if (number > 0 && part.size != info_.size)
        refuse(number, "is " + sizeText(part.size) + " px, the parts before it " + sizeText(info_.size) + " px",
               ", or open it by itself");
    if (part.frame_count > kLastFrame - info_.frame_count)
        refuse(number, "makes the video longer than can be counted", ", or open it by itself");
}

std::string PartSource::whyOtherRate(const VideoInfo& part) const {
    if (rated_frames_ == 0 || part.frame_count < 2) return {};
    const double rate = rated_frames_ / rated_s_;
    const bool varies = part.variable_frame_rate || info_.variable_frame_rate;
    const double share = (varies ? kLikeVariableRate : kLikeRate) +
                         kStampStep_s * rate / (std::min(rated_frames_, part.frame_count) - 1);
    if (std::abs(part.frame_rate_hz - rate) <= share * rate) return {};
    return "has " + rateText(part.frame_rate_hz) + ", the parts before it " + rateText(rate);
}

void PartSource::checkIndex(FrameIndex index) const {
    if (index < 0 || index >= info_.frame_count)
        throw Error(ErrorKind::input, info_.path.string() + ": there is no frame " + std::to_string(index) +
                                          "; the video has frames 0 to " + std::to_string(info_.frame_count - 1));
}

VideoReader& PartSource::readerOf(std::size_t number) const {
    const auto known =
        std::find_if(open_.begin(), open_.end(), [&](const OpenPart& part) { return part.number == number; });
    if (known != open_.end()) {
        open_.splice(open_.begin(), open_, known);
        return *open_.front().reader;
    }
    const VideoPart& part = info_.parts[number];
    auto reader = std::make_unique<VideoReader>(part.file, options_, IndexProgress(), std::stop_token());
    if (reader->info().frame_count != part.frame_count || reader->info().size != info_.size)
        throw Error(ErrorKind::input, part.file.string() + ": the file has changed since it was opened; open it again");
    reader->giveUpWhen(given_up_);
    open_.push_front({number, std::move(reader)});
    if (open_.size() > kMostOpen) open_.pop_back();
    return *open_.front().reader;
}

Frame PartSource::read(FrameIndex index, bool with_colour) {
    checkIndex(index);
    const VideoPart& part = *info_.partOf(index);
    Frame frame;
    try {
        frame =
            readerOf(static_cast<std::size_t>(&part - info_.parts.data())).read(index - part.first_frame, with_colour);
    } catch (const Error& error) {
        throw Error(error.kind(), info_.path.string() + ": frame " + std::to_string(index) + ": " + error.what());
    }
    frame.index = index;
    frame.time_us = timeOf(index);
    return frame;
}

std::int64_t PartSource::timeOf(FrameIndex index) const {
    checkIndex(index);
    return times_us_[static_cast<std::size_t>(index)];
}

bool PartSource::hasGrown() const noexcept {
    return std::any_of(listed_.begin(), listed_.end(),
                       [](const ListedPart& part) { return stateOf(part.file).size > part.bytes; });
}

void PartSource::giveUpWhen(std::function<bool()> given_up) {
    given_up_ = std::move(given_up);
    for (const OpenPart& part : open_) part.reader->giveUpWhen(given_up_);
}

std::vector<PictureStamp> PartSource::pictureStamps() const {
    std::vector<PictureStamp> all;
    all.reserve(static_cast<std::size_t>(pictures_));
    for (std::size_t number = 0; number < info_.parts.size(); ++number) {
        const VideoPart& part = info_.parts[number];
        for (PictureStamp picture : readerOf(number).pictureStamps()) {
            picture.stamp_us = shiftedStamp(picture.stamp_us, part.stamp_shift_us);
            if (picture.time_us != kNoStamp) picture.time_us += part.first_time_us;
            all.push_back(picture);
        }
    }
    return all;
}

std::unique_ptr<FrameSource> openPartList(const fs::path& list, const SourceOptions& options,
                                          const IndexProgress& progress, const std::stop_token& stop) {
    return std::make_unique<PartSource>(list, readPartList(list), options, progress, stop);
}

void checkTogether(const std::vector<fs::path>& files) {
    for (auto file = files.begin(); file != files.end(); ++file) {
        const auto refuse = [&](const std::string& why) { throw Error(ErrorKind::input, file->string() + ": " + why); };
        std::error_code unknown;
        if (fs::is_directory(*file, unknown)) refuse("is a folder; only video files can be several parts of one video");
        checkReadableFile(*file);
        if (hasPartListName(*file)) refuse("is a list of parts already; open it by itself");
        if (ImageSequence::isImageFile(*file))
            refuse("is a picture; put the pictures into one folder and open that, or name video files only");
        const FileKind kind = kindOfFile(*file);
        if (kind != FileKind::video && kind != FileKind::other)
            refuse(std::string("is ") + nameOf(kind) + ", not a video; only video files can be parts of one video");
        const auto before = std::find_if(files.begin(), file,
                                         [&](const fs::path& other) { return fs::equivalent(other, *file, unknown); });
        if (before != file) refuse("is given twice; every part is there once");
    }
}

std::unique_ptr<FrameSource> openTogether(const std::vector<fs::path>& files, const std::vector<fs::path>& places,
                                          const SourceOptions& options, const IndexProgress& progress,
                                          const std::stop_token& stop) {
    if (files.size() == 1) return openSource(files.front(), options, progress, stop);
    checkTogether(files);
    std::vector<ListedPart> parts(files.size());
    for (std::size_t i = 0; i < files.size(); ++i) parts[i].file = absoluteOf(files[i]);
    const fs::path name = places.empty() ? files.front().parent_path() / partListName(files) : places.front();
    auto source = std::make_unique<PartSource>(name, std::move(parts), options, progress, stop);
    for (std::size_t place = 0; place < places.size(); ++place) {
        try {
            source->movedTo(keepPartList(places[place], source->listed()));
            break;
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::output || place + 1 == places.size()) throw;
        }
    }
    return source;
}

std::unique_ptr<FrameSource> openRelocated(const fs::path& list, const std::vector<fs::path>& chosen,
                                           const SourceOptions& options, const IndexProgress& progress,
                                           const std::stop_token& stop) {
    auto source =
        std::make_unique<PartSource>(list, relocatedParts(readPartList(list), chosen), options, progress, stop);
    writePartList(list, source->listed());
    return source;
}

}  // namespace eyrie
