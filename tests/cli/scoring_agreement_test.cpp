// One run is measured by every way there is, and has the same figures by all of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <regex>
#include <sstream>

#include "cli/loaded_program.h"
#include "diagnosis/run_evaluation.h"
#include "support/moving_scene.h"
#include "support/temporary_folder.h"

namespace eyrie::scoring_agreement_test {
namespace {

/// By name as in files; figures of people's tables are rounded as there.
using Figures = std::map<std::string, std::string>;
const std::map<std::string, std::string> kLabels{
    {"tp", "TP"}, {"fp", "FP"}, {"fn", "FN"}, {"f_score", "f-score"}, {"mota", "MOTA"}};

std::string rounded(const std::string& key, double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", key.size() == 2 ? 0 : 4, value);
    return text;
}

Figures figuresOf(const nlohmann::json& measures) {
    Figures figures;
    for (const auto& [key, label] : kLabels) {
        const bool known = measures.contains(key) && !measures.at(key).is_null();
        figures[key] = known ? rounded(key, measures.at(key).get<double>()) : "–";
    }
    return figures;
}

Figures figuresOf(const Measures& measures) {
    Figures figures;
    for (const NamedMeasure& measure : listMeasures(measures)) {
        if (kLabels.contains(measure.key))
            figures[measure.key] = measure.value ? rounded(measure.key, *measure.value) : "–";
    }
    return figures;
}

/// The second column, of T_ov 0.2.
Figures figuresOfReport(const std::string& html) {
    Figures figures;
    for (const auto& [key, label] : kLabels) {
        const std::regex row("<td[^>]*>" + label + "</td><td[^>]*>[^<]*</td><td[^>]*>([^<]*)</td>");
        std::smatch found;
        EXPECT_TRUE(std::regex_search(html, found, row)) << label;
        figures[key] = found[1];
    }
    return figures;
}

/// A run over frames 3 to 22 of a clip; the ground truth covers more of it, and one vehicle is to be ignored for a
/// time.
class ScoringAgreement : public testing::TestWithParam<std::tuple<std::string, bool>> {
 protected:
    void SetUp() override {
        const test::MovingScene scene;
        std::filesystem::create_directories(folder / "clip");
        std::ofstream csv(folder / "truth.csv");
        std::ofstream mot(folder / "gt.txt");
        csv << "frame,id,x,y,length,width,heading,class,ignore\n";
        for (int i = 0; i < 30; ++i) {
            cv::imwrite(at("clip/" + std::to_string(1000 + i) + ".png"), scene.draw(i));
            for (int v = 0; v < 2; ++v) {
                const auto& vehicle = scene.vehicles[static_cast<std::size_t>(v)];
                const cv::Point2d centre = scene.vehicleAt(vehicle, i);
                const bool ignore = v == 1 && i < 8;
                csv << i << "," << v + 1 << "," << centre.x << "," << centre.y << "," << vehicle.size.width << ","
                    << vehicle.size.height << "," << 90 * v << ",car," << ignore << "\n";
                const cv::Size2d size = v == 0 ? vehicle.size : cv::Size2d(vehicle.size.height, vehicle.size.width);
                mot << i + 1 << "," << v + 1 << "," << centre.x - size.width / 2 + 1.5 << ","
                    << centre.y - size.height / 2 + 1.5 << "," << size.width << "," << size.height << "," << !ignore
                    << ",3,1\n";
            }
        }
    }
    std::string at(const std::string& name) const { return (folder / name).string(); }
    /// What the command prints.
    std::string call(std::vector<std::string> arguments, const std::vector<std::string>& more = {}) const {
        arguments.insert(arguments.end(), more.begin(), more.end());
        const auto result = test::runLoaded(arguments);
        EXPECT_EQ(result.exit_code, 0) << arguments[1] << ": " << result.errors;
        return result.output;
    }
    /// The file of ground truth; empty: the labels of the project.
    const std::string& file() const { return std::get<0>(GetParam()); }
    bool detections() const { return std::get<1>(GetParam()); }

