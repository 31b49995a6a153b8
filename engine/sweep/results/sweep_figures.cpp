#include "sweep/results/sweep_figures.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace eyrie {
namespace {

std::vector<MeasureText> allMeasures() {
    std::vector<MeasureText> all;
    Measures empty;
    for (const NamedMeasure& m : listMeasures(empty))
        all.push_back({m.key, m.group, m.label, m.help, m.decimals, m.higher_is_better});
    return all;
}

}  // namespace

std::optional<double> SweepFigures::at(const std::string& key) const {
    for (const auto& [name, value] : values) {
        if (name == key) return value;
    }
    return std::nullopt;
}

SweepFigures figuresOf(const Measures& measures, int clip, bool tracks) {
    SweepFigures figures;
    figures.clip = clip;
    figures.tracks = tracks;
    figures.overlap = measures.overlap;
    for (const NamedMeasure& m : listMeasures(measures)) {
        if (m.value && std::isfinite(*m.value) && (tracks || !isOfTracks(m.group)))
            figures.values.emplace_back(m.key, *m.value);
    }
    return figures;
}

std::string textOf(const std::vector<SweepFigures>& figures) {
    auto json = nlohmann::ordered_json::array();
    for (const SweepFigures& one : figures) {
        nlohmann::ordered_json measures;
        for (const auto& [key, value] : one.values) measures[key] = value;
        json.push_back({{"sequence", one.clip},
                        {"of", one.tracks ? "tracks" : "detections"},
                        {"overlap", one.overlap},
                        {"measures", std::move(measures)}});
    }
    return json.dump();
}

std::vector<SweepFigures> figuresFrom(const std::string& text, const std::string& where) {
    try {
        std::vector<SweepFigures> figures;
        for (const auto& json : nlohmann::ordered_json::parse(text)) {
            SweepFigures one;
            one.clip = json.at("sequence").get<int>();
            one.tracks = json.at("of").get<std::string>() == "tracks";
            one.overlap = json.at("overlap").get<double>();
            for (const auto& [key, value] : json.at("measures").items())
                one.values.emplace_back(key, value.get<double>());
            figures.push_back(std::move(one));
        }
        return figures;
    } catch (const nlohmann::json::exception& error) {
        throw Error(ErrorKind::project, where + ": the figures of a sweep are damaged: " + error.what());
    }
}

const std::vector<MeasureText>& sweepMeasures() {
    static const std::vector<MeasureText> all = allMeasures();
    return all;
}

const MeasureText& measureText(const std::string& key) {
    const auto& all = sweepMeasures();
    const auto found = std::find_if(all.begin(), all.end(), [&](const MeasureText& m) { return m.key == key; });
    if (found == all.end()) {
        std::string known;
        for (const MeasureText& m : all) known += (known.empty() ? "" : ", ") + m.key;
        throw Error(ErrorKind::parameter, "there is no measure \"" + key + "\"; known are " + known);
    }
    return *found;
}

}  // namespace eyrie
