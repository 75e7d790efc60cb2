// Verdicts on every increment against dense matrices: eigenvalues, and slips by enumeration.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "contact_path/path/model.h"
#include "contact_path/scene/expand.h"
#include "contact_path/tolerances.h"
#include "support/random.h"
#include "support/seeds.h"
#include "support/traced_path.h"

namespace contact_path::verdicts_test {
namespace {

std::string NameAt(int i, int j) { return "n" + std::to_string(i) + "_" + std::to_string(j); }

// An uneven lattice on a rough floor, held at its left edge above the floor, pressed down and drawn aside at its top.
TraceRequest LatticeOnFloor(unsigned seed) {
  Random random(seed);
  const auto one_of = [&](int from, int to) {
    return from + static_cast<int>(random.Number(0.0, 0.999) * (to - from + 1));
  };
  const int feet = one_of(1, 12), rows = one_of(2, seed % 4 == 0 ? 16 : 5);
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "lattice";
  for (int i = 0; i <= feet; ++i)
    for (int j = 0; j < rows; ++j) {
      const bool held = i == 0 && j > 0;
      scene.nodes.push_back(
          {NameAt(i, j), i + random.Number(-0.1, 0.1), j > 0 ? j + random.Number(-0.1, 0.1) : 0.0, held, held});
    }
  const double slender = std::pow(10.0, random.Number(-2.0, 0.0));  // of the diagonals
  for (int i = 0; i <= feet; ++i)
    for (int j = 0; j < rows; ++j)
      for (const auto& [right, up] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1), std::pair(1, -1)}) {
        if (i + right > feet || j + up < 0 || j + up >= rows) continue;
        if (j == 0 && right == 0 && random.Number(0.0, 1.0) < 0.7) continue;  // such a foot stands on oblique bars
        const double EA = std::pow(10.0, random.Number(-0.5, 0.5)) * (up != 0 && right != 0 ? slender : 1.0);
        scene.bars.push_back({{NameAt(i, j), NameAt(i + right, j + up)}, EA});
      }
  const double friction = seed % 7 == 0 ? 0.0 : random.Number(0.1, 3.0);
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction}};
  const double aside = random.Number(-3.0, 3.0);
  for (int i = 1; i <= feet; ++i) {
    scene.contacts.push_back({NameAt(i, 0), "floor"});
    scene.loads.push_back({NameAt(i, rows - 1), aside, -random.Number(0.2, 1.0), false});
  }
  request.options.max_increments = 40;
  return request;
}

// What the dense matrices say of a point.
struct Dense {
  bool decided = false;  // no eigenvalue is next to zero
  int n0 = 0;            // negative eigenvalues where all that touches sticks
  Eigen::MatrixXd H;
};

Dense DenseAt(const Model& model, const PathPoint& point) {
  Eigen::SparseMatrix<double> tangent = model.structure.TangentPattern();
  model.structure.Tangent(point.u, &tangent);
  const Eigen::MatrixXd K = tangent;
  std::vector<Eigen::Index> free;
  std::vector<bool> held(static_cast<std::size_t>(K.rows()), false);
  std::vector<Eigen::Index> feet;  // x of those that slide; y is the next one
  std::vector<double> senses;
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    if (StateOf(point, i) == ContactState::kOpen) continue;
    const int node = static_cast<int>(*model.index.FindNode(model.scene.contacts[i].node));
    const Eigen::Index x = model.structure.Dof(node, 0), y = model.structure.Dof(node, 1);
    held[static_cast<std::size_t>(y)] = true;
    if (!model.contacts[i]->Frictional()) continue;
    held[static_cast<std::size_t>(x)] = true;
    if (!Slips(StateOf(point, i))) continue;
    feet.push_back(x);
    senses.push_back(StateOf(point, i) == ContactState::kSlipPlus ? 1.0 : -1.0);
  }
  for (Eigen::Index k = 0; k < K.rows(); ++k)
    if (!held[static_cast<std::size_t>(k)]) free.push_back(k);
  Dense dense;
  const auto slips = static_cast<Eigen::Index>(feet.size());
  const Eigen::MatrixXd inner = K(free, free);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(inner, Eigen::EigenvaluesOnly);
  const Eigen::VectorXd sizes = solver.eigenvalues().cwiseAbs();
  dense.decided = sizes.minCoeff() > 1e-8 * sizes.maxCoeff();
  dense.n0 = static_cast<int>((solver.eigenvalues().array() < 0.0).count());
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(K.rows(), slips);
  for (Eigen::Index k = 0; k < slips; ++k)
    motions(feet[static_cast<std::size_t>(k)], k) = senses[static_cast<std::size_t>(k)];
  const Eigen::MatrixXd following = inner.fullPivLu().solve(-(K * motions)(free, Eigen::all));
  for (std::size_t k = 0; k < free.size(); ++k) motions.row(free[k]) = following.row(static_cast<Eigen::Index>(k));
  const Eigen::MatrixXd forces = K * motions;
  dense.H.resize(slips, slips);
  for (Eigen::Index k = 0; k < slips; ++k) {
    const Eigen::Index x = feet[static_cast<std::size_t>(k)];
    dense.H.row(k) =
        senses[static_cast<std::size_t>(k)] * forces.row(x) + model.scene.obstacles[0].friction * forces.row(x + 1);
  }
  return dense;
}

