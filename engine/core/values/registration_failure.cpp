#include "core/values/registration_failure.h"

namespace eyrie {
namespace {

const char* wordsOf(RegistrationFault fault) {
    switch (fault) {
        case RegistrationFault::none:
            break;
        case RegistrationFault::too_few_corners:
            return "too few corners";
        case RegistrationFault::no_match:
            return "the picture does not match the one before";
        case RegistrationFault::cut:
            return "cut: the picture does not match the one before";
        case RegistrationFault::too_few_found_again:
            return "too few corners tracked";
        case RegistrationFault::too_few_agree:
            return "too few corners agree";
        case RegistrationFault::impossible_motion:
            return "the motion found is impossible for a camera";
    }
    return "";
}

const char* wordsOf(PictureQuality picture) {
    switch (picture) {
        case PictureQuality::clear:
            break;
        case PictureQuality::blurred:
            return "blurred picture: ";
        case PictureQuality::blank:
            return "blank picture: ";
    }
    return "";
}

}  // namespace

std::string nameOf(RegistrationFault fault, PictureQuality picture) {
    if (fault == RegistrationFault::none) return {};
    return std::string(wordsOf(picture)) + wordsOf(fault);
}

std::string describe(const RegistrationFailure& failure) {
    std::string text = nameOf(failure.fault, failure.picture);
    if (failure.of > 0) text += " (" + std::to_string(failure.count) + " of " + std::to_string(failure.of) + ")";
    return text;
}

const char* parameterOf(const RegistrationFailure& failure) {
    return failure.of > 0 ? "registration.min_inliers" : "";
}

}  // namespace eyrie
