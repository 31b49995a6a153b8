#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/arguments/output_arguments.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/reports/classification_report.h"

namespace eyrie::cli {
namespace {

struct ClassifyArguments {
    std::string model;
    std::string patches;
    std::string roc;
    OutputArguments outputs;
    bool json = false;
};

int classifyPatches(const ClassifyArguments& arguments) {
    arguments.outputs.check({{arguments.roc, FileKind::text}}, {arguments.model, arguments.patches});
    const VehicleModel model = loadModel(arguments.model);
    const SampleSet samples = readPatchSheets(arguments.patches, model.fit);
    const ClassificationResult result = classify(model, samples);
    if (!arguments.roc.empty()) writeRocCsv(arguments.roc, result.curve);
    if (arguments.json) {
        const nlohmann::ordered_json json{{"model", arguments.model},
                                          {"descriptor", nameOf(model.descriptor->kind())},
                                          {"classifier", nameOf(model.classifier->kind())},
                                          {"trained", model.record.utc_time},
                                          {"training_data", model.record.data},
                                          {"patches", arguments.patches},
                                          {"vehicles", result.vehicles},
                                          {"others", result.others},
                                          {"auc", result.area()},
                                          {"detection_rate_at_1_percent", result.detectionRateAt(0.01)},
                                          {"detection_rate_at_0.1_percent", result.detectionRateAt(0.001)}};
        std::printf("%s\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
        return exit_ok;
    }
    std::printf("model           %s and %s, trained %s\n", titleOf(model.descriptor->kind()),
                titleOf(model.classifier->kind()),
                model.record.utc_time.empty() ? "at an unknown time" : model.record.utc_time.c_str());
    std::printf("patches         %d vehicles, %d others\n", result.vehicles, result.others);
    std::printf("AUC             %s\n", fractionText(result.area(), 5).c_str());
    std::printf("detection rate  %s at 1 %% false alarms, %s at 0.1 %%\n",
                fractionText(result.detectionRateAt(0.01), 4).c_str(),
                fractionText(result.detectionRateAt(0.001), 4).c_str());
    return exit_ok;
}

}  // namespace

void addClassifyCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<ClassifyArguments>();
    CLI::App* command = app.add_subcommand("classify", "Measure a trained classifier on patch sheets");
    command->add_option("--model", arguments->model, "A model that eyrie-cli train wrote")->required();
    command->add_option("--patches", arguments->patches, "Folder with pos.png, neg.png and patches.csv")->required();
    command->add_option("--roc", arguments->roc, "Also write the ROC curve to this CSV file");
    arguments->outputs.addTo(*command);
    addJson(*command, arguments->json);
    command->callback([arguments, &exit_code] { exit_code = classifyPatches(*arguments); });
}

}  // namespace eyrie::cli
