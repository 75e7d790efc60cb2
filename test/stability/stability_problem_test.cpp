#include "contact_path/stability/stability_problem.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <string>
#include <vector>

#include "contact_path/path/model.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/scaling.h"
#include "support/random.h"
#include "support/random_scene.h"
#include "support/seeds.h"

namespace contact_path::stability_problem_test {
namespace {

// Nodes on floors, and free nodes, in one linear part of this stiffness, by x0, y0, x1, ...
Scene LinearScene(const Eigen::MatrixXd& stiffness, std::size_t on_floor, double friction) {
  Scene scene;
  scene.name = "linear";
  Superelement part;
  const auto nodes = static_cast<std::size_t>(stiffness.rows() / 2);
  for (std::size_t i = 0; i < nodes; ++i) {
    part.nodes.push_back("n" + std::to_string(i));
    scene.nodes.push_back({part.nodes.back(), static_cast<double>(i)});
  }
  for (Eigen::Index i = 0; i < stiffness.rows(); ++i)
    for (Eigen::Index j = 0; j < stiffness.cols(); ++j) part.stiffness.push_back(stiffness(i, j));
  scene.superelements = {part};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction}};
  for (std::size_t i = 0; i < on_floor; ++i) scene.contacts.push_back({scene.nodes[i].name, "floor"});
  scene.loads = {{scene.nodes.back().name, 1.0}};
  return scene;
}

constexpr Scaling kUnscaled = {};
constexpr double kGrown = 30.0;  // times the disturbance: it grows

// All contacts slide towards +x under a pressure of 1.
PathPoint Sliding(const Model& model, double friction) {
  PathPoint point = model.InitialPoint();
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    SetReaction(i, 1.0, -friction, &point);
    point.modes[i].state = NumberOf(ContactState::kSlipPlus);
  }
  return point;
}

Stability SlidingVerdict(const Eigen::MatrixXd& stiffness, std::size_t on_floor, double friction, double compliance) {
  const Model model(LinearScene(stiffness, on_floor, friction), kUnscaled);
  StabilityProblem problem(model.structure, model.laws);
  problem.Set(Sliding(model, friction), {});
  return problem.Under(compliance);
}

// Nodes' x before their y.
Eigen::MatrixXd Interleave(const Eigen::MatrixXd& tt, const Eigen::MatrixXd& nt, const Eigen::MatrixXd& nn) {
  const Eigen::Index n = tt.rows();
  Eigen::MatrixXd K(2 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      K(2 * i, 2 * j) = tt(i, j);
      K(2 * i + 1, 2 * j) = nt(i, j);
      K(2 * i, 2 * j + 1) = nt(j, i);
      K(2 * i + 1, 2 * j + 1) = nn(i, j);
    }
  return K;
}

Eigen::MatrixXd Matrix2(double a, double b, double c, double d) {
  Eigen::MatrixXd matrix(2, 2);
  matrix << a, b, c, d;
  return matrix;
}

TEST(StabilityProblemTest, OneContactUnderMachines) {
  const Eigen::MatrixXd K = Matrix2(1.0, -1.5, -1.5, 4.0);
  EXPECT_EQ(SlidingVerdict(K, 1, 1.0, INFINITY).verdict, Verdict::kUnstable);
  EXPECT_EQ(SlidingVerdict(K, 1, 1.0, INFINITY).directions, 1);
  EXPECT_EQ(SlidingVerdict(K, 1, 1.0, 1.0 / 0.49).verdict, Verdict::kUnstable);
  EXPECT_EQ(SlidingVerdict(K, 1, 1.0, 1.0 / 0.51).verdict, Verdict::kStable);
  EXPECT_EQ(SlidingVerdict(K, 1, 1.0, 0.0).verdict, Verdict::kStable);
  EXPECT_EQ(SlidingVerdict(K, 1, 0.66, INFINITY).verdict, Verdict::kStable);
  EXPECT_EQ(SlidingVerdict(K, 1, 0.67, INFINITY).verdict, Verdict::kUnstable);
}

TEST(StabilityProblemTest, TwoContacts) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(2, 2);
  const Stability apart = SlidingVerdict(Interleave(one, Matrix2(-1.5, 0.0, 0.0, -1.5), 4.0 * one), 2, 1.0, INFINITY);
  EXPECT_EQ(apart.verdict, Verdict::kUnstable);
  EXPECT_EQ(apart.directions, 2);
  const Stability together =
      SlidingVerdict(Interleave(one, Matrix2(0.0, -1.5, -1.5, 0.0), 4.0 * one), 2, 1.0, INFINITY);
  EXPECT_EQ(together.verdict, Verdict::kUnstable);
  const Stability holds = SlidingVerdict(Interleave(one, Matrix2(0.0, -5.0, 1.0, 0.0), 30.0 * one), 2, 1.0, INFINITY);
  EXPECT_NE(holds.verdict, Verdict::kUnstable);
}

