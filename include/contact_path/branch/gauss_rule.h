// Gauss-Legendre quadrature on [0, 1].
#ifndef CONTACT_PATH_BRANCH_GAUSS_RULE_H_
#define CONTACT_PATH_BRANCH_GAUSS_RULE_H_

#include <array>
#include <cstddef>

namespace contact_path {

// The integral of f is the sum of weights[i] f(points[i]): exact for polynomials up to the degree 2 N - 1.
template <std::size_t N>
struct GaussRule {
  std::array<double, N> points;
  std::array<double, N> weights;
};

inline constexpr GaussRule<4> kGauss4 = {
    {0.06943184420297371, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629},
    {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693}};
inline constexpr GaussRule<5> kGauss5 = {
    {0.046910077030668, 0.23076534494715845, 0.5, 0.76923465505284155, 0.953089922969332},
    {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324, 0.11846344252809454}};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_GAUSS_RULE_H_
