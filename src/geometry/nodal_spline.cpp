#include "contact_path/geometry/nodal_spline.h"

#include <cmath>
#include <cstddef>
#include <limits>

#include "contact_path/iterations.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kLeastBeside = 2;

// How many patches after that of the first node begin within a length. nodes: up or down the curve.
int BeginWithin(double length, const std::vector<Eigen::Vector2d>& nodes) {
  int count = 0;
  double walked = 0.0;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const double edge = (nodes[i] - nodes[i - 1]).norm();
    if (walked + 0.5 * edge > length) break;  // patches begin in the middles of edges
    walked += edge;
    ++count;
  }
  return count;
}

}  // namespace

AdmissiblePatches::AdmissiblePatches(const std::vector<Eigen::Vector2d>& nodes, bool closed, double radius, int node,
                                     const MirroredEnds& ends)
    : spline_(static_cast<int>(nodes.size()), closed, ends) {
  const int count = spline_.NumPatches();
  const double length = (1.0 + tolerances::kTouching) * M_PI * radius;
  // How many are left out in one sense, +1 or -1.
  const auto beside = [&](int sense) {
    const int end = sense > 0 ? count - 1 - node : node, most = closed ? count : end;
    std::vector<Eigen::Vector2d> walked;
    for (int i = 0; i <= most; ++i) walked.push_back(nodes[static_cast<std::size_t>(spline_.Within(node + sense * i))]);
    return std::min(std::max(BeginWithin(length, walked), kLeastBeside), most);
  };
  const int before = beside(-1);
  first_ = node - before;
  left_out_ = std::min(before + 1 + beside(1), count);
}

bool AdmissiblePatches::Has(int patch) const {
  if (spline_.Closed()) return spline_.Within(patch - first_) >= left_out_;
  return patch >= 0 && patch < spline_.NumPatches() && (patch < first_ || patch >= first_ + left_out_);
}

int AdmissiblePatches::Beside(int patch) const {
  if (Has(patch)) return patch;
  if (Has(patch - 1)) return patch - 1;
  return Has(patch + 1) ? patch + 1 : patch;
}

SplinePatch AdmissiblePatches::Patch(int patch) const {
  const int beside = Beside(patch);
  SplinePatch prolonged = spline_.Patch(beside);
  if (beside < patch) {
    prolonged.begin = prolonged.end;
    prolonged.end = std::numeric_limits<double>::infinity();
  } else if (beside > patch) {
    prolonged.end = prolonged.begin;
    prolonged.begin = -std::numeric_limits<double>::infinity();
  }
  return prolonged;
}

int NodalSpline::Within(int patch) const {
  if (!closed_) return std::clamp(patch, 0, nodes_ - 1);
  const int within = patch % nodes_;
  return within < 0 ? within + nodes_ : within;
}

SplinePatch NodalSpline::Patch(int patch) const {
  const int i = Within(patch);
  SplinePatch result;
  if (i == 0 && ends_.first) {
    // tau from the axis.
    result.nodes = {nodes_, 0, 1};
    result.weights << 0.125, -0.5, 0.5, 0.75, 0.0, -1.0, 0.125, 0.5, 0.5;
    result.end = 0.5;
    return result;
  }
  const bool mirrored = i == nodes_ - 1 && ends_.last;
  if (!closed_ && !mirrored && (i == 0 || i == nodes_ - 1)) {
    // Half of the edge between two nodes, tau from its beginning.
    const bool first = i == 0;
    result.nodes = {first ? 0 : i - 1, first ? 1 : i, -1};
    result.weights.topLeftCorner<2, 2>() << (first ? 1.0 : 0.5), -1.0, (first ? 0.0 : 0.5), 1.0;
    result.knot = first ? 0.0 : i - 0.5;
    result.end = 0.5;
    return result;
  }
  result.nodes = {Within(i - 1), i, mirrored ? nodes_ + 1 : Within(i + 1)};
  result.weights << 0.5, -1.0, 0.5, 0.5, 1.0, -1.0, 0.0, 0.0, 0.5;
  result.knot = (closed_ ? patch : i) - 0.5;
  result.end = mirrored ? 0.5 : 1.0;
  return result;
}

Parabola::Parabola(const SplinePatch& patch, const std::array<Eigen::Vector2d, 3>& places)
    : a(Eigen::Vector2d::Zero()), b(Eigen::Vector2d::Zero()), c(Eigen::Vector2d::Zero()) {
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (patch.nodes[k] < 0) continue;
    const auto row = static_cast<Eigen::Index>(k);
    a += patch.weights(row, 0) * places[k];
    b += patch.weights(row, 1) * places[k];
    c += patch.weights(row, 2) * places[k];
  }
}

// The slope of half the square of the distance is -f, f = (x - y) . y' a cubic whose leading coefficient is not
// positive. There is one minimum on each part of the line where f falls: on the whole line, or before and after the
// places where f' is zero.
double Parabola::FootOf(const Eigen::Vector2d& x, double begin, double end) const {
  const Eigen::Vector2d d = x - a;
  const double f0 = d.dot(b), f1 = 2.0 * d.dot(c) - b.dot(b), f2 = -3.0 * b.dot(c), f3 = -2.0 * c.dot(c);
  const auto f = [&](double tau) { return f0 + tau * (f1 + tau * (f2 + tau * f3)); };
  const auto slope = [&](double tau) { return f1 + tau * (2.0 * f2 + 3.0 * tau * f3); };
  double foot = 0.0, outside = std::numeric_limits<double>::infinity(), square = outside;
  const auto consider = [&](double tau) {
    double previous = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kMostIterations; ++i) {
      const double move = -f(tau) / slope(tau), size = std::abs(move);
      tau += move;
      if (!(size > tolerances::kLastDigits) || (size < tolerances::kEqual * (1.0 + std::abs(tau)) && size >= previous))
        break;
      previous = size;
    }
    const double beyond = std::max(std::max(begin - tau, tau - end), 0.0), away = (x - At(tau)).squaredNorm();
    if (!(beyond < outside || (beyond == outside && away < square))) return;
    foot = tau;
    outside = beyond;
    square = away;
  };
  const double middle = std::isinf(begin) ? end : std::isinf(end) ? begin : 0.5 * (begin + end);
  const double bends = f2 * f2 - 3.0 * f3 * f1;
  if (!(f3 < 0.0) || !(bends > 0.0)) {
    consider(middle);
    return foot;
  }
  // f' = 0 at (-f2 +- sqrt(bends)) / (3 f3), f3 < 0.
  const double root = std::sqrt(bends), before = (-f2 + root) / (3.0 * f3), after = (-f2 - root) / (3.0 * f3);
  // Newton's method from a place where f falls stays there. Next to an end of such a part it would begin with a leap.
  const double margin = 0.25 * (after - before);
  if (!(f(before) > 0.0)) consider(std::min(middle, before - margin));
  if (!(f(after) < 0.0)) consider(std::max(middle, after + margin));
  return foot;
}

}  // namespace contact_path