// A bar at 60 degrees from a head that is guided along y to a foot that slides outwards, with a spring beside it: no
// slip of the foot strains the bar under a dead load, H = 0.05. Behind a head that a machine of stiffness k holds, it
// has the stiffness c = k / (k + 0.75), and H = 0.05 + c (0.25 - 0.433).
TEST(StabilityProblemTest, WhatADeadLoadHoldsAMachineNeedNot) {
  const Eigen::Vector2d along(0.5, -std::sqrt(0.75));
  Eigen::MatrixXd K(4, 4);
  K << along * along.transpose(), -along * along.transpose(), -along * along.transpose(), along * along.transpose();
  K(0, 0) += 0.05;
  Scene scene = LinearScene(K, 1, 1.0);
  scene.nodes[1].fixed_x = true;
  scene.loads = {{"n1", 0.0, -1.0}};
  const Model model(scene, kUnscaled);
  StabilityProblem problem(model.structure, model.laws);
  problem.Set(Sliding(model, 1.0), {});
  EXPECT_EQ(problem.Under(INFINITY).verdict, Verdict::kStable);
  EXPECT_EQ(problem.Under(0.0).verdict, Verdict::kUnstable);
  const double share = 0.05 / (std::sqrt(0.1875) - 0.25), k = 0.75 * share / (1.0 - share);
  EXPECT_EQ(problem.Under(1.0 / (0.999 * k)).verdict, Verdict::kStable);
  EXPECT_EQ(problem.Under(1.0 / (1.001 * k)).verdict, Verdict::kUnstable);
}

// The load acts on a node that nothing else holds along it: neutral under a dead load.
TEST(StabilityProblemTest, WhatAMachineAloneHolds) {
  for (const double stiffness : {-1e3, -1.0, -1e-3, 1e-3, 1.0, 1e3}) {
    // Of the loaded node along y; of another one; of one that slides.
    for (const int of : {0, 1, 2}) {
      Eigen::MatrixXd K = Eigen::MatrixXd::Zero(4, 4);
      K.diagonal() << 1.0, 1.0, 0.0, 1.0;
      K(of == 0 ? 3 : of == 1 ? 1 : 0, of == 0 ? 3 : of == 1 ? 1 : 0) = stiffness;
      const Model model(LinearScene(K, of == 2 ? 1 : 0, 0.5), kUnscaled);
      StabilityProblem problem(model.structure, model.laws);
      problem.Set(of == 2 ? Sliding(model, 0.5) : model.InitialPoint(), {});
      EXPECT_EQ(problem.Under(INFINITY).verdict, Verdict::kNotProved) << stiffness << of;
      for (const double compliance : {0.0, 1e-3, 1.0, 1e3}) {
        const Stability found = problem.Under(compliance);
        EXPECT_EQ(found.verdict, stiffness > 0.0 ? Verdict::kStable : Verdict::kUnstable) << stiffness << of;
        EXPECT_EQ(found.directions, stiffness > 0.0 ? 0 : 1) << stiffness << of;
      }
    }
  }
  // It does not hold two such nodes.
  const Model model(LinearScene(Eigen::Vector4d(0.0, 1.0, 0.0, 1.0).asDiagonal(), 0, 0.0), kUnscaled);
  StabilityProblem problem(model.structure, model.laws);
  problem.Set(model.InitialPoint(), {});
  EXPECT_EQ(problem.Under(1.0).verdict, Verdict::kNotProved);
}

