// A search for the part that is nearest to a point, among parts each of which lies in a capsule.
#ifndef CONTACT_PATH_GEOMETRY_CAPSULE_TREE_H_
#define CONTACT_PATH_GEOMETRY_CAPSULE_TREE_H_

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "contact_path/tolerances.h"

namespace contact_path {

// The points that are no farther than the radius from a straight line between two points, which may be the same one.
struct Capsule {
  Eigen::Vector2d begin = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  double radius = 0.0;
};

// A capsule around each half of a sequence of capsules, of each half of a half, and so on: neighbours in the sequence
// should be near to each other. Where they follow a smooth curve, capsules are about as thin as an arc is high.
class CapsuleTree {
 public:
  CapsuleTree() = default;
  // leaves: the capsules themselves, at least one.
  explicit CapsuleTree(const std::vector<Capsule>& leaves);

  // Calls visit(leaf), by number, for each leaf that is no farther from x than *most, which visit may make smaller.
  // Near ones come first.
  template <typename Visit>
  void Search(const Eigen::Vector2d& x, const double* most, Visit visit) const {
    Search({0, 0, num_leaves_}, parts_[0].SquaredDistance(x), x, most, visit);
  }
  // Search() that visits the leaf `first` first: takes half the time where `first` is the nearest leaf.
  template <typename Visit>
  void SearchFrom(std::size_t first, const Eigen::Vector2d& x, const double* most, Visit visit) const {
    visit(first);
    Node node = {0, 0, num_leaves_};
    while (node.end - node.begin > 1) {
      const bool in_first = first < node.Middle();
      const Node aside = in_first ? node.Second() : node.First();
      Search(aside, parts_[aside.capsule].SquaredDistance(x), x, most, visit);
      node = in_first ? node.First() : node.Second();
    }
  }

 private:
  // The leaves from `begin` to before `end`. The capsule of the node comes first, then the capsules of the first half,
  // then the capsules of the second half.
  struct Node {
    std::size_t capsule, begin, end;

    std::size_t Middle() const { return begin + (end - begin) / 2; }
    Node First() const { return {capsule + 1, begin, Middle()}; }
    Node Second() const { return {capsule + 2 * (Middle() - begin), Middle(), end}; }
  };
  struct Part {
    Eigen::Vector2d begin, along;
    double radius;
    double factor;  // 1 / |along|^2; 0 where that is no number

    // From the line.
    double SquaredDistance(const Eigen::Vector2d& x) const {
      const Eigen::Vector2d away = x - begin;
      const double share = std::min(std::max(factor * along.dot(away), 0.0), 1.0);
      return (away - share * along).squaredNorm();
    }
  };

  Capsule Fill(const Node& node, const std::vector<Capsule>& leaves);
  // square: of the distance from the line of the node. Squares spare roots, in which most of the time would go.
  template <typename Visit>
  void Search(const Node& node, double square, const Eigen::Vector2d& x, const double* most, Visit& visit) const {
    const double reach = *most + parts_[node.capsule].radius;
    if ((1.0 - tolerances::kEqual) * square > reach * reach) return;
    if (node.end - node.begin == 1) {
      visit(node.begin);
      return;
    }
    const Node first = node.First(), second = node.Second();
    const double to_first = parts_[first.capsule].SquaredDistance(x);
    const double to_second = parts_[second.capsule].SquaredDistance(x);
    const bool in_order = to_first <= to_second;
    Search(in_order ? first : second, in_order ? to_first : to_second, x, most, visit);
    Search(in_order ? second : first, in_order ? to_second : to_first, x, most, visit);
  }

  std::size_t num_leaves_ = 0;
  std::vector<Part> parts_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_CAPSULE_TREE_H_
