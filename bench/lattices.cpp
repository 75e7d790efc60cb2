#include "lattices.h"

#include <algorithm>
#include <cmath>

#include "contact_path/equations/fixed_state_system.h"

namespace contact_path {
namespace {

constexpr Eigen::Index kFewEntries = 64;

}  // namespace

TraceRequest WallOf(int dofs, int far_candidates) {
  LatticeOptions options;
  options.kind = LatticeKind::kWall;
  const double nodes = 0.5 * dofs;
  options.rows = std::max(2, static_cast<int>(std::lround(std::sqrt(nodes / 5.0))) - 1);
  options.columns = static_cast<int>(std::lround(nodes / (options.rows + 1)));
  options.contacts = std::min(options.columns, std::max(1, dofs / 200));
  options.far_candidates = far_candidates;
  return LatticeRequest(options);
}

TraceRequest BlockOf(int dofs, int contacts, double gap) {
  LatticeOptions options;
  options.kind = LatticeKind::kBlock;
  options.rows = std::max(2, static_cast<int>(std::lround(std::sqrt(0.5 * dofs))) - 1);
  options.columns = options.rows + 1;
  options.contacts = contacts;
  TraceRequest request = LatticeRequest(options);
  request.scene.obstacles.front().py = -gap;
  return request;
}

Eigen::SparseMatrix<double> BorderedMatrix(const Model& model, ContactState state) {
  FixedStateSystem system(model.structure, model.contacts);
  const std::vector<ContactState> states(model.contacts.size(), state);
  system.SetStates(states, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(states.size())));
  PathPoint point = model.InitialPoint();
  // Away from the stress-free state, as along a path.
  for (Eigen::Index i = 0; i < point.u.size(); ++i) point.u[i] += 1e-3 * std::sin(1.7 * static_cast<double>(i));
  const Eigen::SparseMatrix<double> transposed = system.TransposedJacobian(system.Pack(point));
  std::vector<Eigen::Triplet<double>> triplets;
  for (Eigen::Index k = 0; k < transposed.outerSize(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, k); it; ++it)
      triplets.emplace_back(it.row(), it.col(), it.value());
  for (Eigen::Index i = 0; i <= system.NumDofs(); i += 1 + system.NumDofs() / kFewEntries)
    triplets.emplace_back(i, transposed.cols(), std::cos(static_cast<double>(i)));
  Eigen::SparseMatrix<double> matrix(transposed.rows(), transposed.cols() + 1);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  matrix.makeCompressed();
  return matrix;
}

}  // namespace contact_path
