#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cli/reports/classification_report.h"
#include "learning/classifiers/classifier.h"
#include "learning/descriptors/descriptor.h"

namespace eyrie::cli {

/// AUC mean and deviation for descriptors and classifiers over test cases (Teutsch table 7.4), and which differences
/// are significant by the paired t-test of §7.3.3: two combinations in the same row or column, tested on the same
/// cases, differ when the chance of such a difference is below 5 %.
class ClassificationTable {
 public:
    ClassificationTable(std::vector<DescriptorKind> descriptors, std::vector<ClassifierKind> classifiers);

    void addSource(const std::string& name, int vehicles, int others);
    /// Cases must come in the same order for every combination.
    void add(DescriptorKind descriptor, ClassifierKind classifier, const std::string& trained_on,
             const std::string& tested_on, const ClassificationResult& result);

    std::string text() const;
    std::string json() const;

 private:
    struct Case {
        std::string trained_on;
        std::string tested_on;
        double area = 0;
        double at_1_percent = 0;
        double at_01_percent = 0;
    };
    struct Source {
        std::string name;
        int vehicles = 0;
        int others = 0;
    };
    struct Difference {
        std::string better;
        std::string worse;
        std::string constant;
        double mean = 0;
        double p_value = 1;
    };
    using Combination = std::pair<DescriptorKind, ClassifierKind>;

    std::vector<double> areas(const Combination& combination) const;
    std::vector<Difference> differences() const;

    std::vector<DescriptorKind> descriptors_;
    std::vector<ClassifierKind> classifiers_;
    std::vector<Source> sources_;
    std::map<Combination, std::vector<Case>> cases_;
};

}  // namespace eyrie::cli
