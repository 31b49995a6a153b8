#pragma once

#include <QObject>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/values/frame_result.h"
#include "session/background/background_query.h"
#include "session/frames/result_loader.h"

namespace eyrie::ui {

/// How long the motion vectors of a run lived, and how long they belonged to a track (fig. 6.4).
struct VectorLifetimes {
    int vectors = 0;
    double mean_life = 0;          ///< frames
    double mean_association = 0;   ///< frames
    std::vector<int> life;         ///< motion vectors per bin, see lifeBin()
    std::vector<int> association;  ///< the same bins; those that were never associated are in none
};

/// The thesis' bins: up to 10 frames, 11 to 50, 51 to 100, and so on by 50.
int lifeBin(int frames);
/// "≤ 10", "11–50" …
QString lifeBinText(int bin);

/// Counts the lives of motion vectors, frame after frame. A vector is associated in a frame in which it lies inside the
/// box of a confirmed or coasting track.
class VectorLifeCounter {
 public:
    void add(const FrameResult& result);
    /// To be called after the last frame.
    void finish();
    VectorLifetimes lives() const;
    /// Of these motion vectors only: the whole lives of those of a frame.
    VectorLifetimes livesOf(const std::vector<MotionVector>& vectors) const;
    /// Speed of every motion vector of every frame, px/frame; ascending once finished.
    const std::vector<float>& speeds() const { return speeds_; }

 private:
    struct Life {
        int frames = 0;
        int associated = 0;
    };
    static VectorLifetimes sumOf(const std::vector<Life>& all);
    std::map<CornerId, Life> lives_;
    std::vector<float> speeds_;
};

/// Reads lives and speeds of a stored run in the background. The newest request wins. Signals arrive on the thread of
/// this object.
class VectorLifetimesReader : public QObject {
    Q_OBJECT

 public:
    explicit VectorLifetimesReader(QObject* parent = nullptr) : QObject(parent) {}

    void read(const RunReference& run);

 signals:
    void readDone(int run_id, const std::shared_ptr<const VectorLifeCounter>& lives);
    void failed(const QString& message);

 private:
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
