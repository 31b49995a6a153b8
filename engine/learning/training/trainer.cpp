#include "learning/training/trainer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "learning/classifiers/seeded_random.h"
#include "learning/models/window.h"

namespace eyrie {
namespace {

/// The window with its contrast around its mean multiplied.
cv::Mat withContrast(const cv::Mat& window, double factor) {
    const double mean = cv::mean(window)[0];
    cv::Mat result;
    window.convertTo(result, CV_8U, factor, mean * (1 - factor));
    return result;
}

/// A window in which the vehicle no longer fits: moved by 7 … 13 px along or 4 … 8 px across or by less in both, or
/// stretched along by 1.4 … 1.6. What comes in from outside repeats the window's border.
cv::Mat misfit(const cv::Mat& window, SeededRandom& random) {
    const auto side = [&] { return random.below(2) == 0 ? -1 : 1; };
    int across = 0;
    int along = 0;
    switch (random.below(5)) {
        case 0: {
            const int rows = 20 + random.below(4);
            cv::Mat stretched;
            cv::resize(window.rowRange((kWindowHeight - rows) / 2, (kWindowHeight + rows) / 2), stretched,
                       window.size(), 0, 0, cv::INTER_LINEAR);
            return stretched;
        }
        case 1:
            across = side() * (4 + random.below(5));
            along = random.below(7) - 3;
            break;
        case 2:
            across = side() * (3 + random.below(4));
            along = side() * (5 + random.below(7));
            break;
        default:
            across = random.below(3) - 1;
            along = side() * (7 + random.below(7));
            break;
    }
    cv::Mat padded;
    const int dx = std::abs(across);
    const int dy = std::abs(along);
    cv::copyMakeBorder(window, padded, dy, dy, dx, dx, cv::BORDER_REPLICATE);
    return padded(cv::Rect(cv::Point(dx + across, dy + along), window.size())).clone();
}

class Trainer {
 public:
    Trainer(const SampleSet& samples, const TrainingOptions& options, const TrainingWatch& watch)
        : options_(options), watch_(watch), random_(static_cast<std::uint64_t>(options.seed)) {
        descriptor_ = makeDescriptor(options.descriptor, static_cast<std::uint64_t>(options.seed));
        std::vector<cv::Mat> misfits;
        for (const Sample& sample : samples) {
            if (sample.duplicate && !options.duplicates) continue;
            if (sample.vehicle) {
                ++vehicles_;
                addVehicle(sample.window);
                for (int copy = 0; copy < options.misfit_copies; ++copy) {
                    misfits.push_back(misfit(sample.window, random_));
                }
            } else {
                pool_.push_back(sample.window);
            }
        }
        if (vehicles_ < 2 || pool_.size() < 2) {
            throw Error(ErrorKind::input, "training: " + std::to_string(vehicles_) + " vehicles and " +
                                              std::to_string(pool_.size()) +
                                              " other samples are too few; give more samples");
        }
        random_.shuffle(pool_);
        positives_ = static_cast<int>(windows_.size());
        windows_.insert(windows_.end(), misfits.begin(), misfits.end());
        takeFromPool(static_cast<std::size_t>(std::lround(options.others_per_vehicle * positives_)));
    }

    std::optional<VehicleModel> train(TrainingRecord record, const HardNegativeSource& more) {
        const int rounds = options_.hard_negative_rounds + 1;
        for (int round = 1;; ++round) {
            const std::string of = ", round " + std::to_string(round) + " of " + std::to_string(rounds);
            TrainingWatch watch = watch_;
            watch.progress = [&](const TrainingProgress& p) { watch_.show(p.phase + of, p.share); };
            TrainingSet set;
            watch_.show("describing" + of, 0);
            set.features = describeWindows(*descriptor_, windows_);
            set.vehicle.assign(windows_.size(), 0);
            std::fill_n(set.vehicle.begin(), positives_, std::uint8_t{1});
            VehicleModel model;
            model.descriptor = descriptor_;
            model.fit = options_.cutting().fit;
            model.classifier =
                trainClassifier(options_.classifier, set, options_.classifier_options,
                                static_cast<std::uint64_t>(options_.seed) + static_cast<std::uint64_t>(round), watch);
            if (!model.classifier || watch_.stopped()) return std::nullopt;
            if (round == rounds) {
                record.vehicles = positives_;
                record.others = static_cast<int>(windows_.size()) - positives_;
                record.hard_negative_rounds = options_.hard_negative_rounds;
                record.seed = static_cast<std::uint64_t>(options_.seed);
                model.record = std::move(record);
                return model;
            }
            watch_.show("hard negatives" + of, 0);
            addHardNegatives(model, more);
        }
    }

