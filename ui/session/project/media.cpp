#include "session/project/media.h"

#include <algorithm>

#include "io/folder.h"
#include "io/video/image_sequence.h"
#include "io/video/parts/part_list.h"
#include "io/video/parts/part_source.h"
#include "session/project/project_location.h"
#include "session/project/scene_frame_cache.h"

namespace eyrie::ui {

namespace fs = std::filesystem;

namespace {

SourceOptions sourceOptionsOf(FrameRate rate) {
    SourceOptions options;
    options.frame_rate_hz = rate.given_hz;
    options.remembered_rate_hz = rate.remembered_hz;
    return options;
}

}  // namespace

Media videoMedia(const fs::path& path, FrameRate rate) {
    std::error_code no_such_path;
    fs::path absolute = fs::weakly_canonical(path, no_such_path);
    if (no_such_path) absolute = fs::absolute(path);
    if (!absolute.has_filename()) absolute = absolute.parent_path();
    Media media;
    media.name = (hasPartListName(absolute) ? absolute.stem() : absolute.filename()).string();
    media.identity = absolute.string();
    media.gsd_m_per_px = [] { return 0.0; };
    media.given_rate_hz = rate.given_hz;
    media.open = [absolute, rate](const IndexProgress& progress, std::stop_token stop) {
        return openSource(absolute, sourceOptionsOf(rate), progress, std::move(stop));
    };
    return media;
}

Media partsMedia(std::vector<fs::path> files, FrameRate rate) {
    if (files.size() == 1) return videoMedia(files.front(), rate);
    std::stable_sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
        return naturalOrder(a.filename().string(), b.filename().string());
    });
    Media media = videoMedia(fs::absolute(files.front()).parent_path() / partListName(files), rate);
    fs::path elsewhere = projectInDataFolder(media.name, media.identity);
    elsewhere.replace_extension(kPartListEnding);
    const std::vector<fs::path> places{media.identity, elsewhere};
    media.open = [files, places, rate](const IndexProgress& progress, const std::stop_token& stop) {
        std::error_code failed;  // told when nothing can be written
        fs::create_directories(places.back().parent_path(), failed);
        return openTogether(files, places, sourceOptionsOf(rate), progress, stop);
    };
    media.becomes_list = true;
    return media;
}

Media locatedMedia(const fs::path& missing, std::vector<fs::path> chosen, FrameRate rate) {
    const bool is_list = chosen.size() == 1 && hasPartListName(chosen.front());
    if (!hasPartListName(missing) || is_list) return partsMedia(std::move(chosen), rate);
    Media media = videoMedia(missing, rate);
    Media anew = partsMedia(chosen, rate);
    media.open = [missing, chosen = std::move(chosen), anew = std::move(anew), rate](const IndexProgress& progress,
                                                                                     const std::stop_token& stop) {
        if (!isFile(missing)) return anew.open(progress, stop);
        return openRelocated(missing, chosen, sourceOptionsOf(rate), progress, stop);
    };
    media.becomes_list = true;
    return media;
}

Media sceneMedia(const std::string& scene) {
    Media media;
    media.name = scene + " scene";
    media.identity = sceneName(scene);
    const auto kept = std::make_shared<SceneFrameCache>(scene, sceneFolder());
    media.gsd_m_per_px = [kept] { return kept->facts().gsd_m_per_px; };
    media.open = [kept](const IndexProgress&, std::stop_token) { return kept->open(); };
    return media;
}

Media mediaOfIdentity(const std::string& identity, FrameRate rate) {
    if (isScene(identity)) return sceneMedia(sceneOf(identity));
    return videoMedia(identity, rate);
}

std::function<cv::Mat(FrameIndex)> grayReader(FrameSource& source) {
    return [&source](FrameIndex frame) {
        try {
            return source.read(frame, false).gray;
        } catch (const std::exception&) {
            return cv::Mat();
        }
    };
}

}  // namespace eyrie::ui
