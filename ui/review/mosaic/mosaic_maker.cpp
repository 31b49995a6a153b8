#include "review/mosaic/mosaic_maker.h"

#include <chrono>
#include <utility>

#include "canvas/drawing/image_convert.h"
#include "ground/ground_mosaic.h"
#include "review/watch/watched_ground.h"

namespace eyrie::ui {

namespace {

constexpr auto kShownEvery = std::chrono::milliseconds(700);

/// The mosaic of a run on its way.
class MosaicWork {
 public:
    explicit MosaicWork(const std::shared_ptr<const RunGround>& ground)
        : ground_(ground),
          sheets_(std::make_shared<const GroundSheets>(ground->run->footage, ground->run->footage.first_frame)),
          painter_(sheets_),
          coverage_(std::make_shared<const std::vector<SheetCoverage>>(groundCoverage(*sheets_, *ground->run))) {
        auto paths = pathsOn(*sheets_, ground->run->tracks);
        for (std::size_t i = 0; i < painter_.sheets().size(); ++i) {
            const MosaicSheet& sheet = painter_.sheets()[i];
            SheetPicture shown;
            shown.area = {sheet.area.x, sheet.area.y, sheet.area.width, sheet.area.height};
            shown.px_per_unit = sheet.px_per_unit;
            shown.paths = std::make_shared<const std::vector<SheetPath>>(std::move(paths[i]));
            pictures_.push_back(std::move(shown));
        }
        painted_.assign(pictures_.size(), true);
    }

    const std::vector<FrameIndex>& frames() const { return painter_.frames(); }
    void paint(const Frame& frame) {
        painter_.paint(frame);
        painted_[static_cast<std::size_t>(sheets_->sheetOf(frame.index))] = true;
    }
    /// What there is so far; only sheets that were painted since are copied.
    std::shared_ptr<const MosaicPicture> picture(double share, const std::stop_token& stop) {
        for (std::size_t i = 0; i < pictures_.size() && !stop.stop_requested(); ++i) {
            if (!painted_[i]) continue;
            pictures_[i].image = imageForDisplay(painter_.sheets()[i].picture);
            painted_[i] = false;
        }
        return std::make_shared<const MosaicPicture>(MosaicPicture{ground_, sheets_, pictures_, coverage_, share});
    }

 private:
    std::shared_ptr<const RunGround> ground_;
    std::shared_ptr<const GroundSheets> sheets_;
    GroundMosaic painter_;
    std::shared_ptr<const std::vector<SheetCoverage>> coverage_;
    std::vector<SheetPicture> pictures_;
    std::vector<bool> painted_;  ///< since they were shown
};

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
        MosaicWork mosaic(ground);
        const std::stop_token& stop = task.stop();
        if (stop.stop_requested()) return;
        const auto show = [&](double share) {
            task.tell([this, picture = mosaic.picture(share, stop)] {
                mosaic_ = picture;
                emit changed();
            });
        };
        const auto source = media.open({}, stop);
        auto shown_at = std::chrono::steady_clock::now();
        const std::vector<FrameIndex>& frames = mosaic.frames();
        for (std::size_t i = 0; i < frames.size(); ++i) {
            if (stop.stop_requested()) return;
            if (frames[i] < source->info().frame_count) mosaic.paint(source->read(frames[i], true));
            if (i > 0 && std::chrono::steady_clock::now() - shown_at < kShownEvery) continue;
            show(static_cast<double>(i + 1) / static_cast<double>(frames.size()));
            shown_at = std::chrono::steady_clock::now();
        }
        if (!stop.stop_requested()) show(1);
    };
    query_.ask(work, fail_);
}

}  // namespace eyrie::ui

#include "moc_mosaic_maker.cpp"
