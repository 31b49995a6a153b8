#include "review/mosaic/mosaic_maker.h"

#include <chrono>

#include "canvas/drawing/image_convert.h"
#include "ground/ground_mosaic.h"
#include "review/watch/watched_ground.h"

namespace eyrie::ui {

namespace {

constexpr MosaicOptions kMosaicBudget{.max_pixels = 8'000'000, .max_frames = 400, .colour = true};
constexpr auto kShownEvery = std::chrono::milliseconds(700);
constexpr double kLeastWay = 2;  ///< between points of a way, units of the sheet

}  // namespace

void MosaicMaker::clear() {
    query_.cancel();
    mosaic_.reset();
    emit changed();
}

void MosaicMaker::make(const std::shared_ptr<const RunGround>& ground, const Media& media) {
    mosaic_.reset();
    emit changed();
    const auto work = [this, ground, media](const BackgroundTask& task) {
        const Footage& footage = ground->run->footage;
        const auto sheets = std::make_shared<const GroundSheets>(footage, footage.first_frame);
        GroundMosaic painter(sheets, kMosaicBudget);
        std::vector<std::vector<SheetPath>> paths;
        for (int sheet = 0; sheet < sheets->count(); ++sheet)
            paths.push_back(pathsOn(*sheets, ground->run->tracks, sheet, kLeastWay));
        const auto show = [&](double share) {
            auto picture = std::make_shared<MosaicPicture>();
            picture->ground = ground;
            picture->sheets = sheets;
            picture->share = share;
            for (std::size_t i = 0; i < painter.sheets().size(); ++i) {
                const MosaicSheet& sheet = painter.sheets()[i];
                SheetPicture shown;
                shown.image = imageForDisplay(sheet.picture);
                shown.area = {sheet.area.x, sheet.area.y, sheet.area.width, sheet.area.height};
                shown.px_per_unit = sheet.px_per_unit;
                shown.paths = paths[i];
                picture->pictures.push_back(std::move(shown));
            }
            task.tell([this, picture] {
                mosaic_ = picture;
                emit changed();
            });
        };
        const auto source = media.open({}, task.stop());
        auto shown_at = std::chrono::steady_clock::now();
        const std::vector<FrameIndex>& frames = painter.frames();
        for (std::size_t i = 0; i < frames.size() && !task.stop().stop_requested(); ++i) {
            if (frames[i] < source->info().frame_count) painter.paint(source->read(frames[i], true));
            const auto now = std::chrono::steady_clock::now();
            if (i > 0 && now - shown_at < kShownEvery) continue;
            show(static_cast<double>(i + 1) / static_cast<double>(frames.size()));
            shown_at = std::chrono::steady_clock::now();
        }
        if (!task.stop().stop_requested()) show(1);
    };
    query_.ask(work, fail_);
}

}  // namespace eyrie::ui
