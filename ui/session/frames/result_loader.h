#pragma once

#include <QObject>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "canvas/view_frame.h"
#include "correction/corrected_tracks.h"
#include "imaging/picture_look.h"
#include "session/background/background_query.h"
#include "session/frames/opened_video.h"
#include "session/project/media.h"

namespace eyrie::ui {

/// Which stored run is shown.
struct RunReference {
    std::filesystem::path project;
    int run_id = 0;
    std::shared_ptr<const CorrectedTracks> corrected = {};  ///< what people made of its tracks; null: not shown
};

/// Fetches frames for review in the background: pictures from the video, results from the store (by its own
/// connection). Of several requests the newest wins; frames ahead are prepared while nothing else is to do. Signals
/// arrive on the thread of this object.
class ResultLoader : public QObject {
    Q_OBJECT

 public:
    explicit ResultLoader(QObject* parent = nullptr);
    ~ResultLoader() override;

    /// Opens a video, indexing it if need be, in place of the former one; opening another stops it. Answers with
    /// opened() or, the former video staying open, openFailed(), both carrying `ticket`.
    void openMedia(const Media& media, int ticket);
    void cancelOpening();
    void closeMedia();
    /// Results come from this run from now on; nothing: pictures only.
    void useRun(std::optional<RunReference> run, int trail_length);
    /// How pictures are shown, from the next request on.
    void setLook(const PictureLook& look);
    /// Frames whose pictures may well be asked for next, the likeliest first, in place of those before: they are read
    /// while nothing else is wanted, as far as there is room. `media` is the video that is open.
    void expect(const Media& media, std::vector<FrameIndex> frames);
    /// Answers with frameLoaded(), unless a newer request comes first. `direction` −1, 0 or 1 says what to read ahead.
    void request(FrameIndex frame, int direction);

 signals:
    void openingProgress(double share);
    void opened(int ticket, const OpenedVideo& video);
    void openFailed(int ticket, const QString& message);
    /// The frame has an image, a result, both or, when neither exists, nothing.
    void frameLoaded(const ViewFrame& frame);
    /// The picture or the result of a frame could not be read; frameLoaded() follows with what could.
    void frameFailed(FrameIndex frame, const QString& message);

 private:
    class Worker;
    std::unique_ptr<Worker> worker_;
    std::stop_source opening_;
    BackgroundQuery query_;  ///< last: stops before the worker goes
};

}  // namespace eyrie::ui
