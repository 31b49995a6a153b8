#include "learning/training/trainer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/error.h"
#include "evaluation/measures/roc.h"
#include "learning/drawn_windows.h"
#include "learning/models/window_scanner.h"
#include "support/places.h"
#include "support/shared_data.h"

namespace eyrie::trainer_test {
namespace {

TrainingOptions smallOptions() {
    TrainingOptions options;
    options.classifier_options.trees = 40;
    options.hard_negative_rounds = 1;
    options.misfit_copies = 0;
    return options;
}

double areaUnderRoc(const VehicleModel& model, const SampleSet& samples) {
    std::vector<cv::Mat> windows;
    for (const Sample& sample : samples) windows.push_back(sample.window);
    const auto values = model.decideAll(windows);
    std::vector<ScoredSample> scored;
    for (std::size_t i = 0; i < values.size(); ++i) scored.push_back({values[i], samples[i].vehicle});
    return rocCurve(scored).area;
}

}  // namespace

TEST(Trainer, learnsDrawnVehiclesWithEveryDescriptor) {
    const SampleSet train = test::drawnSamples(60, 200, 1);
    const SampleSet test = test::drawnSamples(100, 300, 2);
    for (const DescriptorKind kind : allDescriptors()) {
        TrainingOptions options = smallOptions();
        options.descriptor = kind;
        const auto model = trainModel(train, options, {});
        ASSERT_TRUE(model);
        EXPECT_GT(areaUnderRoc(*model, test), 0.98) << nameOf(kind);
    }
}

TEST(Trainer, countsWhatItUsedAndIsTheSameForTheSameSeed) {
    SampleSet samples = test::drawnSamples(30, 400, 1);
    for (std::size_t i = 0; i < 10; ++i) samples[i].duplicate = true;
    TrainingOptions options = smallOptions();
    options.misfit_copies = 3;
    const auto model = trainModel(samples, options, {});
    EXPECT_EQ(model->record.vehicles, 20 * 5) << "four mirrored and one with another contrast";
    EXPECT_EQ(model->record.others, 20 * 3 + 100 + 100) << "misfits, then as many as vehicles in each of both rounds";
    EXPECT_EQ(model->record.hard_negative_rounds, 1);
    EXPECT_EQ(modelBytes(*model), modelBytes(*trainModel(samples, options, {})));
    options.seed = 2;
    EXPECT_NE(modelBytes(*model), modelBytes(*trainModel(samples, options, {})));
}

TEST(Trainer, takesAsManyOthersAsItsParametersSay) {
    // 20 vehicles make 100 samples, four of each mirrored and one of another contrast; 800 others.
    const SampleSet samples = test::drawnSamples(20, 800, 1);
    TrainingOptions options = smallOptions();
    const auto others = [&](double first, double further) {
        options.others_per_vehicle = first;
        options.hard_others_per_vehicle = further;
        return trainModel(samples, options, {})->record.others;
    };
    EXPECT_EQ(others(2, 0.5), 250);
    EXPECT_EQ(others(0.5, 3), 350);
    EXPECT_EQ(others(50, 1), 800) << "there are no more";
    options.hard_negative_rounds = 3;
    EXPECT_EQ(others(1, 0.5), 250);
}

TEST(Trainer, copiesOfAnotherContrastFollowTheirParameter) {
    const SampleSet samples = test::drawnSamples(20, 60, 1);
    TrainingOptions options = smallOptions();
    options.descriptor = DescriptorKind::moments;
    std::set<std::string> models;
    for (const char* change : {"0", "0.3", "0.8"}) {
        setParameter(describeOf(options), "training.contrast_change", change);
        models.insert(modelBytes(*trainModel(samples, options, {})));
    }
    EXPECT_EQ(models.size(), 3U);
}

TEST(Trainer, asksForHardNegativesAndLearnsThem) {
    // Short bars are missing from the first set, and look like vehicles.
    const auto bar = [](SeededRandom& random) {
        cv::Mat window(kWindowHeight, kWindowWidth, CV_8UC1, cv::Scalar(120));
        cv::rectangle(window, cv::Rect(3, 2 + random.below(18), 9, 9), cv::Scalar(random.below(2) ? 220 : 40),
                      cv::FILLED);
        return window;
    };
    TrainingOptions options = smallOptions();
    options.hard_negative_rounds = 2;
    int asked = 0;
    const HardNegativeSource source = [&](const VehicleModel& model, int wanted) {
        EXPECT_GT(wanted, 0);
        SeededRandom random(static_cast<std::uint64_t>(++asked));
        SampleSet found;
        for (int i = 0; i < 60; ++i) {
            const cv::Mat window = bar(random);
            if (model.decide(window) > -10) found.push_back({window, false, "bars", "", false});
        }
        return found;
    };
    const SampleSet train = test::drawnSamples(60, 200, 1);
    const auto without = trainModel(train, options, {});
    const auto with = trainModel(train, options, {}, {}, source);
    EXPECT_EQ(asked, 2);
    SeededRandom random(77);
    double mean_without = 0;
    double mean_with = 0;
    for (int i = 0; i < 50; ++i) {
        const cv::Mat window = bar(random);
        mean_without += without->decide(window) / 50;
        mean_with += with->decide(window) / 50;
    }
    EXPECT_LT(mean_with, mean_without - 5);
}

TEST(Trainer, misfitsTeachWhereAVehicleEnds) {
    const SampleSet train = test::drawnSamples(80, 200, 1);
    TrainingOptions options = smallOptions();
    const auto without = trainModel(train, options, {});
    options.misfit_copies = 2;
    const auto with = trainModel(train, options, {});
    // How much lower a window lies that shows only a part of the vehicle.
    double lower_without = 0;
    double lower_with = 0;
    for (const int tone : {20, 50, 210, 240}) {
        cv::Mat ground(60, 40, CV_8UC1, cv::Scalar(120));
        cv::rectangle(ground, cv::Rect(15, 20, 9, 21), cv::Scalar(tone), cv::FILLED);
        const cv::Rect middle(12, 15, kWindowWidth, kWindowHeight);
        for (const cv::Point aside : {cv::Point(0, 10), cv::Point(0, -10), cv::Point(6, 0), cv::Point(-6, 0)}) {
            lower_without += without->decide(ground(middle)) - without->decide(ground(middle + aside));
            lower_with += with->decide(ground(middle)) - with->decide(ground(middle + aside));
        }
    }
    EXPECT_GT(lower_with, lower_without + 16 * 2);
}

TEST(Trainer, nearlyEqualSamplesAreUsedWhereAskedFor) {
    SampleSet samples = test::drawnSamples(30, 400, 1);
    for (std::size_t i = 0; i < 10; ++i) samples[i].duplicate = true;
    const auto vehicles = [&](const char* duplicates) {
        TrainingOptions options = smallOptions();
        setParameter(describeOf(options), "training.duplicates", duplicates);
        return trainModel(samples, options, {})->record.vehicles;
    };
    EXPECT_EQ(vehicles("false"), 20 * 5);
    EXPECT_EQ(vehicles("true"), 30 * 5);
}

TEST(Trainer, theModelKnowsWhatAVehicleTakesOfTheWindow) {
    const SampleSet samples = test::drawnSamples(30, 60, 1);
    TrainingOptions options = smallOptions();
    EXPECT_EQ(trainModel(samples, options, {})->fit, (WindowFit{21.5, 10}));
    setParameter(describeOf(options), "training.fill_window", "true");
    EXPECT_EQ(trainModel(samples, options, {})->fit, (WindowFit{32, 16}));
    EXPECT_EQ(options.cutting().fit, WindowFit::filled());
    EXPECT_FALSE(options.cutting().beside_vehicles);
}

TEST(Trainer, reportsProgressAndStops) {
    std::stop_source stop;
    std::vector<std::string> phases;
    TrainingWatch watch;
    watch.stop = stop.get_token();
    watch.progress = [&](const TrainingProgress& progress) {
        if (phases.empty() || phases.back() != progress.phase) phases.push_back(progress.phase);
        if (progress.phase.starts_with("boosting") && progress.share > 0.5) stop.request_stop();
    };
    EXPECT_FALSE(trainModel(test::drawnSamples(30, 60, 1), smallOptions(), {}, watch));
    EXPECT_THAT(phases, testing::ElementsAre("describing, round 1 of 2", "boosting, round 1 of 2"));
}

TEST(Trainer, saysWhenSamplesAreMissing) {
    EXPECT_THROW(trainModel({}, smallOptions(), {}), Error);
    EXPECT_THROW(trainModel(test::drawnSamples(30, 0, 1), smallOptions(), {}), Error);
    EXPECT_THROW(trainModel(test::drawnSamples(0, 30, 1), smallOptions(), {}), Error);
}

TEST(Trainer, optionsAreDeclared) {
    TrainingOptions options;
    const auto parameters = listParameters(describeOf(options));
    EXPECT_EQ(parameters.size(), 17U);
    for (const Parameter& parameter : parameters) EXPECT_THAT(parameter.name, testing::StartsWith("training."));
    EXPECT_THROW(setParameter(describeOf(options), "training.trees", "0"), Error);
    setParameter(describeOf(options), "training.trees", "77");
    EXPECT_EQ(options.classifier_options.trees, 77);
}

TEST(ShippedModels, tellVehiclesOfACameraTheyHaveNeverSeen) {
    EYRIE_NEED_SHARED_DATA("patches/cats_madison");
    for (const char* name : {"vehicle_chnftrs_adaboost.eyriemodel", "vehicle_thesis.eyriemodel"}) {
        const VehicleModel model = loadModel(test::sourceFolder() / "resources/classifiers" / name);
        EXPECT_TRUE(WindowScanner(model).fast()) << name;
        EXPECT_EQ(model.record.data.find("cats_madison"), std::string::npos) << name;
        EXPECT_GE(areaUnderRoc(model, readPatchSheets(test::sharedData("patches/cats_madison"), model.fit)), 0.99)
            << name;
    }
}

}  // namespace eyrie::trainer_test
