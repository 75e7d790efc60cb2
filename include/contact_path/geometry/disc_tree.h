// A search for what is nearest to a point, among things each of which lies in a disc.
#ifndef CONTACT_PATH_GEOMETRY_DISC_TREE_H_
#define CONTACT_PATH_GEOMETRY_DISC_TREE_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace contact_path {

struct Disc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;
};

// A disc around each half of a sequence of discs, of each half of a half, and so on: neighbours in the sequence should
// be near to each other.
class DiscTree {
 public:
  DiscTree() = default;
  // leaves: the discs themselves, at least one.
  explicit DiscTree(const std::vector<Disc>& leaves);

  // Calls visit(leaf), by number, for each leaf that is no farther from x than *most, which visit may make smaller.
  // Near ones come first.
  template <typename Visit>
  void Search(const Eigen::Vector2d& x, const double* most, Visit visit) const {
    Search({0, 0, num_leaves_}, DistanceTo(x, 0), x, most, visit);
  }

 private:
  // The leaves from `begin` to before `end`; the discs of the first half follow its own, then those of the second half.
  struct Node {
    std::size_t disc, begin, end;

    std::size_t Middle() const { return begin + (end - begin) / 2; }
    Node First() const { return {disc + 1, begin, Middle()}; }
    Node Second() const { return {disc + 2 * (Middle() - begin), Middle(), end}; }
  };

  void Fill(const Node& node, const std::vector<Disc>& leaves);
  double DistanceTo(const Eigen::Vector2d& x, std::size_t disc) const {
    return (x - discs_[disc].centre).norm() - discs_[disc].radius;
  }

  template <typename Visit>
  void Search(const Node& node, double distance, const Eigen::Vector2d& x, const double* most, Visit& visit) const {
    if (distance > *most) return;
    if (node.end - node.begin == 1) {
      visit(node.begin);
      return;
    }
    const Node first = node.First(), second = node.Second();
    const double to_first = DistanceTo(x, first.disc), to_second = DistanceTo(x, second.disc);
    const bool in_order = to_first <= to_second;
    Search(in_order ? first : second, in_order ? to_first : to_second, x, most, visit);
    Search(in_order ? second : first, in_order ? to_second : to_first, x, most, visit);
  }

  std::size_t num_leaves_ = 0;
  std::vector<Disc> discs_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_DISC_TREE_H_