// Contacts that stick or are open, some of them on what is held already: the dense eigenvalues of what is free tell.
TEST(StabilityProblemTest, CountsAgainstEigenvalues) {
  int unstable = 0, with_direction = 0, compared = 0;
  for (unsigned seed = 1; seed <= 400 && compared < 200; ++seed) {
    const TraceRequest request = RandomRequest(seed);
    const ExpandedRequest expanded(request);
    const Scene& scene = expanded.Get().scene;
    const Model model(scene, kUnscaled);
    Random random(seed);
    PathPoint point = model.InitialPoint();
    point.u += random.Vector(point.u.size(), -0.6, 0.6);
    std::vector<bool> held(static_cast<std::size_t>(point.u.size()), false);
    for (std::size_t i = 0; i < model.contacts.size(); ++i) {
      const std::size_t node = *model.index.FindNode(scene.contacts[i].node);
      const bool sticks = random.Number(0.0, 1.0) < 0.5 && model.contacts[i]->Frictional();
      point.modes[i].state = NumberOf(sticks ? ContactState::kStick : ContactState::kOpen);
      SetReaction(i, sticks ? 1.0 : 0.0, TangentialReaction(point, i), &point);
      if (!sticks) continue;
      for (const int axis : {0, 1})
        if (const int dof = model.structure.Dof(static_cast<int>(node), axis); dof >= 0)
          held[static_cast<std::size_t>(dof)] = true;
    }
    if (!model.structure.PrescribedDofs().empty()) continue;
    Eigen::SparseMatrix<double> tangent = model.structure.TangentPattern();
    model.structure.Tangent(point.u, &tangent);
    std::vector<Eigen::Index> free;
    for (std::size_t k = 0; k < held.size(); ++k)
      if (!held[k]) free.push_back(static_cast<Eigen::Index>(k));
    const auto n = static_cast<Eigen::Index>(free.size());
    Eigen::MatrixXd K(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        K(i, j) = tangent.coeff(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]);
    if (n == 0 || !K.allFinite()) continue;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(K);
    if (!(solver.eigenvalues().cwiseAbs().minCoeff() > 1e-8 * solver.eigenvalues().cwiseAbs().maxCoeff())) continue;
    const auto negative = static_cast<int>((solver.eigenvalues().array() < 0.0).count());
    StabilityProblem problem(model.structure, model.laws);
    problem.Set(point, {});
    const Stability found = problem.Under(INFINITY);
    EXPECT_EQ(found.directions, negative) << seed;
    EXPECT_EQ(found.verdict, negative > 0 ? Verdict::kUnstable : Verdict::kStable) << seed;
    if (found.direction.size() > 0) {
      EXPECT_LT(found.direction.dot(tangent * found.direction), 0.0) << seed;
    }
    unstable += negative > 0 ? 1 : 0;
    with_direction += found.direction.size() > 0 ? 1 : 0;
    ++compared;
  }
  EXPECT_EQ(compared, 200);
  EXPECT_GT(unstable, 40);
  EXPECT_GE(with_direction, 0.95 * unstable);  // a mode far from the softest ones may be missed
}

// The linear motion of nodes with masses m and drags c, equal in x and y, of which the first `contacts` slide on a
// floor towards +x under a pressure, by implicit Euler. Contacts at rest hold as long as their cones allow it.
class Motion {
 public:
  Motion(const Eigen::MatrixXd& K, Eigen::Index contacts, double friction, const Eigen::VectorXd& m,
         const Eigen::VectorXd& c, double h)
      : contacts_(contacts), friction_(friction), mass_(m / (h * h)), drag_(c / h) {
    dynamic_ = K;
    dynamic_.diagonal() += mass_ + drag_;
    // Unknowns: slips of the contacts first, then what is free.
    for (Eigen::Index i = 0; i < contacts; ++i) free_.push_back(2 * i);
    for (Eigen::Index i = 2 * contacts; i < K.rows(); ++i) free_.push_back(i);
    n_ = static_cast<Eigen::Index>(free_.size());
  }

  // Whether |v| has grown at the end of these steps.
  double Growth(Eigen::VectorXd v, int steps) const {
    Eigen::VectorXd before = v;
    const double first = v.norm();
    for (int step = 0; step < steps; ++step) {
      const Eigen::VectorXd next = Next(v, before);
      if (next.size() == 0) return -1.0;
      before = v;
      v = next;
      if (v.norm() > kGrown * first || (v - before).norm() <= 1e-12 * v.norm()) break;
    }
    return v.norm() / first;
  }

