#pragma once

#include <string>

namespace eyrie {

/// Our word for a MOTChallenge class number: 1 person … 3 car, 4 bicycle, 5 motorcycle, 6 vehicle; "other" for the rest
/// and empty for numbers below 1, which mean none.
std::string classFromMot(int number);

/// The number to write for one of our classes, the nearest where it has none of its own, and whether reading it back
/// gives the same class.
struct MotClass {
    int number = -1;
    bool exact = false;
};
MotClass motFromClass(const std::string& object_class);

}  // namespace eyrie
