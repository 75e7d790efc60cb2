// Ordering of a large system with a border.
#ifndef CONTACT_PATH_SRC_LINEAR_ORDERING_H_
#define CONTACT_PATH_SRC_LINEAR_ORDERING_H_

#include <Eigen/Core>
#include <map>
#include <memory>
#include <vector>

#include "contact_path/linear/frame.h"
#include "linear/umfpack_factors.h"

namespace contact_path {

// Where the row is largest, ascending: as many places as a border has.
std::vector<int> LargestPlaces(const Eigen::VectorXd& row);

// The entries of the row at these places.
Eigen::VectorXd EntriesAt(const std::vector<int>& places, const Eigen::VectorXd& row);

// Whether the entries of the row at these places make a border for it.
bool AreGoodPlaces(const std::vector<int>& places, const Eigen::VectorXd& row);

struct OrderedFactors;

// Of the pattern of a frame and a border.
struct Ordering {
  // row: in the frame.
  Ordering(const Frame& frame, std::vector<int> places_of_border, const Eigen::VectorXd& row);

  bool Suits(const Frame& frame) const;

  std::vector<int> places;  // of the border, ascending
  Eigen::VectorXd border;   // of the row for which they were chosen
  UmfpackAnalysis analysis;
  mutable std::vector<std::weak_ptr<OrderedFactors>> made;  // the newest last: for as long as solvers have them
};

// Factors of a matrix N = [J; border] with this ordering.
struct OrderedFactors {
  std::shared_ptr<const Ordering> ordering;
  Eigen::VectorXd values;  // of N, those of the border last
  Eigen::VectorXd along;   // N along = (0, 1)
  UmfpackFactors factors;  // of N, transposed
  // N x = e_k by the equation k: of those in which other matrices have differed.
  std::map<int, Eigen::VectorXd> moved;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_LINEAR_ORDERING_H_