// Sum over the solutions of w = H z + q, 0 <= z, w, z . w = 0 of the signs of their determinants, by trying all sets;
// *near: whether one of them is next to not being one.
int DegreeBy(const Eigen::MatrixXd& H, const Eigen::VectorXd& q, bool* near) {
  int degree = 0;
  for (unsigned set = 0; set < (1U << H.rows()); ++set) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(H.rows(), H.rows());  // of z in the set, and w outside
    for (Eigen::Index k = 0; k < H.rows(); ++k)
      if ((set >> k & 1U) != 0) A.col(k) = -H.col(k);
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(A);
    const Eigen::VectorXd x = lu.solve(q);
    *near = *near || (x.cwiseAbs().minCoeff() < 1e-7 * x.cwiseAbs().maxCoeff());
    if (!(x.minCoeff() >= 0.0)) continue;
    const bool odd = __builtin_popcount(set) % 2 != 0;
    degree += (lu.determinant() < 0.0) == odd ? 1 : -1;
  }
  return degree;
}

TEST(Verdicts, AgainstDenseMatrices) {
  int without = 0, unstable = 0, stable = 0, lost = 0, not_proved = 0, most_slips = 0;
  for (unsigned seed = 1; seed <= Seeds(300); ++seed) {
    const TracedPath path = TraceIncrements(LatticeOnFloor(seed));
    const ExpandedRequest expanded(path.request);
    const Model model(expanded.Get().scene, CharacteristicScales(expanded.Get().scene));
    Random random(seed + 1000);
    for (const Increment& increment : path.increments) {
      if (increment.kind != IncrementKind::kRegular || !increment.event.branches.empty()) continue;
      // What touches without force is not held.
      if (std::any_of(increment.contacts.begin(), increment.contacts.end(), [&](const ContactRecord& contact) {
            return contact.state != ContactState::kOpen && contact.rn <= tolerances::kActive * model.scaling.force;
          }))
        continue;
      SCOPED_TRACE("seed " + std::to_string(seed) + ", increment " + std::to_string(increment.index));
      const Dense dense = DenseAt(model, model.FromIncrement(increment));
      if (!dense.decided) continue;
      const Verdict verdict = increment.stability.stability;
      const Eigen::Index slips = dense.H.rows();
      if (slips == 0) {
        EXPECT_EQ(increment.stability.unstable_directions, dense.n0);
        EXPECT_EQ(verdict, dense.n0 > 0 ? Verdict::kUnstable : Verdict::kStable);
        ++without;
        unstable += dense.n0 > 0 ? 1 : 0;
        continue;
      }
      most_slips = std::max(most_slips, static_cast<int>(slips));
      const Eigen::MatrixXd symmetric = 0.5 * (dense.H + dense.H.transpose());
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric, Eigen::EigenvaluesOnly);
      const double rounding = 1e-6 * symmetric.cwiseAbs().maxCoeff();
      const bool definite = dense.n0 == 0 && solver.eigenvalues()[0] > rounding;
      stable += verdict == Verdict::kStable ? 1 : 0;
      lost += verdict == Verdict::kUnstable ? 1 : 0;
      not_proved += verdict == Verdict::kNotProved ? 1 : 0;
      if (definite) {
        EXPECT_EQ(verdict, Verdict::kStable);
        continue;
      }
      bool near = false;
      const int degree = (dense.n0 % 2 == 0 ? 1 : -1) * DegreeBy(dense.H, random.Vector(slips, 0.1, 1.0), &near);
      if (!near && degree != 1) {
        EXPECT_EQ(verdict, Verdict::kUnstable) << degree;
      }
      if (verdict != Verdict::kStable) continue;
      EXPECT_EQ(dense.n0, 0);
      for (int trial = 0; trial < 100; ++trial) {
        const Eigen::VectorXd z = random.Vector(slips, -0.5, 1.0).cwiseMax(0.0);
        EXPECT_GE(z.dot(dense.H * z), -rounding * z.squaredNorm());
      }
    }
  }
  EXPECT_GT(without, AtLeast(1000));
  EXPECT_GT(unstable, AtLeast(40));
  EXPECT_GT(stable, AtLeast(1000));
  EXPECT_GT(lost, AtLeast(20));
  EXPECT_GE(most_slips, 6);
}

}  // namespace
}  // namespace contact_path::verdicts_test
