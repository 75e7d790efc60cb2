#include "contact_path/equations/rigid_modes.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "contact_path/linear/generic_vector.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Triangular factor of rows that come one after another: the null space of all of them.
class RowSpace {
 public:
  explicit RowSpace(Eigen::Index columns)
      : r_(Eigen::MatrixXd::Zero(columns, columns)), end_(static_cast<std::size_t>(columns), 0) {}

  // By Givens rotations.
  void Add(Eigen::RowVectorXd row) {
    Eigen::Index end = row.size();  // from here on it is zero
    while (end > 0 && row[end - 1] == 0.0) --end;
    for (Eigen::Index j = 0; j < end; ++j) {
      if (row[j] == 0.0) continue;
      const double a = r_(j, j), b = row[j], norm = std::hypot(a, b), c = a / norm, s = b / norm;
      end = end_[static_cast<std::size_t>(j)] = std::max(end, end_[static_cast<std::size_t>(j)]);
      const Eigen::Index rest = end - j;  // before, both are zero
      const Eigen::RowVectorXd above = r_.row(j).segment(j, rest);
      r_.row(j).segment(j, rest) = c * above + s * row.segment(j, rest);
      row.segment(j, rest) = c * row.segment(j, rest) - s * above;
      row[j] = 0.0;
    }
  }

  // Orthonormal; directions that change a row by less than tolerances::kDependentColumn of the largest are in it.
  Eigen::MatrixXd NullSpace() const {
    if (IsFarFromSingular()) return Eigen::MatrixXd(r_.cols(), 0);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(Eigen::MatrixXd(r_.transpose()));
    qr.setThreshold(tolerances::kDependentColumn);
    const Eigen::MatrixXd q = qr.householderQ();
    return q.rightCols(r_.cols() - qr.rank());
  }

 private:
  // By the inverse power method: its smallest singular value, which no pivot is below.
  bool IsFarFromSingular() const {
    if (!(r_.diagonal().cwiseAbs().minCoeff() > 0.0)) return false;
    Eigen::VectorXd v = GenericVector(r_.cols()).normalized();
    double growth = 0.0;
    for (int i = 0; i < 3; ++i) {
      r_.triangularView<Eigen::Upper>().transpose().solveInPlace(v);
      r_.triangularView<Eigen::Upper>().solveInPlace(v);
      growth = v.norm();
      v /= growth;
    }
    return growth * r_.squaredNorm() < 1.0 / tolerances::kDependentColumn;
  }

  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> r_;
  std::vector<Eigen::Index> end_;  // by row: from here on it is zero
};

// Of each component, the part that it belongs to: the smallest number of a component of the part.
std::vector<int> PartsOf(const Structure& structure) {
  const std::vector<DofMap::Component>& components = structure.Dofs().Components();
  std::vector<int> owner(components.size());
  std::iota(owner.begin(), owner.end(), 0);
  const auto root = [&owner](int i) {
    while (owner[static_cast<std::size_t>(i)] != i) i = owner[static_cast<std::size_t>(i)];
    return i;
  };
  const auto join = [&](int a, int b) {
    a = root(a);
    b = root(b);
    owner[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  };
  structure.ForEachElement([&join](const std::vector<int>& element) {
    for (const int component : element) join(component, element.front());
  });
  // All that one node has belongs together.
  std::vector<int> first(components.size(), -1);
  for (std::size_t i = 0; i < components.size(); ++i) {
    int& of_node = first[static_cast<std::size_t>(components[i].node)];
    if (of_node < 0) of_node = static_cast<int>(i);
    join(static_cast<int>(i), of_node);
  }
  for (std::size_t i = 0; i < owner.size(); ++i) owner[i] = root(static_cast<int>(i));
  return owner;
}

// Motion of a component by a translation along x, along y, and a rotation about the middle.
Eigen::RowVector3d MotionOf(const DofMap::Component& component, const Eigen::Vector2d& from_middle) {
  if (component.field == Field::kRotation) return {0.0, 0.0, 1.0};
  if (component.component == 0) return {1.0, 0.0, -from_middle.y()};
  return {0.0, 1.0, from_middle.x()};
}

}  // namespace

