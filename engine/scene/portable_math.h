#pragma once

/// Elementary functions from sums and products alone. The C library's differ in the last bit between machines and
/// versions, which would show as different pixels for the same seed. Accurate to about 1e-13 for |x| < 1e4.
namespace eyrie::portable {

/// Of an angle in radians.
double sine(double radians);
double cosine(double radians);
double tangent(double radians);
/// Direction of (x, y) in (−π, π]; 0 for the origin.
double arcTangent(double y, double x);
/// e to the power of x.
double exponential(double x);

}  // namespace eyrie::portable
