#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/arguments/output_arguments.h"
#include "cli/arguments/sample_sources.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "cli/reports/console_progress.h"
#include "core/error.h"
#include "core/time/utc_time.h"
#include "learning/training/background_mining.h"
#include "learning/training/labelled_frames.h"
#include "learning/training/trainer.h"

namespace eyrie::cli {
namespace {

struct TrainArguments {
    std::string descriptor = "chnftrs";
    std::string classifier = "adaboost";
    std::vector<std::string> samples;
    std::vector<std::string> inputs;
    std::vector<std::string> ground_truths;
    int every = 10;
    int rendered = 0;
    std::string out;
    std::string seed;
    std::string rounds;
    std::string trees;
    std::vector<std::string> settings;
    std::string note;
    OutputArguments outputs;
    bool quiet = false;
};

TrainingOptions optionsOf(const TrainArguments& arguments) {
    TrainingOptions options;
    options.descriptor = descriptorFromName(arguments.descriptor);
    options.classifier = classifierFromName(arguments.classifier);
    const auto set = [&](const std::string& name, const std::string& value) {
        setParameter(describeOf(options), name, value);
    };
    for (const std::string& setting : arguments.settings) {
        const auto equals = setting.find('=');
        if (equals == std::string::npos) {
            throw Error(ErrorKind::parameter, "--set " + setting + ": expected NAME=VALUE");
        }
        set(setting.substr(0, equals), setting.substr(equals + 1));
    }
    if (!arguments.seed.empty()) set("training.seed", arguments.seed);
    if (!arguments.rounds.empty()) set("training.hard_negative_rounds", arguments.rounds);
    if (!arguments.trees.empty()) set("training.trees", arguments.trees);
    return options;
}

std::vector<std::filesystem::path> inputsOf(const TrainArguments& arguments) {
    std::vector<std::filesystem::path> inputs(arguments.inputs.begin(), arguments.inputs.end());
    inputs.insert(inputs.end(), arguments.ground_truths.begin(), arguments.ground_truths.end());
    const auto folders = sampleFolders(arguments.samples);
    inputs.insert(inputs.end(), folders.begin(), folders.end());
    return inputs;
}

/// Shows each phase on its own line of progress.
class PhaseProgress {
 public:
    void show(const TrainingProgress& progress) {
        if (progress.phase != phase_) {
            line_.reset();
            line_.emplace("% " + progress.phase);
            phase_ = progress.phase;
            start_ = std::chrono::steady_clock::now();
        }
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        const double left = progress.share > 0 ? seconds * (1 - progress.share) / progress.share : 0;
        line_->show(static_cast<int>(std::lround(100 * progress.share)), 100, 100 * progress.share / (seconds + 1e-6),
                    left);
    }
    void end() { line_.reset(); }

