#include "io/frame_source.h"

#include "core/error.h"
#include "io/image_sequence.h"
#include "io/video_reader.h"

namespace eyrie {

std::unique_ptr<FrameSource> openSource(const std::filesystem::path& path, const SourceOptions& options,
                                        const IndexProgress& progress, std::stop_token stop) {
    std::error_code failure;
    const auto status = std::filesystem::status(path, failure);
    if (!std::filesystem::exists(status))
        throw Error(ErrorKind::input,
                    path.string() + ": there is no such file or folder" +
                        (failure && failure != std::errc::no_such_file_or_directory ? " (" + failure.message() + ")"
                                                                                    : "; check the name"));
    if (std::filesystem::is_directory(status) || ImageSequence::isImageFile(path))
        return std::make_unique<ImageSequence>(path, options);
    if (!std::filesystem::is_regular_file(status))
        throw Error(ErrorKind::input, path.string() + ": is neither a file nor a folder");
    if (std::filesystem::file_size(path, failure) == 0 && !failure)
        throw Error(ErrorKind::input, path.string() + ": the file is empty; record or copy it again");
    return std::make_unique<VideoReader>(path, options, progress, std::move(stop));
}

}  // namespace eyrie
