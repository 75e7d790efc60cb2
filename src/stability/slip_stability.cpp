#include "contact_path/stability/slip_stability.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <utility>

#include "contact_path/linear/generic_vector.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

using Set = unsigned;  // bit i: port i is in it

std::vector<int> Members(Set set) {
  std::vector<int> members;
  for (int i = 0; set >> i != 0; ++i)
    if ((set >> i & 1U) != 0) members.push_back(i);
  return members;
}

Eigen::MatrixXd Submatrix(const Eigen::MatrixXd& matrix, const std::vector<int>& rows,
                          const std::vector<int>& columns) {
  Eigen::MatrixXd part(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
  for (Eigen::Index i = 0; i < part.rows(); ++i)
    for (Eigen::Index j = 0; j < part.cols(); ++j)
      part(i, j) = matrix(rows[static_cast<std::size_t>(i)], columns[static_cast<std::size_t>(j)]);
  return part;
}

// Whether a matrix is positive definite by its symmetric part: then no motion among these ports grows.
bool IsDefinite(const Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd symmetric = 0.5 * (matrix + matrix.transpose());
  return symmetric.llt().info() == Eigen::Success;
}

Set All(const Eigen::MatrixXd& matrix) { return (Set{1} << matrix.rows()) - 1; }

// Turned so that its components are positive; nothing where they have both signs.
std::optional<Eigen::VectorXd> AsPositive(Eigen::VectorXd vector) {
  if (vector.sum() < 0.0) vector = -vector;
  if ((vector.array() < tolerances::kDependent).any()) return std::nullopt;
  return vector;
}

}  // namespace

bool IsStrictlyCopositive(const Eigen::MatrixXd& F) {
  const Eigen::MatrixXd symmetric = 0.5 * (F + F.transpose());
  const double level = tolerances::kDependent * symmetric.cwiseAbs().maxCoeff();
  const Eigen::MatrixXd lowered = symmetric - level * Eigen::MatrixXd::Identity(F.rows(), F.cols());
  if (IsDefinite(lowered)) return true;
  if (F.rows() > kMostSlips) return false;
  for (Set set = 1; set <= All(F); ++set) {
    const std::vector<int> members = Members(set);
    const Eigen::MatrixXd part = Submatrix(lowered, members, members);
    if (IsDefinite(part)) continue;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(part);
    for (Eigen::Index k = 0; k < solver.eigenvalues().size() && solver.eigenvalues()[k] <= 0.0; ++k)
      if (AsPositive(solver.eigenvectors().col(k))) return false;
  }
  return true;
}

std::optional<int> ComplementarityDegree(const Eigen::MatrixXd& H) {
  if (H.rows() > kMostSlips) return std::nullopt;
  const double size = H.cwiseAbs().maxCoeff();
  // Roots have no simple ratios, as numbers that a person writes have.
  const Eigen::VectorXd q = size * GenericVector(H.rows()).cwiseSqrt();
  int degree = 1;  // of no slip
  for (Set set = 1; set <= All(H); ++set) {
    const std::vector<int> members = Members(set), others = Members(All(H) & ~set);
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(Submatrix(H, members, members));
    const Eigen::VectorXd part = Submatrix(q, members, {0});
    const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
    if (!(pivots.minCoeff() > tolerances::kDependent * size)) {
      // Next to singular: harmless where no solution is near, since the null vector has both signs.
      if (AsPositive(lu.kernel().col(0))) return std::nullopt;
      continue;
    }
    const Eigen::VectorXd z = lu.solve(-part);
    if ((z.array() < 0.0).any()) continue;
    const Eigen::VectorXd w = Submatrix(H, others, members) * z + Submatrix(q, others, {0});
    if ((w.array() < 0.0).any()) continue;
    degree += lu.determinant() > 0.0 ? 1 : -1;
  }
  return degree;
}

std::vector<GrowingSlip> GrowingSlips(const Eigen::MatrixXd& H) {
  std::vector<GrowingSlip> growing;
  if (H.rows() == 0 || H.rows() > kMostSlips) return growing;
  const double level = tolerances::kDependent * H.cwiseAbs().maxCoeff();
  for (Set set = 1; set <= All(H); ++set) {
    const std::vector<int> members = Members(set), others = Members(All(H) & ~set);
    const Eigen::MatrixXd among = Submatrix(H, members, members);
    if (IsDefinite(among - level * Eigen::MatrixXd::Identity(among.rows(), among.cols()))) continue;
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(among);
    for (Eigen::Index k = 0; k < solver.eigenvalues().size(); ++k) {
      if (solver.eigenvalues()[k].real() > level || solver.eigenvalues()[k].imag() != 0.0) continue;
      const std::optional<Eigen::VectorXd> part = AsPositive(solver.eigenvectors().col(k).real());
      if (!part || ((Submatrix(H, others, members) * *part).array() < -level).any()) continue;
      GrowingSlip slip{-solver.eigenvalues()[k].real(), Eigen::VectorXd::Zero(H.rows())};
      for (std::size_t i = 0; i < members.size(); ++i) slip.z[members[i]] = (*part)[static_cast<Eigen::Index>(i)];
      growing.push_back(std::move(slip));
    }
  }
  return growing;
}

std::optional<int> CountGrowing(const Eigen::MatrixXd& H, const std::vector<GrowingSlip>& growing) {
  std::vector<int> members;
  for (Eigen::Index i = 0; i < H.rows(); ++i)
    for (const GrowingSlip& slip : growing)
      if (slip.z[i] > 0.0) {
        members.push_back(static_cast<int>(i));
        break;
      }
  if (members.empty()) return 0;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(Submatrix(H, members, members), false);
  const double level = tolerances::kDependent * H.cwiseAbs().maxCoeff();
  int count = 0;
  for (Eigen::Index k = 0; k < solver.eigenvalues().size(); ++k) {
    if (solver.eigenvalues()[k].real() > level) continue;
    if (solver.eigenvalues()[k].imag() != 0.0) return std::nullopt;
    ++count;
  }
  return count;
}

}  // namespace contact_path
