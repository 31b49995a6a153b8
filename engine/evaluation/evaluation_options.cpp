#include "evaluation/evaluation_options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"

namespace eyrie {

const char* nameOf(Convention convention) {
    return convention == Convention::thesis ? "thesis" : "trackeval";
}

const std::vector<std::string>& scoredClassWords() {
    // By the enumerators of TrackClass.
    static const std::vector<std::string> words{"all", "vehicles", "two_wheelers", "persons"};
    return words;
}

std::optional<TrackClass> scoredClass(const std::string& word) {
    const auto& words = scoredClassWords();
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) {
        throw Error(ErrorKind::parameter, "there is no class \"" + word +
                                              "\" to be measured; there are all, vehicles, two_wheelers and persons");
    }
    if (found == words.begin()) return std::nullopt;
    return static_cast<TrackClass>(found - words.begin());
}

std::string wordOfScored(const std::optional<TrackClass>& one_class) {
    return scoredClassWords()[static_cast<std::size_t>(one_class.value_or(TrackClass::unknown))];
}

std::string countedText(const EvaluationOptions& options) {
    if (!options.one_class) return options.vehicles_only ? ", vehicles only" : "";
    switch (*options.one_class) {
        case TrackClass::unknown:
            break;
        case TrackClass::vehicle:
            return ", vehicles only, without results of other classes";
        case TrackClass::two_wheeler:
            return ", two-wheelers only, without results of other classes";
        case TrackClass::person:
            return ", persons only, without results of other classes";
    }
    return "";
}

void check(const EvaluationOptions& options) {
    if (!(options.overlap > 0 && options.overlap <= 1)) {
        char given[32];
        std::snprintf(given, sizeof given, "%g", options.overlap);
        throw Error(ErrorKind::parameter,
                    "overlap = " + std::string(given) + ", expected more than 0 and at most 1, e.g. 0.3");
    }
    if (options.one_class == TrackClass::unknown) {
        throw Error(ErrorKind::parameter, "objects of unknown class cannot be measured alone; choose a class or all");
    }
    if (options.vehicles_only && options.one_class && options.one_class != TrackClass::vehicle) {
        throw Error(ErrorKind::parameter, "vehicles only, and " + wordOfScored(options.one_class) +
                                              " only: nothing counts; choose one of the two");
    }
    if (options.frame_count && *options.frame_count < 1) {
        throw Error(ErrorKind::parameter,
                    "frame count = " + std::to_string(*options.frame_count) + ", expected at least 1");
    }
    if (!options.border) return;
    if (!std::isfinite(*options.border)) {
        throw Error(ErrorKind::parameter, "border is not a number; expected px, such as 3");
    }
    if (options.image_size.width < 1 || options.image_size.height < 1) {
        throw Error(ErrorKind::parameter, "a border needs the size of the image: give it as WIDTHxHEIGHT");
    }
}

}  // namespace eyrie
