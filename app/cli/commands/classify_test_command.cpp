#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "cli/arguments/output_arguments.h"
#include "cli/arguments/sample_sources.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "cli/reports/classification_report.h"
#include "cli/reports/classification_table.h"
#include "core/error.h"
#include "learning/classifiers/seeded_random.h"
#include "learning/training/trainer.h"

namespace eyrie::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kOthersPerRenderedFrame = 120;

struct ClassifyTestArguments {
    std::vector<std::string> samples;
    std::vector<std::string> train_on;
    std::vector<std::string> descriptors;
    std::vector<std::string> classifiers;
    std::vector<std::string> settings;
    int rendered = 0;
    int vehicles = 800;
    int test_others = 20000;
    int seed = 1;
    std::string out;
    OutputArguments outputs;
    bool json = false;
    bool quiet = false;
};

using SetsBySource = std::map<std::string, SampleSet>;

SetsBySource readSets(const ClassifyTestArguments& arguments, const SampleCutting& cutting,
                      const std::stop_token& stop) {
    SetsBySource sets;
    for (Sample& sample : readSampleFolders(arguments.samples, cutting.fit))
        sets[sample.source].push_back(std::move(sample));
    if (arguments.rendered > 0) {
        const auto images = renderLabelledImages(arguments.rendered, static_cast<std::uint64_t>(arguments.seed),
                                                 !arguments.quiet, stop);
        for (std::size_t i = 0; i < images.size(); ++i) {
            for (Sample& sample : samplesFromImage(images[i], kOthersPerRenderedFrame, {}, i, cutting)) {
                sets["rendered"].push_back(std::move(sample));
            }
        }
    }
    if (sets.size() < 2) {
        throw Error(ErrorKind::parameter,
                    "at least two sources of samples are needed: models are trained on one and tested on the others");
    }
    return sets;
}

/// All vehicles but at most `vehicles` and `others` of each, drawn by the seed.
SampleSet drawn(const SampleSet& samples, int vehicles, int others, bool duplicates, std::uint64_t seed) {
    std::vector<const Sample*> order;
    for (const Sample& sample : samples) {
        if (duplicates || !sample.duplicate) order.push_back(&sample);
    }
    SeededRandom(seed).shuffle(order);
    SampleSet result;
    int left[2] = {others, vehicles};
    for (const Sample* sample : order) {
        if (left[sample->vehicle ? 1 : 0]-- > 0) result.push_back(*sample);
    }
    return result;
}

template <class Kind>
std::vector<Kind> chosen(const std::vector<std::string>& names, const std::vector<Kind>& all,
                         Kind (*from_name)(const std::string&)) {
    if (names.empty()) return all;
    std::vector<Kind> kinds;
    for (const std::string& name : names) kinds.push_back(from_name(name));
    return kinds;
}

/// As in the thesis: about as many others as vehicles, no variations, no further rounds; AdaBoost sees all features and
/// all samples for every tree.
TrainingOptions plainOptions(const ClassifyTestArguments& arguments) {
    TrainingOptions options;
    options.seed = arguments.seed;
    options.hard_negative_rounds = 0;
    options.mirrored = false;
    options.varied_copies = 0;
    options.misfit_copies = 0;
    options.classifier_options = ClassifierOptions::thesis();
    for (const std::string& setting : arguments.settings) {
        const auto equals = setting.find('=');
        if (equals == std::string::npos) {
            throw Error(ErrorKind::parameter, "--set " + setting + ": expected NAME=VALUE");
        }
        setParameter(describeOf(options), setting.substr(0, equals), setting.substr(equals + 1));
    }
    return options;
}

fs::path curveFile(const ClassifyTestArguments& arguments, DescriptorKind descriptor, ClassifierKind classifier,
                   const std::string& trained_on, const std::string& tested_on) {
    return fs::path(arguments.out) / (std::string(nameOf(descriptor)) + "_" + nameOf(classifier) + "_" + trained_on +
                                      "_on_" + tested_on + ".csv");
}

/// The folder for the curves, if any is wanted; nothing in it is replaced unasked.
void prepareFolder(const ClassifyTestArguments& arguments, const std::vector<DescriptorKind>& descriptors,
                   const std::vector<ClassifierKind>& classifiers, const SetsBySource& sets,
                   const std::set<std::string>& train_on) {
    if (arguments.out.empty()) return;
    std::vector<OutputFile> files;
    for (const DescriptorKind descriptor : descriptors) {
        for (const ClassifierKind classifier : classifiers) {
            for (const std::string& source : train_on) {
                for (const auto& [other, set] : sets) {
                    if (other == source) continue;
                    files.push_back(
                        {curveFile(arguments, descriptor, classifier, source, other), FileKind::text, false, true});
                }
            }
        }
    }
    const auto folders = sampleFolders(arguments.samples);
    arguments.outputs.check(files, {folders.begin(), folders.end()});
    std::error_code error;
    fs::create_directories(arguments.out, error);
    if (error)
        throw Error(ErrorKind::output,
                    arguments.out + ": the folder cannot be made (" + error.message() + "); choose another with --out");
}

