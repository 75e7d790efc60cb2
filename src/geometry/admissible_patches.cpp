#include "contact_path/geometry/admissible_patches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

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

}  // namespace contact_path
