// Quintic polynomials on a step, and where they first fall below zero.
#ifndef CONTACT_PATH_BRANCH_POLYNOMIAL_H_
#define CONTACT_PATH_BRANCH_POLYNOMIAL_H_

#include <array>
#include <cstddef>
#include <optional>

#include "contact_path/equations/jet.h"

namespace contact_path {

// c[0] + c[1] t + ... + c[5] t^5.
using Quintic = std::array<double, 6>;

// The quintic on [0, length] with the given jets at its ends. length > 0.
Quintic HermiteQuintic(const Jet& start, const Jet& end, double length);

// Where the i-th of six points stands on [0, length]: both ends, and Chebyshev's points of the second kind between
// them.
double QuinticNode(std::size_t i, double length);

// The quintic with these values there. length > 0.
Quintic QuinticThrough(const std::array<double, 6>& values, double length);

double Evaluate(const Quintic& polynomial, double t);
Quintic Derivative(const Quintic& polynomial);  // c[5] = 0

// The smallest t in (0, length] from which on the polynomial is negative; nothing if it stays >= 0. A start within
// `tolerance` of zero is taken as exactly zero, so a polynomial that rises from there does not count; one that falls
// gives t = 0, unless it comes back without having left the tolerance. One that never leaves the tolerance is zero
// throughout and counts as holding.
std::optional<double> FirstNegative(const Quintic& polynomial, double length, double tolerance);

// All roots in (0, length], ascending; count in *count. Double roots may be left out.
std::array<double, 5> Roots(const Quintic& polynomial, double length, int* count);

// Smallest value on [0, length], and where.
double Minimum(const Quintic& polynomial, double length, double* where);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_POLYNOMIAL_H_
