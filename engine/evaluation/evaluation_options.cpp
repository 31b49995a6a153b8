#include "evaluation/evaluation_options.h"

#include <cmath>
#include <string>

#include "core/error.h"

namespace eyrie {

const char* nameOf(Convention convention) {
    return convention == Convention::thesis ? "thesis" : "trackeval";
}

void check(const EvaluationOptions& options) {
    if (!(options.overlap > 0 && options.overlap <= 1)) {
        throw Error(ErrorKind::parameter,
                    "overlap = " + std::to_string(options.overlap) + ", expected more than 0 and at most 1");
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
