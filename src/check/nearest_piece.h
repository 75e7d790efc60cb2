// Which piece of a curve is nearest to a point.
#ifndef CONTACT_PATH_SRC_CHECK_NEAREST_PIECE_H_
#define CONTACT_PATH_SRC_CHECK_NEAREST_PIECE_H_

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "check/plane.h"

namespace contact_path::check {

// A circle that has a part of a curve within it.
struct Around {
  Vector centre;
  Real radius = 0.0L;
};

// Circles around the pieces of a curve, in the order of the curve; around each two neighbours, each two of these pairs,
// and so on, up to the whole curve.
class NearestPiece {
 public:
  NearestPiece() = default;
  explicit NearestPiece(std::vector<Around> pieces) {
    levels_.push_back(std::move(pieces));
    while (levels_.back().size() > 1) {
      const std::vector<Around>& last = levels_.back();
      std::vector<Around> pairs;
      for (std::size_t i = 0; i < last.size(); i += 2)
        pairs.push_back(i + 1 < last.size() ? Both(last[i], last[i + 1]) : last[i]);
      levels_.push_back(std::move(pairs));
    }
  }

  // distance(i): of x from the piece i. Calls it for each piece that may be the nearest, in any order.
  template <typename Distance>
  void Search(const Vector& x, Distance distance) const {
    Real nearest = std::numeric_limits<Real>::infinity();
    if (!levels_.empty()) Search(levels_.size() - 1, 0, x, &nearest, distance);
  }

 private:
  static Around Both(const Around& a, const Around& b) {
    const Vector centre = 0.5L * (a.centre + b.centre);
    return {centre, std::max(Length(a.centre - centre) + a.radius, Length(b.centre - centre) + b.radius)};
  }

  template <typename Distance>
  void Search(std::size_t level, std::size_t i, const Vector& x, Real* nearest, Distance& distance) const {
    if (level == 0) {
      *nearest = std::min(*nearest, distance(i));
      return;
    }
    const std::vector<Around>& below = levels_[level - 1];
    std::pair<Real, std::size_t> parts[2];
    std::size_t count = 0;
    for (std::size_t part = 2 * i; part < std::min(2 * i + 2, below.size()); ++part)
      parts[count++] = {Length(x - below[part].centre) - below[part].radius, part};
    if (count == 2 && parts[1] < parts[0]) std::swap(parts[0], parts[1]);
    for (std::size_t part = 0; part < count; ++part)
      if (!(parts[part].first > *nearest)) Search(level - 1, parts[part].second, x, nearest, distance);
  }

  std::vector<std::vector<Around>> levels_;  // from the pieces to one circle
};

}  // namespace contact_path::check

#endif  // CONTACT_PATH_SRC_CHECK_NEAREST_PIECE_H_