RigidModes::RigidModes(const Structure& structure) : structure_(structure) {
  const std::vector<DofMap::Component>& components = structure.Dofs().Components();
  const std::vector<int> owner = PartsOf(structure);
  std::vector<std::vector<int>> members(components.size());
  for (std::size_t i = 0; i < owner.size(); ++i)
    members[static_cast<std::size_t>(owner[i])].push_back(static_cast<int>(i));
  // At a given load factor a support that moves holds as one that rests does.
  std::vector<bool> prescribed(static_cast<std::size_t>(structure.NumDofs()), false);
  for (const PrescribedDof& support : structure.PrescribedDofs())
    prescribed[static_cast<std::size_t>(support.dof)] = true;
  const Eigen::VectorXd values = structure.AllValues(structure.Start());
  for (const std::vector<int>& part : members) {
    RowSpace held(3);
    bool moves = false;
    const Eigen::MatrixX3d motions = MotionsOf(part, values);
    for (std::size_t k = 0; k < part.size(); ++k) {
      const int dof = components[static_cast<std::size_t>(part[k])].dof;
      const bool is_free = dof >= 0 && !prescribed[static_cast<std::size_t>(dof)];
      moves = moves || is_free;
      if (!is_free) held.Add(motions.row(static_cast<Eigen::Index>(k)));
    }
    if (moves && held.NullSpace().cols() > 0) loose_.push_back(part);
  }
}

Eigen::MatrixX3d RigidModes::MotionsOf(const std::vector<int>& part, const Eigen::VectorXd& values) const {
  const std::vector<DofMap::Component>& components = structure_.Dofs().Components();
  std::vector<Eigen::Vector2d> places;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const int i : part) {
    const int node = components[static_cast<std::size_t>(i)].node;
    places.emplace_back(values[structure_.Dofs().Index(node, Field::kPosition, 0)],
                        values[structure_.Dofs().Index(node, Field::kPosition, 1)]);
    middle += places.back();
  }
  middle /= static_cast<double>(places.size());
  Eigen::MatrixX3d motions(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t k = 0; k < places.size(); ++k)
    motions.row(static_cast<Eigen::Index>(k)) =
        MotionOf(components[static_cast<std::size_t>(part[k])], places[k] - middle);
  return motions;
}

