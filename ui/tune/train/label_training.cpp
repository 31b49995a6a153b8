#include "tune/train/label_training.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <set>
#include <utility>

#include "core/error.h"
#include "detection/sliding_window/model_location.h"
#include "exchange/project_labels.h"
#include "io/output_files.h"
#include "learning/training/background_mining.h"
#include "learning/training/labelled_frames.h"
#include "session/project/media.h"
#include "store/labels/annotation_store.h"

namespace eyrie::ui {

namespace {

constexpr double kHeldOut = 0.25;        ///< share of the vehicles that whole held-out sequences have at least
constexpr double kHeldOutEnd = 1 / 3.0;  ///< of a single sequence
constexpr auto kTrainingProgressInterval = std::chrono::milliseconds(80);

using Say = std::function<void(const QString&, double)>;

/// The labelled frames of one video.
struct LabelledSequence {
    std::string name;
    std::vector<LabelledImage> images;  ///< ascending frames
    int vehicles = 0;
};

LabelledSequence readSequence(const SequenceRecord& record, const LabelBoxes& boxes, int every, const Say& say,
                              const std::stop_token& stop) {
    LabelledSequence sequence;
    const Media media = mediaOfIdentity(record.path, {.remembered_hz = record.rememberedRate()});
    sequence.name = media.name;
    const auto source = media.open({}, stop);
    TrainingBoxes training;
    for (const auto& [frame, labels] : boxes)
        for (const LabelBox& label : labels)
            training[frame].push_back(trainingBoxOf(label, label.occlusion != Occlusion::none));
    sequence.images = labelledImagesOf(
        training, sequence.name, source->info().frame_count, every,
        [&](FrameIndex frame) { return source->read(frame, false).gray; }, stop,
        [&](double share) { say(QObject::tr("Reading %1").arg(QString::fromStdString(sequence.name)), share); });
    for (const LabelledImage& image : sequence.images) sequence.vehicles += static_cast<int>(image.vehicles.size());
    return sequence;
}

std::vector<LabelledSequence> readProjects(const TrainingWish& wish, const Say& say, const std::stop_token& stop) {
    std::vector<LabelledSequence> all;
    for (const auto& path : wish.projects) {
        ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
        const RunStore runs(project);
        for (const SequenceRecord& record : sequencesOf(project)) {
            if (stop.stop_requested()) return all;
            const LabelFile file =
                labelsOf(readAnnotations(project, record.id), record, cameraMotionOf(runs, record.id));
            if (file.boxes.empty()) continue;
            LabelledSequence sequence = readSequence(record, file.boxes, wish.every, say, stop);
            if (sequence.vehicles > 0) all.push_back(std::move(sequence));
        }
    }
    return all;
}

RocCurve rocOf(const VehicleModel& model, const SampleSet& samples) {
    std::vector<cv::Mat> windows;
    for (const Sample& sample : samples) windows.push_back(sample.window);
    const std::vector<double> decisions = model.decideAll(windows);
    std::vector<ScoredSample> scored;
    for (std::size_t i = 0; i < samples.size(); ++i) scored.push_back({decisions[i], samples[i].vehicle});
    return rocCurve(std::move(scored));
}

QString countsOf(const SampleSet& samples) {
    return QObject::tr("%1 vehicles, %2 others").arg(countOf(samples, true)).arg(countOf(samples, false));
}

/// Which model of another kind the wish would overwrite, for people; empty when none. Throws Error(output) where
/// something else than a model would be overwritten.
QString whatIsReplaced(const TrainingWish& wish) {
    if (filesToReplace({{wish.file, FileKind::model}}, wish.projects).empty()) return {};
    try {
        const VehicleModel old = loadModel(wish.file);
        const DescriptorKind descriptor = old.descriptor->kind();
        const ClassifierKind classifier = old.classifier->kind();
        if (descriptor == wish.options.descriptor && classifier == wish.options.classifier) return {};
        return QObject::tr(
                   "%1 is a model with %2 and %3 and would be replaced by one with %4 and %5. Name another file, or "
                   "press Train again to replace it.")
            .arg(QString::fromStdString(wish.file.string()), QString::fromUtf8(titleOf(descriptor)),
                 QString::fromUtf8(titleOf(classifier)), QString::fromUtf8(titleOf(wish.options.descriptor)),
                 QString::fromUtf8(titleOf(wish.options.classifier)));
    } catch (const Error&) {
        return QObject::tr(
                   "%1 is a model that cannot be read and would be replaced. Name another file, or press Train "
                   "again to replace it.")
            .arg(QString::fromStdString(wish.file.string()));
    }
}

/// Divides sequences, or the only one, into what is trained on and what is tested on.
QString holdOut(std::vector<LabelledSequence> all, std::vector<LabelledImage>& train,
                std::vector<LabelledImage>& test) {
    const auto move = [](std::vector<LabelledImage>& from, std::vector<LabelledImage>& to) {
        std::move(from.begin(), from.end(), std::back_inserter(to));
    };
    if (all.size() == 1) {
        auto& images = all.front().images;
        const auto kept = static_cast<std::ptrdiff_t>(static_cast<double>(images.size()) * (1 - kHeldOutEnd));
        train.assign(std::make_move_iterator(images.begin()), std::make_move_iterator(images.begin() + kept));
        test.assign(std::make_move_iterator(images.begin() + kept), std::make_move_iterator(images.end()));
        return QObject::tr("the last third of %1, which shows the same vehicles: label a second sequence to be sure")
            .arg(QString::fromStdString(all.front().name));
    }
    int total = 0;
    for (const LabelledSequence& sequence : all) total += sequence.vehicles;
    int held = 0;
    QStringList names;
    for (auto sequence = all.rbegin(); sequence != all.rend(); ++sequence) {
        const bool last = sequence == std::prev(all.rend());
        if (last || held >= kHeldOut * total) {
            move(sequence->images, train);
            continue;
        }
        held += sequence->vehicles;
        names << QString::fromStdString(sequence->name);
        move(sequence->images, test);
    }
    return names.join(QStringLiteral(", "));
}

}  // namespace

void LabelTraining::start(const TrainingWish& wish) {
    if (running_) return;
    running_ = true;
    stop_ = query_.post([this, wish](const BackgroundTask& task) { work(wish, task); },
                        [this](const QString& message) {
                            running_ = false;
                            emit failed(message);
                        });
}

void LabelTraining::work(const TrainingWish& wish, const BackgroundTask& task) {
    const std::stop_token& stop = task.stop();
    const auto end = [&](auto say) {
        task.tell([this, say] {
            running_ = false;
            say();
        });
    };
    auto told = std::chrono::steady_clock::time_point{};
    const Say say = [&](const QString& phase, double share) {
        const auto now = std::chrono::steady_clock::now();
        if (now - told < kTrainingProgressInterval) return;
        told = now;
        task.tell([this, phase, share] { emit progress(phase, share); });
    };
    const QString replaced = whatIsReplaced(wish);
    if (!replaced.isEmpty() && !wish.replace) return end([this, replaced] { emit replacementNeeded(replaced); });
    auto sequences = readProjects(wish, say, stop);
    if (stop.stop_requested()) return end([this] { emit stopped(); });
    if (sequences.empty())
        throw Error(
            ErrorKind::input,
            "these projects have no labelled vehicles; label some in the workspace Label, or import ground truth");
    std::vector<LabelledImage> train;
    std::vector<LabelledImage> test;
    auto report = std::make_shared<TrainingReport>();
    report->held_out = holdOut(std::move(sequences), train, test);
    const auto seed = static_cast<std::uint64_t>(wish.options.seed);
    const SampleSet samples = samplesFromImages(train, seed, wish.options.cutting());
    SampleCutting cutting = wish.options.cutting();
    const auto heldOut = [&] { return samplesFromImages(test, seed + 100'000, cutting); };
    const SampleSet held_out = heldOut();
    report->samples = countsOf(samples);
    report->held_out += QStringLiteral(" – ") + countsOf(held_out);
    TrainingRecord record;
    record.data = describeSources(samples);
    TrainingWatch watch;
    watch.stop = stop;
    watch.progress = [&](const TrainingProgress& step) { say(QString::fromStdString(step.phase), step.share); };
    std::uint64_t round = 0;
    const auto more = [&](const VehicleModel& model, int wanted) {
        return mineBackground(model, train, typicalVehicle(), wanted, seed + 1000 * ++round, watch);
    };
    const auto model = trainModel(samples, wish.options, record, watch, more);
    if (!model || stop.stop_requested()) return end([this] { emit stopped(); });
    saveModel(*model, wish.file);
    report->file = wish.file;
    report->own = rocOf(*model, held_out);
    // The same places, cut as the other model was trained.
    const VehicleModel shipped = loadModel(modelLocation({}));
    cutting.fit = shipped.fit;
    report->shipped = rocOf(shipped, heldOut());
    end([this, report] { emit finished(report); });
}

}  // namespace eyrie::ui

#include "moc_label_training.cpp"
