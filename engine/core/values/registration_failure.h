#pragma once

#include <string>

namespace eyrie {

/// Why a frame could not be registered onto the one before it.
enum class RegistrationFault {
    none,                 ///< it could
    too_few_corners,      ///< `count` in the picture before, of `of` that are needed
    no_match,             ///< the pictures do not fit to each other; this one shows too little to tell why
    cut,                  ///< the pictures do not fit to each other, and this one is clear: another scene
    too_few_found_again,  ///< `count` corners of `of`
    too_few_agree,        ///< `count` corners of the `of` that were found again have one motion in common
    impossible_motion     ///< not one that a camera makes
};

/// What a picture is worth for registration, judged by its corners.
enum class PictureQuality { clear, blurred, blank };

/// Why a frame could not be registered, with the figures that decided.
struct RegistrationFailure {
    RegistrationFault fault = RegistrationFault::none;
    PictureQuality picture = PictureQuality::clear;
    int count = 0;  ///< corners; 0 where the fault counts none
    int of = 0;     ///< of so many

    bool operator==(const RegistrationFailure&) const = default;
};

/// For people, without figures: "blurred picture: too few corners agree". Empty without a fault.
std::string nameOf(RegistrationFault fault, PictureQuality picture);

/// For people: "blurred picture: too few corners agree (12 of 40)". Empty without a fault.
std::string describe(const RegistrationFailure& failure);

/// The parameter that says how many corners are needed; empty where none were counted.
const char* parameterOf(const RegistrationFailure& failure);

}  // namespace eyrie
