#include "scene/portable_math.h"

#include <cmath>

#include "core/geometry/angle.h"

namespace eyrie::portable {
namespace {

/// sin and cos of |r| ≤ π/4 by their series.
double smallSine(double r) {
    const double square = r * r;
    double term = r;
    double sum = r;
    for (int n = 1; n <= 9; ++n) {
        term *= -square / ((2 * n) * (2 * n + 1));
        sum += term;
    }
    return sum;
}

double smallCosine(double r) {
    const double square = r * r;
    double term = 1;
    double sum = 1;
    for (int n = 1; n <= 9; ++n) {
        term *= -square / ((2 * n - 1) * (2 * n));
        sum += term;
    }
    return sum;
}

double smallArcTangent(double t) {
    const double square = t * t;
    double power = t;
    double sum = 0;
    for (int n = 0; n < 18; ++n) {
        sum += (n % 2 == 0 ? power : -power) / (2 * n + 1);
        power *= square;
    }
    return sum;
}

}  // namespace

double sine(double radians) {
    const double quarters = std::floor(radians / (kPi / 2) + 0.5);
    const double rest = radians - quarters * (kPi / 2);
    switch (static_cast<long long>(quarters) & 3) {
        case 0:
            return smallSine(rest);
        case 1:
            return smallCosine(rest);
        case 2:
            return -smallSine(rest);
        default:
            return -smallCosine(rest);
    }
}

double cosine(double radians) {
    return sine(radians + kPi / 2);
}

double tangent(double radians) {
    return sine(radians) / cosine(radians);
}

double arcTangent(double y, double x) {
    const double ax = std::abs(x);
    const double ay = std::abs(y);
    if (ax == 0 && ay == 0) return 0;
    const double ratio = ax > ay ? ay / ax : ax / ay;
    // tan(π/8) splits the octant so that the series converges within its terms.
    const double octant =
        ratio > 0.41421356 ? kPi / 4 + smallArcTangent((ratio - 1) / (ratio + 1)) : smallArcTangent(ratio);
    double angle = ax > ay ? octant : kPi / 2 - octant;
    if (x < 0) angle = kPi - angle;
    return y < 0 ? -angle : angle;
}

double exponential(double x) {
    const double halvings = std::floor(x / std::numbers::ln2 + 0.5);
    const double rest = x - halvings * std::numbers::ln2;
    double term = 1;
    double sum = 1;
    for (int n = 1; n <= 14; ++n) {
        term *= rest / n;
        sum += term;
    }
    return std::ldexp(sum, static_cast<int>(halvings));
}

}  // namespace eyrie::portable