Eigen::MatrixXd RigidModes::At(const Eigen::VectorXd& u, const Eigen::SparseMatrix<double>& transposed) const {
  const Eigen::Index unknowns = transposed.rows(), dofs = structure_.NumDofs();
  if (loose_.empty()) return Eigen::MatrixXd(unknowns, 0);
  const Eigen::VectorXd values = structure_.AllValues(u);
  // Which part moves an unknown, and how.
  std::vector<int> part_of(static_cast<std::size_t>(dofs), -1);
  Eigen::MatrixX3d motion = Eigen::MatrixX3d::Zero(dofs, 3);
  std::vector<RowSpace> resisted(loose_.size(), RowSpace(3));
  for (std::size_t p = 0; p < loose_.size(); ++p) {
    const Eigen::MatrixX3d motions = MotionsOf(loose_[p], values);
    for (std::size_t k = 0; k < loose_[p].size(); ++k) {
      const int dof = structure_.Dofs().Components()[static_cast<std::size_t>(loose_[p][k])].dof;
      if (dof < 0) {
        resisted[p].Add(motions.row(static_cast<Eigen::Index>(k)));
        continue;
      }
      part_of[static_cast<std::size_t>(dof)] = static_cast<int>(p);
      motion.row(dof) = motions.row(static_cast<Eigen::Index>(k));
    }
  }
  // What supports and the elements of a part resist by themselves, so that few motions are left to look at together.
  Eigen::SparseMatrix<double> tangent = structure_.TangentPattern();
  structure_.Tangent(u, &tangent);
  const auto row_of = [](const Eigen::RowVectorXd& sum, const Eigen::RowVectorXd& size) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(sum.size());
    const double largest = size.maxCoeff();
    for (Eigen::Index j = 0; j < sum.size(); ++j)
      if (std::abs(sum[j]) > tolerances::kDependentColumn * size[j]) row[j] = sum[j] / largest;
    return row;
  };
  for (Eigen::Index equation = 0; equation < dofs; ++equation) {
    const int p = part_of[static_cast<std::size_t>(equation)];
    if (p < 0) continue;
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(3), size = sum;
    for (Eigen::SparseMatrix<double>::InnerIterator it(tangent, equation); it; ++it) {
      sum += it.value() * motion.row(it.row());
      size += std::abs(it.value()) * motion.row(it.row()).cwiseAbs();
    }
    const Eigen::RowVectorXd row = row_of(sum, size);
    if (!row.isZero(0.0)) resisted[static_cast<std::size_t>(p)].Add(row);
  }
  std::vector<Eigen::MatrixXd> free;
  std::vector<Eigen::Index> first_free;
  Eigen::Index count = 0;
  for (const RowSpace& of_part : resisted) {
    free.push_back(of_part.NullSpace());
    first_free.push_back(count);
    count += free.back().cols();
  }
  if (count == 0) return Eigen::MatrixXd(unknowns, 0);
  // What laws, supports that move and curved surfaces resist.
  RowSpace together(count);
  for (Eigen::Index equation = 0; equation < transposed.cols(); ++equation) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(count), size = sum;
    double largest = 0.0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, equation); it && it.row() < dofs; ++it) {
      largest = std::max(largest, std::abs(it.value()));
      const int p = part_of[static_cast<std::size_t>(it.row())];
      if (p < 0) continue;
      const Eigen::MatrixXd& modes = free[static_cast<std::size_t>(p)];
      if (modes.cols() == 0) continue;
      const Eigen::RowVectorXd moves = motion.row(it.row()) * modes;
      const Eigen::Index at = first_free[static_cast<std::size_t>(p)];
      sum.segment(at, modes.cols()) += it.value() * moves;
      // Parts of a motion cancel where it is a rotation.
      size.segment(at, modes.cols()) += std::abs(it.value()) * (motion.row(it.row()).cwiseAbs() * modes.cwiseAbs());
    }
    // What is not free may have the rest of the equation, as across a boundary along which a part moves.
    if (size.maxCoeff() <= tolerances::kDependentColumn * largest) continue;
    const Eigen::RowVectorXd row = row_of(sum, size);
    if (!row.isZero(0.0)) together.Add(row);
  }
  const Eigen::MatrixXd combinations = together.NullSpace();
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(unknowns, combinations.cols());
  for (Eigen::Index dof = 0; dof < dofs; ++dof) {
    const int p = part_of[static_cast<std::size_t>(dof)];
    if (p < 0) continue;
    const Eigen::MatrixXd& of_part = free[static_cast<std::size_t>(p)];
    modes.row(dof) =
        motion.row(dof) * of_part * combinations.middleRows(first_free[static_cast<std::size_t>(p)], of_part.cols());
  }
  if (modes.cols() == 0) return modes;
  // A rotation of nodes in one place without rotations of their own is none.
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(modes);
  // The rounding of one is none, either: combinations have the length 1.
  if (qr.maxPivot() <= tolerances::kDependentColumn) return Eigen::MatrixXd(unknowns, 0);
  qr.setThreshold(tolerances::kDependentColumn);
  return qr.householderQ() * Eigen::MatrixXd::Identity(unknowns, qr.rank());
}

}  // namespace contact_path