 private:
  // K v - forces: the slip since rest is v itself, in steps w is by the step's slip. Tries all sets of contacts.
  Eigen::VectorXd Next(const Eigen::VectorXd& v, const Eigen::VectorXd& before) const {
    const Eigen::VectorXd right = mass_.cwiseProduct(2.0 * v - before) + drag_.cwiseProduct(v);
    for (unsigned set = 0; set < (1U << contacts_); ++set) {
      // Equations: equilibrium along x of contacts that slip, v_x kept of those that do not, equilibrium of the rest.
      Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n_, n_);
      Eigen::VectorXd b(n_);
      for (Eigen::Index r = 0; r < n_; ++r) {
        const Eigen::Index dof = free_[static_cast<std::size_t>(r)];
        const bool contact = r < contacts_;
        if (contact && (set >> r & 1U) == 0) {
          A(r, r) = 1.0;
          b[r] = v[dof];
          continue;
        }
        for (Eigen::Index k = 0; k < n_; ++k) {
          A(r, k) = dynamic_(dof, free_[static_cast<std::size_t>(k)]);
          if (contact) A(r, k) += friction_ * dynamic_(dof + 1, free_[static_cast<std::size_t>(k)]);
        }
        b[r] = right[dof];
      }
      const Eigen::VectorXd x = A.fullPivLu().solve(b);
      Eigen::VectorXd next = Eigen::VectorXd::Zero(v.size());
      for (Eigen::Index k = 0; k < n_; ++k) next[free_[static_cast<std::size_t>(k)]] = x[k];
      const Eigen::VectorXd force = dynamic_ * next - right;  // reactions' changes
      bool sound = x.allFinite();
      for (Eigen::Index i = 0; i < contacts_ && sound; ++i) {
        const double slip = next[2 * i] - v[2 * i], w = force[2 * i] + friction_ * force[2 * i + 1];
        sound = (set >> i & 1U) != 0 ? slip >= -1e-12 * next.norm() : w >= -1e-12 * (next.norm() + right.norm());
      }
      if (sound) return next;
    }
    return {};
  }

  Eigen::Index contacts_, n_;
  double friction_;
  Eigen::VectorXd mass_, drag_;
  Eigen::MatrixXd dynamic_;
  std::vector<Eigen::Index> free_;
};

TEST(StabilityProblemTest, VerdictsAgainstRandomMotions) {
  int stable = 0, unstable = 0, not_proved = 0;
  for (unsigned seed = 1; seed <= Seeds(200); ++seed) {
    Random random(seed);
    const auto contacts = static_cast<Eigen::Index>(1 + seed % 3);
    const Eigen::Index nodes = contacts + static_cast<Eigen::Index>(seed % 2);
    Eigen::MatrixXd B(2 * nodes, 2 * nodes);
    for (Eigen::Index j = 0; j < B.cols(); ++j) B.col(j) = random.Vector(B.rows(), -1.0, 1.0);
    Eigen::MatrixXd K = B * B.transpose() + 0.1 * Eigen::MatrixXd::Identity(B.rows(), B.rows());
    const double friction = random.Number(0.1, 3.0);
    const Verdict verdict = SlidingVerdict(K, static_cast<std::size_t>(contacts), friction, INFINITY).verdict;
    stable += verdict == Verdict::kStable ? 1 : 0;
    unstable += verdict == Verdict::kUnstable ? 1 : 0;
    not_proved += verdict == Verdict::kNotProved ? 1 : 0;
    if (verdict == Verdict::kNotProved) continue;
    double largest = 0.0;
    for (int trial = 0; trial < 24 && largest < kGrown; ++trial) {
      Eigen::VectorXd m(2 * nodes), c(2 * nodes);
      for (Eigen::Index i = 0; i < nodes; ++i) {
        // What holds for all masses of the nodes on the floor is proved for a structure that follows at once.
        if (verdict == Verdict::kStable && i >= contacts) {
          m[2 * i] = m[2 * i + 1] = c[2 * i] = c[2 * i + 1] = 0.0;
          continue;
        }
        m[2 * i] = m[2 * i + 1] = trial % 2 == 0 ? 0.0 : random.Number(0.1, 3.0);
        c[2 * i] = c[2 * i + 1] = random.Number(0.3, 3.0);
      }
      Eigen::VectorXd v = random.Vector(2 * nodes, -1.0, 1.0);
      for (Eigen::Index i = 0; i < contacts; ++i) v[2 * i + 1] = 0.0;
      largest = std::max(
          largest,
          Motion(K, contacts, friction, m, c, 0.05).Growth(1e-3 * v, verdict == Verdict::kStable ? 500 : 4000));
    }
    if (verdict == Verdict::kStable) {
      EXPECT_LT(largest, kGrown) << seed;
    }
    if (verdict == Verdict::kUnstable) {
      EXPECT_GT(largest, kGrown) << seed;
    }
  }
  EXPECT_GT(stable, AtLeast(30));
  EXPECT_GT(unstable, AtLeast(30));
  EXPECT_LT(not_proved, AtLeast(80));
}

}  // namespace
}  // namespace contact_path::stability_problem_test