int run(const ClassifyTestArguments& arguments) {
    const auto descriptors = chosen(arguments.descriptors, allDescriptors(), descriptorFromName);
    const auto classifiers = chosen(arguments.classifiers, allClassifiers(), classifierFromName);
    TrainingOptions options = plainOptions(arguments);
    return untilStopped([&](const std::stop_token& stop) {
        const SetsBySource sets = readSets(arguments, options.cutting(), stop);
        std::set<std::string> train_on(arguments.train_on.begin(), arguments.train_on.end());
        for (const std::string& name : train_on) {
            if (!sets.count(name))
                throw Error(ErrorKind::parameter, "--train-on " + name + ": no such source of samples");
        }
        if (train_on.empty()) {
            for (const auto& [name, set] : sets) train_on.insert(name);
        }
        prepareFolder(arguments, descriptors, classifiers, sets, train_on);
        TrainingWatch watch;
        watch.stop = stop;
        ClassificationTable table(descriptors, classifiers);
        for (const auto& [name, set] : sets) table.addSource(name, countOf(set, true), countOf(set, false));
        for (const DescriptorKind descriptor : descriptors) {
            for (const ClassifierKind classifier : classifiers) {
                options.descriptor = descriptor;
                options.classifier = classifier;
                for (const std::string& source : train_on) {
                    const auto seed = static_cast<std::uint64_t>(arguments.seed);
                    const SampleSet train =
                        drawn(sets.at(source), arguments.vehicles, 2 * arguments.vehicles, false, seed);
                    const auto model = trainModel(train, options, {}, watch);
                    if (!model) return exit_stopped;
                    for (const auto& [other, set] : sets) {
                        if (other == source) continue;
                        const auto result = classify(
                            *model, drawn(set, static_cast<int>(set.size()), arguments.test_others, true, seed));
                        table.add(descriptor, classifier, source, other, result);
                        if (!arguments.out.empty())
                            writeRocCsv(curveFile(arguments, descriptor, classifier, source, other), result.curve);
                        if (!arguments.quiet) {
                            std::fprintf(stderr, "%s + %s trained on %s, tested on %s: AUC %.4f\n", nameOf(descriptor),
                                         nameOf(classifier), source.c_str(), other.c_str(), result.area());
                        }
                    }
                }
            }
        }
        std::printf("%s", arguments.json ? table.json().c_str() : table.text().c_str());
        return exit_ok;
    });
}

}  // namespace

void addClassifyTestCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<ClassifyTestArguments>();
    CLI::App* command = app.add_subcommand(
        "classify-test", "Compare descriptors and classifiers over sources of samples (Teutsch table 7.4)");
    command->add_option("--samples", arguments->samples,
                        "Folders with patch sheets, each a source; several separated by commas");
    command->add_option("--rendered", arguments->rendered, "Render this many frames as a further source")
        ->check(CLI::Range(0, 10000));
    command->add_option("--train-on", arguments->train_on, "Only train on these sources (folder names, or rendered)")
        ->delimiter(',');
    command->add_option("--descriptors", arguments->descriptors, "Only these (default: all)")->delimiter(',');
    command->add_option("--classifiers", arguments->classifiers, "Only these (default: all)")->delimiter(',');
    command->add_option("--vehicles", arguments->vehicles, "Train on at most this many vehicles, and as many others")
        ->check(CLI::Range(10, 6000))
        ->capture_default_str();
    command->add_option("--test-others", arguments->test_others, "Test on at most this many others of each source")
        ->check(CLI::Range(10, 1000000))
        ->capture_default_str();
    command->add_option("--set", arguments->settings, "NAME=VALUE of a training parameter, e.g. training.trees=200");
    command->add_option("--seed", arguments->seed, "Seed of everything drawn at random")
        ->check(CLI::Range(0, 1000000000));
    command->add_option("--out", arguments->out, "Folder for the ROC curves, a CSV file each");
    arguments->outputs.addTo(*command);
    addJson(*command, arguments->json);
    addQuiet(*command, arguments->quiet);
    command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace eyrie::cli
