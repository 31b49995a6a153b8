// A sweep's plan as text for files, and what makes two plans the same.
#include <cstdint>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "sweep/plan/sweep_plan.h"

namespace eyrie {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const SweepClip& clip) {
    return {{"sequence", clip.sequence},
            {"ground_truth", clip.ground_truth},
            {"run", clip.run},
            {"digest", clip.digest},
            {"size", {clip.size.width, clip.size.height}},
            {"frames", {clip.first_frame, clip.last_frame}},
            {"gsd_m_per_px", clip.scale.gsd_m_per_px},
            {"gsd_known", clip.scale.gsd_known},
            {"frame_rate_hz", clip.scale.frame_rate_hz},
            {"upright", clip.upright}};
}

SweepClip clipOf(const Json& json) {
    SweepClip clip;
    clip.sequence = json.at("sequence").get<std::string>();
    clip.ground_truth = json.at("ground_truth").get<std::string>();
    clip.run = json.at("run").get<int>();
    clip.digest = json.at("digest").get<std::string>();
    clip.size = {json.at("size").at(0).get<int>(), json.at("size").at(1).get<int>()};
    clip.first_frame = json.at("frames").at(0).get<int>();
    clip.last_frame = json.at("frames").at(1).get<int>();
    clip.scale.gsd_m_per_px = json.at("gsd_m_per_px").get<double>();
    clip.scale.gsd_known = json.at("gsd_known").get<bool>();
    clip.scale.frame_rate_hz = json.at("frame_rate_hz").get<double>();
    clip.upright = json.at("upright").get<bool>();
    return clip;
}

Json jsonOf(const SweepPlan& plan) {
    Json json{{"eyrie_sweep", 1}, {"engine", plan.engine_version}};
    for (const SweepAxis& axis : plan.axes)
        json["parameters"].push_back({{"name", axis.name}, {"values", axis.values}});
    json["base"] = Json::object();
    for (const auto& [name, value] : plan.base) json["base"][name] = value;
    for (const SweepClip& clip : plan.clips) json["sequences"].push_back(jsonOf(clip));
    json["overlaps"] = plan.overlaps;
    json["vehicles_only"] = plan.vehicles_only;
    json["classes"] = wordOfScored(plan.one_class);
    json["border"] = plan.border ? Json(*plan.border) : Json();
    return json;
}

/// FNV-1a, 64 bit.
class Digest {
 public:
    void add(const void* data, std::size_t bytes) {
        const auto* at = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < bytes; ++i) state_ = (state_ ^ at[i]) * 1099511628211ULL;
    }
    template <class Number>
    void add(Number value) {
        add(&value, sizeof value);
    }
    std::string text() const {
        char out[20];
        std::snprintf(out, sizeof out, "%016llx", static_cast<unsigned long long>(state_));
        return out;
    }

 private:
    std::uint64_t state_ = 14695981039346656037ULL;
};

/// Plans of before classes were told apart name none.
std::optional<TrackClass> oneClassOf(const Json& json, const std::string& where) {
    try {
        return scoredClass(json.value("classes", "all"));
    } catch (const Error& error) {
        throw Error(ErrorKind::project, where + ": the plan of a sweep is damaged: " + error.what());
    }
}

}  // namespace

std::string textOf(const SweepPlan& plan) {
    return jsonOf(plan).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

SweepPlan planFrom(const std::string& text, const std::string& where) {
    try {
        const Json json = Json::parse(text);
        SweepPlan plan;
        if (json.at("eyrie_sweep").get<int>() != 1)
            throw Error(ErrorKind::project, where + ": the sweep was planned by a newer version of Eyrie");
        plan.engine_version = json.at("engine").get<std::string>();
        for (const Json& axis : json.at("parameters"))
            plan.axes.push_back(
                {axis.at("name").get<std::string>(), axis.at("values").get<std::vector<std::string>>()});
        for (const auto& [name, value] : json.at("base").items())
            plan.base.emplace_back(name, value.get<std::string>());
        for (const Json& clip : json.at("sequences")) plan.clips.push_back(clipOf(clip));
        plan.overlaps = json.at("overlaps").get<std::vector<double>>();
        plan.vehicles_only = json.at("vehicles_only").get<bool>();
        plan.one_class = oneClassOf(json, where);
        if (!json.at("border").is_null()) plan.border = json.at("border").get<double>();
        for (const SweepAxis& axis : plan.axes) {
            if (axis.values.empty()) throw Error(ErrorKind::project, where + ": " + axis.name + " has no values");
        }
        if (plan.axes.empty() || plan.clips.empty())
            throw Error(ErrorKind::project, where + ": the plan of a sweep names no parameter or no sequence");
        return plan;
    } catch (const Json::exception& error) {
        throw Error(ErrorKind::project, where + ": the plan of a sweep is damaged: " + error.what());
    }
}

std::string differenceOf(const SweepPlan& a, const SweepPlan& b) {
    if (a.engine_version != b.engine_version)
        return "they were made by different versions of Eyrie, " + a.engine_version + " and " + b.engine_version;
    if (a.axes.size() != b.axes.size()) return "one changes more parameters than the other";
    for (std::size_t i = 0; i < a.axes.size(); ++i) {
        if (a.axes[i].name != b.axes[i].name) return "one changes " + a.axes[i].name + ", the other " + b.axes[i].name;
        if (a.axes[i].values != b.axes[i].values) return "the values of " + a.axes[i].name + " differ";
    }
    if (a.base.size() != b.base.size()) return "they know different parameters";
    for (std::size_t i = 0; i < a.base.size(); ++i) {
        if (a.base[i] != b.base[i])
            return "the parameter " + a.base[i].first + " is " + a.base[i].second + " in one and " +
                   (a.base[i].first == b.base[i].first ? b.base[i].second : "not known") + " in the other";
    }
    if (a.clips.size() != b.clips.size()) return "they cover different numbers of sequences";
    for (std::size_t i = 0; i < a.clips.size(); ++i) {
        SweepClip here = a.clips[i];
        const SweepClip& there = b.clips[i];
        here.sequence = there.sequence;
        here.ground_truth = there.ground_truth;
        here.run = there.run;
        if (jsonOf(here) != jsonOf(there))
            return "sequence " + std::to_string(i + 1) + " (" + a.clips[i].sequence +
                   "), its scale or its ground truth differs";
    }
    if (a.overlaps != b.overlaps || a.vehicles_only != b.vehicles_only || a.one_class != b.one_class ||
        a.border != b.border)
        return "they are measured in different ways (overlaps, vehicles, classes, border)";
    return "";
}

std::string digestOf(const Frame& first_frame, const BoxesByFrame& truth) {
    Digest digest;
    for (int y = 0; y < first_frame.gray.rows; ++y)
        digest.add(first_frame.gray.ptr(y), static_cast<std::size_t>(first_frame.gray.cols));
    for (const auto& [frame, boxes] : truth) {
        digest.add(frame);
        for (const BoxRecord& record : boxes) {
            digest.add(record.id.value_or(-1));
            digest.add(record.box.centre.x);
            digest.add(record.box.centre.y);
            digest.add(record.box.length);
            digest.add(record.box.width);
            digest.add(record.box.heading);
            digest.add(record.ignore);
            digest.add(record.object_class.data(), record.object_class.size());
        }
    }
    return digest.text();
}

}  // namespace eyrie
