#include "cli/reports/classification_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "evaluation/comparison/significance.h"

namespace eyrie::cli {
namespace {

constexpr double kSignificant = 0.05;
constexpr int kColumn = 19;

double meanOf(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// Of the sample; 0 for one value.
double deviationOf(const std::vector<double>& values) {
    const double mean = meanOf(values);
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return values.size() > 1 ? std::sqrt(squares / static_cast<double>(values.size() - 1)) : 0;
}

std::string padded(std::string text, int columns, int shown) {
    text.append(static_cast<std::size_t>(std::max(1, columns - shown)), ' ');
    return text;
}

}  // namespace

ClassificationTable::ClassificationTable(std::vector<DescriptorKind> descriptors,
                                         std::vector<ClassifierKind> classifiers)
    : descriptors_(std::move(descriptors)), classifiers_(std::move(classifiers)) {}

void ClassificationTable::addSource(const std::string& name, int vehicles, int others) {
    sources_.push_back({name, vehicles, others});
}

void ClassificationTable::add(DescriptorKind descriptor, ClassifierKind classifier, const std::string& trained_on,
                              const std::string& tested_on, const ClassificationResult& result) {
    cases_[{descriptor, classifier}].push_back(
        {trained_on, tested_on, result.area(), result.detectionRateAt(0.01), result.detectionRateAt(0.001)});
}

std::vector<double> ClassificationTable::areas(const Combination& combination) const {
    std::vector<double> values;
    for (const Case& one : cases_.at(combination)) values.push_back(one.area);
    return values;
}

std::vector<ClassificationTable::Difference> ClassificationTable::differences() const {
    std::vector<Difference> found;
    const auto compare = [&](const Combination& a, const Combination& b, const char* name_a, const char* name_b,
                             const char* constant) {
        const std::vector<double> areas_a = areas(a);
        const std::vector<double> areas_b = areas(b);
        if (areas_a.size() < 2) return;
        const PairedTTest test = pairedTTest(areas_a, areas_b);
        if (test.p_value >= kSignificant) return;
        const bool first = test.mean_difference > 0;
        found.push_back(
            {first ? name_a : name_b, first ? name_b : name_a, constant, std::abs(test.mean_difference), test.p_value});
    };
    for (const ClassifierKind c : classifiers_) {
        for (std::size_t i = 0; i < descriptors_.size(); ++i) {
            for (std::size_t j = i + 1; j < descriptors_.size(); ++j) {
                compare({descriptors_[i], c}, {descriptors_[j], c}, nameOf(descriptors_[i]), nameOf(descriptors_[j]),
                        nameOf(c));
            }
        }
    }
    for (const DescriptorKind d : descriptors_) {
        for (std::size_t i = 0; i < classifiers_.size(); ++i) {
            for (std::size_t j = i + 1; j < classifiers_.size(); ++j) {
                compare({d, classifiers_[i]}, {d, classifiers_[j]}, nameOf(classifiers_[i]), nameOf(classifiers_[j]),
                        nameOf(d));
            }
        }
    }
    return found;
}

std::string ClassificationTable::text() const {
    std::string text;
    for (const Source& source : sources_) {
        text += source.name + ": " + std::to_string(source.vehicles) + " vehicles, " + std::to_string(source.others) +
                " others\n";
    }
    text +=
        "\nAUC mean ± deviation, each model trained on one source and tested on each other one; * best of the column\n";
    text += padded("classifier", 14, 10);
    std::map<DescriptorKind, double> best;
    for (const DescriptorKind d : descriptors_) {
        const std::string name = nameOf(d);
        text += padded(name, kColumn, static_cast<int>(name.size()));
        for (const ClassifierKind c : classifiers_) best[d] = std::max(best[d], meanOf(areas({d, c})));
    }
    text += "\n";
    for (const ClassifierKind c : classifiers_) {
        const std::string name = nameOf(c);
        text += padded(name, 14, static_cast<int>(name.size()));
        for (const DescriptorKind d : descriptors_) {
            const std::vector<double> values = areas({d, c});
            const bool is_best = classifiers_.size() > 1 && meanOf(values) == best[d];
            const std::string cell =
                fractionText(meanOf(values), 4) + " ± " + fractionText(deviationOf(values), 4) + (is_best ? "*" : "");
            text += padded(cell, kColumn, static_cast<int>(cell.size()) - 1);  // ± takes two bytes
        }
        text += "\n";
    }
    text += "\nSignificant differences (paired t-test, p < 0.05):\n";
    const auto found = differences();
    for (const Difference& d : found) {
        char line[160];
        std::snprintf(line, sizeof line, "%-12s %s > %s by %.4f (p = %.3f)\n", (d.constant + ":").c_str(),
                      d.better.c_str(), d.worse.c_str(), d.mean, d.p_value);
        text += line;
    }
    if (found.empty()) text += "none\n";
    return text;
}

std::string ClassificationTable::json() const {
    using Json = nlohmann::ordered_json;
    Json json{{"sources", Json::array()}, {"combinations", Json::array()}, {"significant", Json::array()}};
    for (const Source& s : sources_) {
        json["sources"].push_back({{"name", s.name}, {"vehicles", s.vehicles}, {"others", s.others}});
    }
    for (const DescriptorKind d : descriptors_) {
        for (const ClassifierKind c : classifiers_) {
            const std::vector<double> values = areas({d, c});
            Json entry{{"descriptor", nameOf(d)},
                       {"classifier", nameOf(c)},
                       {"auc_mean", meanOf(values)},
                       {"auc_deviation", deviationOf(values)},
                       {"cases", Json::array()}};
            for (const Case& one : cases_.at({d, c})) {
                entry["cases"].push_back({{"trained_on", one.trained_on},
                                          {"tested_on", one.tested_on},
                                          {"auc", one.area},
                                          {"detection_rate_at_1_percent", one.at_1_percent},
                                          {"detection_rate_at_0.1_percent", one.at_01_percent}});
            }
            json["combinations"].push_back(std::move(entry));
        }
    }
    for (const Difference& d : differences()) {
        json["significant"].push_back({{"constant", d.constant},
                                       {"better", d.better},
                                       {"worse", d.worse},
                                       {"mean_difference", d.mean},
                                       {"p_value", d.p_value}});
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace eyrie::cli
