#pragma once

#include <QObject>
#include <filesystem>
#include <memory>
#include <stop_token>
#include <vector>

#include "evaluation/measures/roc.h"
#include "learning/training/trainer.h"
#include "session/background/background_query.h"

namespace eyrie::ui {

/// What a classifier is to be trained with.
struct TrainingWish {
    std::vector<std::filesystem::path> projects;  ///< whose labels are used
    TrainingOptions options;
    int every = 10;              ///< frames from one that is used to the next
    std::filesystem::path file;  ///< the model to be written
    bool replace = false;        ///< even where it is now a model of another descriptor or classifier
};

/// How a training ended.
struct TrainingReport {
    std::filesystem::path file;
    QString samples;   ///< for people: what it was trained on
    QString held_out;  ///< … and tested on
    RocCurve own;
    RocCurve shipped;  ///< of the model that comes with the program, on the same samples
};

/// Trains a classifier from the labels of projects in the background. Whole sequences are held out for the test; of a
/// single sequence, its end. Signals arrive on the thread of this object.
class LabelTraining : public QObject {
    Q_OBJECT

 public:
    explicit LabelTraining(QObject* parent = nullptr) : QObject(parent) {}

    bool running() const { return running_; }
    /// Answers with finished(), failed() or stopped(). Nothing happens while one works.
    void start(const TrainingWish& wish);
    void cancel() { stop_.request_stop(); }

 signals:
    void progress(const QString& phase, double share);
    void finished(const std::shared_ptr<const TrainingReport>& report);
    void failed(const QString& message);
    /// The file is a model of another kind; begun only when start() is called again with `replace`.
    void replacementNeeded(const QString& message);
    void stopped();

 private:
    void work(const TrainingWish& wish, const BackgroundTask& task);

    bool running_ = false;
    std::stop_source stop_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