 private:
    void addVehicle(const cv::Mat& window) {
        std::vector<cv::Mat> versions{window};
        if (options_.mirrored) {
            versions.push_back(mirroredAcross(window));
            versions.push_back(mirroredAlong(window));
            versions.push_back(mirroredAlong(versions[1]));
        }
        for (const cv::Mat& version : versions) windows_.push_back(version);
        for (int copy = 0; copy < options_.varied_copies; ++copy) {
            const auto which = static_cast<std::size_t>(random_.below(static_cast<int>(versions.size())));
            const double change = options_.contrast_change;
            windows_.push_back(withContrast(versions[which], random_.between(1 - change, 1 + change)));
        }
    }

    void takeFromPool(std::size_t count) {
        const std::size_t left = pool_.size() - std::min(count, pool_.size());
        windows_.insert(windows_.end(), pool_.begin() + static_cast<std::ptrdiff_t>(left), pool_.end());
        pool_.resize(left);
    }

    void addHardNegatives(const VehicleModel& model, const HardNegativeSource& more) {
        const auto wanted = static_cast<std::size_t>(std::lround(options_.hard_others_per_vehicle * positives_));
        const std::vector<double> values = model.decideAll(pool_);
        std::vector<std::size_t> order(pool_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
        std::vector<cv::Mat> sorted;
        for (const std::size_t i : order) sorted.push_back(pool_[i]);
        pool_ = std::move(sorted);
        takeFromPool(wanted);
        if (!more) return;
        for (const Sample& sample : more(model, static_cast<int>(wanted))) windows_.push_back(sample.window);
    }

    const TrainingOptions& options_;
    const TrainingWatch& watch_;
    SeededRandom random_;
    std::shared_ptr<const Descriptor> descriptor_;
    std::vector<cv::Mat> windows_;  // vehicles first
    std::vector<cv::Mat> pool_;     // others not used yet
    int vehicles_ = 0;
    int positives_ = 0;
};

}  // namespace

void TrainingOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::none);
    declare.integer("training.seed", seed, 0, 1'000'000'000,
                    {"", "Seed of everything drawn at random; the same seed gives the same model.", ""});
    declare.integer("training.hard_negative_rounds", hard_negative_rounds, 0, 20,
                    {"rounds",
                     "How often the samples that the model wrongly takes for vehicles are added and it is trained "
                     "again. More: fewer false alarms.",
                     ""});
    declare.real("training.others_per_vehicle", others_per_vehicle, 0.01, 100,
                 {"", "Samples of background per sample of a vehicle in the first round.", "Teutsch §7.2"});
    declare.real("training.hard_others_per_vehicle", hard_others_per_vehicle, 0, 100,
                 {"", "Samples of background that each further round adds, per sample of a vehicle.", ""});
    declare.flag("training.duplicates", duplicates,
                 {"", "Whether samples that are nearly equal to others are used, too.", ""});
    declare.flag(
        "training.fill_window", fill_window,
        {"",
         "Cut samples as the thesis says: a vehicle's box fills the window, and background comes from places "
         "where no vehicle is visible. Off: with the ground around vehicles, some background right beside "
         "them. Of patch sheets, too, if their table has the columns length_px and width_px; else they are taken as "
         "they are.",
         "Teutsch §7.2"});
    declare.flag(
        "training.mirrored", mirrored,
        {"", "Whether vehicles are shown mirrored, too: sides exchanged, front and rear exchanged, both.", ""});
    declare.integer("training.varied_copies", varied_copies, 0, 20,
                    {"", "Copies of each vehicle with another contrast.", ""});
    declare.integer("training.misfit_copies", misfit_copies, 0, 20,
                    {"",
                     "Samples of background made of each vehicle by pushing it aside in its window, which teaches "
                     "where a vehicle ends.",
                     ""});
    declare.real("training.contrast_change", contrast_change, 0, 0.95,
                 {"", "How much the copies' contrast differs at most: 0.4 means 60 % to 140 %.", ""});
    classifier_options.describe(visitor);
}

std::string describeSources(const SampleSet& samples) {
    std::map<std::string, std::pair<int, int>> counts;
    for (const Sample& sample : samples)
        ++(sample.vehicle ? counts[sample.source].first : counts[sample.source].second);
    std::string text;
    for (const auto& [source, count] : counts) {
        text +=
            source + ": " + std::to_string(count.first) + " vehicles, " + std::to_string(count.second) + " others\n";
    }
    return text;
}

std::optional<VehicleModel> trainModel(const SampleSet& samples, const TrainingOptions& options, TrainingRecord record,
                                       const TrainingWatch& watch, const HardNegativeSource& more) {
    return Trainer(samples, options, watch).train(std::move(record), more);
}

}  // namespace eyrie