    /// Makes the run and measures it, where that goes without labels.
    Figures compare() const {
        const auto report = nlohmann::json::parse(call({"compare",
                                                        "--sequence",
                                                        at("clip"),
                                                        "--ground-truth",
                                                        at(file().empty() ? "truth.csv" : file()),
                                                        "--gsd",
                                                        "0.2",
                                                        "--frames",
                                                        "3:22",
                                                        "--methods",
                                                        "gradient",
                                                        "--tracking",
                                                        detections() ? "off" : "on",
                                                        "--set",
                                                        "gradient.quantile=0.3",
                                                        "--set",
                                                        "view.oblique=false",
                                                        "--project",
                                                        at("p.eyrie"),
                                                        "--quiet",
                                                        "--json",
                                                        "--overlap",
                                                        "0.2",
                                                        "--border",
                                                        "2"}));
        EXPECT_EQ(report["upright"], file() == "gt.txt");
        return figuresOf(report["results"][0]);
    }
    Figures evaluate(const std::vector<std::string>& how) const {
        const auto report = nlohmann::json::parse(
            call({"evaluate", "--project", at("p.eyrie"), "--json", "--overlap", "0.2"}, withDetections(how)));
        EXPECT_EQ(report["upright"], file() == "gt.txt");
        const std::string noted = report["remarks"].dump();
        EXPECT_EQ(noted.find("enclosing upright boxes are compared") != std::string::npos, file() == "gt.txt");
        return figuresOf(report["measures"][0]);
    }
    Figures sweep(const std::vector<std::string>& how) const {
        const auto report =
            nlohmann::json::parse(call({"sweep", "--project", at("p.eyrie"), "--parameter", "gradient.quantile=0.3",
                                        "--quiet", "--json", "--overlap", "0.2"},
                                       how));
        for (const auto& figures : report["points"][0]["figures"])
            if ((figures["of"] == "detections") == detections()) return figuresOf(figures["measures"]);
        return {};
    }
    Figures report(const std::vector<std::string>& how) const {
        call({"report", "--project", at("p.eyrie"), "--out", at("r.html"), "--chips", "0", "--overlap", "0.2"},
             withDetections(how));
        std::stringstream html;
        html << std::ifstream(at("r.html")).rdbuf();
        return figuresOfReport(html.str());
    }
    /// As the dock of the window asks.
    Figures dock() const {
        EvaluationRequest request;
        request.project = at("p.eyrie");
        request.run_id = 1;
        request.detections = detections();
        if (!file().empty()) request.truth.file = at(file());
        request.options.overlap = 0.2;
        request.options.border = 2;
        RunEvaluator evaluator;
        return figuresOf(evaluator.evaluate(request)->shown);
    }
    std::vector<std::string> withDetections(std::vector<std::string> how) const {
        if (detections()) how.emplace_back("--detections");
        return how;
    }

    const test::TemporaryFolder folder;
};

TEST_P(ScoringAgreement, everyWayGivesTheSameFigures) {
    const Figures compared = compare();
    std::vector<std::string> how{"--border", "2"};
    if (file().empty()) {
        call({"import", at("truth.csv"), "--project", at("p.eyrie")});
    } else {
        how.insert(how.end(), {"--ground-truth", at(file())});
    }
    const Figures evaluated = evaluate(how);
    EXPECT_GT(std::stoi(evaluated.at("tp")), 10);
    EXPECT_EQ(evaluated.at("mota") == "–", detections());
    if (!file().empty()) {
        EXPECT_EQ(compared, evaluated);
    }
    EXPECT_EQ(sweep(how), evaluated);
    EXPECT_EQ(report(how), evaluated);
    EXPECT_EQ(dock(), evaluated);
}

INSTANTIATE_TEST_SUITE_P(Truths, ScoringAgreement,
                         testing::Combine(testing::Values("truth.csv", "gt.txt", ""), testing::Bool()));

}  // namespace
}  // namespace eyrie::scoring_agreement_test