 private:
    std::string phase_;
    std::optional<ConsoleProgress> line_;
    std::chrono::steady_clock::time_point start_;
};

std::vector<LabelledImage> labelledImages(const TrainArguments& arguments, const TrainingOptions& options,
                                          const std::stop_token& stop) {
    std::vector<LabelledImage> images;
    for (std::size_t i = 0; i < arguments.inputs.size(); ++i) {
        auto read = readLabelledFrames(arguments.inputs[i], arguments.ground_truths[i], arguments.every,
                                       !arguments.quiet, stop);
        std::move(read.begin(), read.end(), std::back_inserter(images));
    }
    if (arguments.rendered > 0) {
        auto rendered =
            renderLabelledImages(arguments.rendered, static_cast<std::uint64_t>(options.seed), !arguments.quiet, stop);
        std::move(rendered.begin(), rendered.end(), std::back_inserter(images));
    }
    return images;
}

int run(const TrainArguments& arguments) {
    const TrainingOptions options = optionsOf(arguments);
    if (arguments.samples.empty() && arguments.inputs.empty() && arguments.rendered == 0) {
        throw Error(ErrorKind::parameter, "nothing to train with: give --samples, --images or --rendered");
    }
    if (arguments.inputs.size() != arguments.ground_truths.size()) {
        throw Error(ErrorKind::parameter, "--images and --ground-truth: each needs the other, in the same order");
    }
    arguments.outputs.check({{arguments.out, FileKind::model}}, inputsOf(arguments));
    return untilStopped([&](const std::stop_token& stop) {
        SampleSet samples = readSampleFolders(arguments.samples, options.cutting().fit);
        const std::vector<LabelledImage> images = labelledImages(arguments, options, stop);
        SampleSet cut = samplesFromImages(images, static_cast<std::uint64_t>(options.seed), options.cutting());
        std::move(cut.begin(), cut.end(), std::back_inserter(samples));
        if (stop.stop_requested()) return exit_stopped;
        TrainingRecord record;
        record.data = describeSources(samples) + arguments.note;
        record.utc_time = nowUtc();
        TrainingOptions described = options;
        for (const Parameter& parameter : listParameters(describeOf(described))) {
            record.settings += parameter.name + " = " + parameter.value + "\n";
        }
        std::printf("%s", describeSources(samples).c_str());
        std::fflush(stdout);

        PhaseProgress progress;
        TrainingWatch watch;
        watch.stop = stop;
        if (!arguments.quiet) watch.progress = [&](const TrainingProgress& step) { progress.show(step); };
        HardNegativeSource more;
        std::uint64_t round = 0;
        if (!images.empty()) {
            more = [&](const VehicleModel& model, int wanted) {
                return mineBackground(model, images, typicalVehicle(), wanted,
                                      static_cast<std::uint64_t>(options.seed) + 1000 * ++round, watch);
            };
        }
        const auto model = trainModel(samples, options, record, watch, more);
        progress.end();
        if (!model) {
            std::fprintf(stderr, "stopped; no model was written\n");
            return exit_stopped;
        }
        saveModel(*model, arguments.out);
        std::error_code unknown;
        const std::uintmax_t size = std::filesystem::file_size(arguments.out, unknown);
        std::printf(
            "%s and %s, %d features, trained on %d windows of vehicles (with mirrored and varied ones) and %d others: "
            "%s, %.0f kB\n",
            titleOf(options.descriptor), titleOf(options.classifier), model->descriptor->dimension(),
            model->record.vehicles, model->record.others, arguments.out.c_str(),
            unknown ? 0.0 : static_cast<double>(size) / 1000);
        return exit_ok;
    });
}

/// "One of dct (DCT), …": what may be written, and what it is.
template <class Kinds>
std::string namesOf(const Kinds& kinds) {
    std::string list;
    for (const auto kind : kinds) {
        const std::string name = nameOf(kind);
        const std::string title = titleOf(kind);
        list += (list.empty() ? "One of " : ", ") + name + (title == name ? "" : " (" + title + ")");
    }
    return list;
}

}  // namespace

void addTrainCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<TrainArguments>();
    CLI::App* command = app.add_subcommand("train", "Train a classifier of vehicles for the sliding window");
    command->add_option("--descriptor", arguments->descriptor, namesOf(allDescriptors()))->capture_default_str();
    command->add_option("--classifier", arguments->classifier, namesOf(allClassifiers()))->capture_default_str();
    command->add_option("--samples", arguments->samples,
                        "Folders with patch sheets: pos.png, neg.png, patches.csv; several separated by commas");
    command->add_option("--images", arguments->inputs,
                        "Video, image folder or scene:NAME whose labelled vehicles are cut out");
    command->add_option("--ground-truth", arguments->ground_truths, "Table of boxes for each --images");
    command->add_option("--every", arguments->every, "Use every n-th frame of --images")->capture_default_str();
    command->add_option("--rendered", arguments->rendered, "Also train on this many rendered frames of built-in scenes")
        ->check(CLI::Range(0, 10000));
    command->add_option("--out", arguments->out, "The model file to write")->required();
    command->add_option("--seed", arguments->seed, "Seed of everything drawn at random (default 1)");
    command->add_option("--hard-negative-rounds", arguments->rounds,
                        "How often false alarms are added and training is repeated (default 2)");
    command->add_option("--trees", arguments->trees, "Trees of AdaBoost and Random Forest (default 1000)");
    command->add_option("--set", arguments->settings, "NAME=VALUE of a training parameter, e.g. training.folds=5");
    command->add_option("--note", arguments->note,
                        "Note kept in the model, such as the source and licence of the samples");
    arguments->outputs.addTo(*command);
    addQuiet(*command, arguments->quiet);
    command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace eyrie::cli
