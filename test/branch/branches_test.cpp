#include "contact_path/branch/branches.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "contact_path/path/model.h"
#include "support/contact_points.h"
#include "support/dense.h"
#include "support/random.h"
#include "support/reference_cases.h"
#include "support/traced_path.h"

namespace contact_path::branches_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr ContactState kOpen = ContactState::kOpen, kStick = ContactState::kStick;
constexpr ContactState kSlipPlus = ContactState::kSlipPlus, kSlipMinus = ContactState::kSlipMinus;

using ContactStates = std::vector<ContactState>;

ContactStates StatesIn(const Branch& branch) { return ContactStatesOf(branch.modes); }

// A scene in its own scales: what is given here is what the rates are of.
struct Rest {
  explicit Rest(const Scene& scene) : Rest(scene, Configuration::Of(scene)) {}
  Rest(const Scene& scene, const Configuration& configuration)
      : model(scene, configuration, Scaling()), point(model.InitialPoint()) {}

  BranchSet Branches(const Arrival& arrival) {
    return FindBranches(model.structure, model.laws, point, arrival, ActiveSetTolerance());
  }
  BranchSet FromStart(double sign) {
    Arrival arrival;
    arrival.is_start = true;
    arrival.parameter = PathParameter(sign);
    arrival.direction = sign * VectorXd::Unit(model.structure.NumDofs() + 1, model.structure.NumDofs());
    return Branches(arrival);
  }

  Model model;
  PathPoint point;
};

// ----- against an enumeration of its own -----

struct Ray {
  VectorXd direction;  // (du, ds)
  double dissipation = 0.0;
};

// Nodes with one contact each at the origin of their own frame; K couples them. Everything dense and by the
// definitions.
struct LinearProblem {
  MatrixXd stiffness;            // 2n x 2n
  VectorXd load;                 // 2n
  std::vector<double> angle;     // of the normal of each contact
  std::vector<double> friction;  // > 0
  std::vector<double> rn, rt;
  std::vector<ContactState> states;

  Index n() const { return static_cast<Index>(angle.size()); }
  Vector2d Normal(Index i) const { return {std::cos(angle[Size(i)]), std::sin(angle[Size(i)])}; }
  Vector2d Tangent(Index i) const { return {Normal(i).y(), -Normal(i).x()}; }
  static std::size_t Size(Index i) { return static_cast<std::size_t>(i); }

  Scene ToScene() const {
    Scene scene;
    Superelement part;
    for (Index i = 0; i < n(); ++i) {
      const std::string name = "n" + std::to_string(i);
      scene.nodes.push_back({name, 3.0 * static_cast<double>(i), 0.0});
      part.nodes.push_back(name);
      scene.loads.push_back({name, load[2 * i], load[2 * i + 1]});
      const Vector2d reaction = rn[Size(i)] * Normal(i) + rt[Size(i)] * Tangent(i);
      scene.loads.push_back({name, -reaction.x(), -reaction.y(), true});
      scene.obstacles.push_back({"o" + std::to_string(i), ObstacleShape::kHalfPlane, 3.0 * static_cast<double>(i), 0.0,
                                 Normal(i).x(), Normal(i).y(), friction[Size(i)]});
      scene.contacts.push_back({name, "o" + std::to_string(i)});
    }
    for (Index row = 0; row < 2 * n(); ++row)
      for (Index column = 0; column < 2 * n(); ++column) part.stiffness.push_back(stiffness(row, column));
    scene.superelements = {part};
    return scene;
  }

  // All admissible rays, the branch of arrival included. nearest: how near to zero a decisive rate came.
  std::vector<Ray> Rays(double* nearest) const {
    std::vector<Ray> rays;
    *nearest = 1.0;
    ContactStates combination(Size(n()), kOpen);
    Enumerate(0, &combination, &rays, nearest);
    return rays;
  }

 private:
  bool Loaded(Index i) const { return rn[Size(i)] > 0.0; }
  bool AtEdge(Index i, double sign) const {  // rt = -sign mu rn
    return std::abs(friction[Size(i)] * rn[Size(i)] + sign * rt[Size(i)]) < 1e-12;
  }
  bool Possible(Index i, ContactState state) const {
    switch (state) {
      case ContactState::kOpen: return !Loaded(i);
      case ContactState::kStick: return true;
      case ContactState::kSlipPlus: return AtEdge(i, 1.0);
      case ContactState::kSlipMinus: return AtEdge(i, -1.0);
      case ContactState::kClosed: break;
    }
    return false;
  }

  void Enumerate(Index i, ContactStates* combination, std::vector<Ray>* rays, double* nearest) const {
    if (i == n()) {
      Try(*combination, rays, nearest);
      return;
    }
    for (const ContactState state : {kOpen, kStick, kSlipPlus, kSlipMinus}) {
      if (!Possible(i, state)) continue;
      (*combination)[Size(i)] = state;
      Enumerate(i + 1, combination, rays, nearest);
    }
  }

  // Unknowns (du, ds, drn, drt): K du - ds f - sum (drn n + drt t) = 0 and two equations a contact.
  void Try(const ContactStates& combination, std::vector<Ray>* rays, double* nearest) const {
    const Index size = 4 * n() + 1;
    MatrixXd equations = MatrixXd::Zero(4 * n(), size);
    equations.topLeftCorner(2 * n(), 2 * n()) = stiffness;
    equations.block(0, 2 * n(), 2 * n(), 1) = -load;
    for (Index i = 0; i < n(); ++i) {
      const Index rn_column = 2 * n() + 1 + 2 * i, rt_column = rn_column + 1, row = 2 * n() + 2 * i;
      equations.block(2 * i, rn_column, 2, 1) = -Normal(i);
      equations.block(2 * i, rt_column, 2, 1) = -Tangent(i);
      const double mu = friction[Size(i)];
      switch (combination[Size(i)]) {
        case ContactState::kOpen:
          equations(row, rn_column) = 1.0;
          equations(row + 1, rt_column) = 1.0;
          break;
        case ContactState::kStick:
          equations.block(row, 2 * i, 1, 2) = Normal(i).transpose();
          equations.block(row + 1, 2 * i, 1, 2) = Tangent(i).transpose();
          break;
        default:
          equations.block(row, 2 * i, 1, 2) = Normal(i).transpose();
          equations(row + 1, rt_column) = 1.0;
          equations(row + 1, rn_column) = combination[Size(i)] == kSlipPlus ? mu : -mu;
      }
    }
    const SingularValueDecomposition dense = Decompose(equations);
    *nearest = std::min(*nearest, dense.values[4 * n() - 1]);
    const VectorXd null_vector = dense.v.col(size - 1);
    const double norm = null_vector.head(2 * n() + 1).norm();
    *nearest = std::min(*nearest, norm);
    for (const double sign : {1.0, -1.0}) {
      const VectorXd x = sign / norm * null_vector;
      Ray ray;
      ray.direction = x.head(2 * n() + 1);
      double smallest = 1.0;
      for (Index i = 0; i < n(); ++i) {
        const Vector2d du = x.segment(2 * i, 2);
        const double drn = x[2 * n() + 1 + 2 * i], drt = x[2 * n() + 2 + 2 * i], mu = friction[Size(i)];
        const double slip = Tangent(i).dot(du);
        const ContactState state = combination[Size(i)];
        if (state == kOpen) smallest = std::min(smallest, Normal(i).dot(du));
        if (state != kOpen && !Loaded(i)) smallest = std::min(smallest, drn);
        if (state == kStick && AtEdge(i, 1.0)) smallest = std::min(smallest, mu * drn + drt);
        if (state == kStick && AtEdge(i, -1.0)) smallest = std::min(smallest, mu * drn - drt);
        if (state == kSlipPlus) smallest = std::min(smallest, slip);
        if (state == kSlipMinus) smallest = std::min(smallest, -slip);
        if (state == kSlipPlus || state == kSlipMinus) ray.dissipation -= rt[Size(i)] * slip;
      }
      *nearest = std::min(*nearest, std::abs(smallest));
      if (smallest > 0.0) rays->push_back(ray);
    }
  }
};

// K is not positive definite in general: what a truss near its limits is.
LinearProblem RandomProblem(Random* random, Index n) {
  LinearProblem problem;
  const MatrixXd half = MatrixXd::NullaryExpr(2 * n, 2 * n, [&](Index, Index) { return random->Number(-1.0, 1.0); });
  problem.stiffness = half * half.transpose() + random->Number(-0.3, 0.5) * MatrixXd::Identity(2 * n, 2 * n);
  problem.load = random->Vector(2 * n, -1.0, 1.0).normalized();
  for (Index i = 0; i < n; ++i) {
    problem.angle.push_back(random->Number(0.0, 6.28));
    problem.friction.push_back(random->Number(0.1, 2.0));
    const double kind = random->Number(0.0, 1.0);
    const double rn = kind < 0.4 ? 0.0 : random->Number(0.2, 1.0), mu = problem.friction.back();
    const double rt =
        kind < 0.55 ? random->Number(-0.8, 0.8) * mu * rn : (random->Number(0.0, 1.0) < 0.5 ? mu : -mu) * rn;
    problem.rn.push_back(rn);
    problem.rt.push_back(rt);
    problem.states.push_back(kStick);
  }
  return problem;
}

TEST(FindBranches, FindsExactlyTheAdmissibleRays) {
  Random random(1);
  std::vector<int> with_branches(12, 0);
  int compared = 0, close = 0;
  for (int i = 0; i < 600; ++i) {
    const Index n = 1 + i % 3;
    const LinearProblem problem = RandomProblem(&random, n);
    double nearest = 0.0;
    const std::vector<Ray> rays = problem.Rays(&nearest);
    if (nearest < 1e-6) {  // a rate that decides is next to zero: not a case for comparison
      ++close;
      continue;
    }
    // Generic rate problems of Coulomb friction have an even number of rays: they are the ends of curves.
    EXPECT_EQ(rays.size() % 2, 0U) << "problem " << i;

    Rest rest(problem.ToScene());
    for (Index k = 0; k < n; ++k) {
      const auto contact = static_cast<std::size_t>(k);
      SetReaction(contact, problem.rn[contact], problem.rt[contact], &rest.point);
    }
    Arrival arrival;  // from where no ray leads
    arrival.direction = random.Vector(2 * n + 1, -1.0, 1.0).normalized();
    const BranchSet on = rest.Branches(arrival);
    ASSERT_EQ(on.branches.size(), rays.size()) << "problem " << i;
    EXPECT_EQ(on.complete_by, Completeness::kAllCombinations);
    for (const Ray& ray : rays) {
      const auto branch =
          std::min_element(on.branches.begin(), on.branches.end(), [&](const Branch& a, const Branch& b) {
            return (a.direction - ray.direction).norm() < (b.direction - ray.direction).norm();
          });
      EXPECT_LE((branch->direction - ray.direction).norm(), 1e-9) << "problem " << i;
      EXPECT_NEAR(branch->dissipation_rate, ray.dissipation, 1e-9);
      EXPECT_NEAR(branch->direction.norm(), 1.0, 1e-14);
      EXPECT_EQ(branch->load_rate, branch->direction[2 * n]);
      EXPECT_NEAR(std::cos(branch->turn), branch->direction.dot(arrival.direction), 1e-12);
      EXPECT_FALSE(branch->mechanism);
    }
    for (std::size_t k = 0; k + 1 < on.branches.size(); ++k) {
      EXPECT_GE(on.branches[k].dissipation_rate, on.branches[k + 1].dissipation_rate - 1e-9);
      const bool tie = std::abs(on.branches[k].dissipation_rate - on.branches[k + 1].dissipation_rate) < 1e-10;
      EXPECT_TRUE(!tie || on.branches[k].turn <= on.branches[k + 1].turn + 1e-9);
    }

    // Arrived along one of them backwards: all the others.
    if (!rays.empty()) {
      arrival.direction = -rays[0].direction;
      const BranchSet others = rest.Branches(arrival);
      EXPECT_EQ(others.branches.size(), rays.size() - 1);
      for (const Branch& branch : others.branches) EXPECT_GE((branch.direction - rays[0].direction).norm(), 1e-6);
    }
    // From a start: those with the wanted sign.
    for (const double sign : {1.0, -1.0}) {
      const auto wanted =
          std::count_if(rays.begin(), rays.end(), [&](const Ray& ray) { return sign * ray.direction[2 * n] > 0.0; });
      EXPECT_EQ(rest.FromStart(sign).branches.size(), static_cast<std::size_t>(wanted));
    }
    ++with_branches[std::min<std::size_t>(rays.size(), 11)];
    ++compared;
  }
  EXPECT_GE(compared, 550);
  EXPECT_LE(close, 50);
  EXPECT_GE(with_branches[0], 1);
  EXPECT_GE(with_branches[2], 100);
  EXPECT_GE(with_branches[4], 5);
}

// ----- many contacts -----

// Nodes that do not know of each other, one spring each: the states of each are known, and 4^n combinations are too
// many. The rates of holonomic friction are no complementarity problem: pivoting finds the states.
TEST(FindBranches, ManyContactsAtOnce) {
  Scene scene;
  ContactStates expected;
  Random random(2);
  for (int i = 0; i < 12; ++i) {
    const std::string name = "n" + std::to_string(i);
    scene.nodes.push_back({name, static_cast<double>(i), 0.0});
    scene.superelements.push_back({{name}, {1.0, 0.0, 0.0, 1.0}});
    const double fx = random.Number(-1.0, 1.0), fy = random.Number(-1.0, 0.3);
    scene.loads.push_back({name, fx, fy});
    scene.contacts.push_back({name, "floor"});
    if (fy > 0.0)
      expected.push_back(kOpen);
    else if (std::abs(fx) < -0.5 * fy)
      expected.push_back(kStick);
    else
      expected.push_back(fx > 0.0 ? kSlipPlus : kSlipMinus);
  }
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.5}};
  for (const bool holonomic : {false, true}) {
    Configuration configuration = Configuration::Of(scene);
    if (holonomic)
      for (const Node& node : scene.nodes)
        configuration.slip_origins.insert(configuration.slip_origins.end(), {node.x, node.y});
    Rest rest(scene, configuration);
    const BranchSet on = rest.FromStart(1.0);
    EXPECT_EQ(on.weakly_active, 12);
    EXPECT_EQ(on.complete_by, Completeness::kNone);
    EXPECT_LE(on.combinations, 100);
    ASSERT_EQ(on.branches.size(), 1U);
    EXPECT_EQ(StatesIn(on.branches[0]), expected);
  }
}

// Unloaded contacts, all touching, ds = 1: the admissible branches by trying all 4^n combinations on the compliance.
std::vector<VectorXd> BranchesWithRisingLoad(const LinearProblem& problem) {
  using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 14, 14>;
  using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 14, 1>;
  const Index n = problem.n();
  const MatrixXd compliance = problem.stiffness.inverse();
  MatrixXd directions = MatrixXd::Zero(2 * n, 2 * n);  // columns n, t of each contact
  for (Index i = 0; i < n; ++i) {
    directions.block(2 * i, 2 * i, 2, 1) = problem.Normal(i);
    directions.block(2 * i, 2 * i + 1, 2, 1) = problem.Tangent(i);
  }
  const MatrixXd motion = directions.transpose() * compliance * directions;  // of the contacts, by their reactions
  const VectorXd free_motion = directions.transpose() * compliance * problem.load;
  std::vector<VectorXd> branches;
  for (int code = 0; code < 1 << (2 * n); ++code) {
    SmallMatrix matrix = SmallMatrix::Zero(2 * n, 2 * n);
    SmallVector right = SmallVector::Zero(2 * n);
    for (Index i = 0; i < n; ++i) {
      const int state = code >> (2 * i) & 3;  // open, stick, slip+, slip-
      const double mu = problem.friction[static_cast<std::size_t>(i)];
      const bool touches = state != 0;
      if (touches) {
        matrix.row(2 * i) = motion.row(2 * i);
        right[2 * i] = -free_motion[2 * i];
      } else {
        matrix(2 * i, 2 * i) = 1.0;
      }
      if (state == 1) {
        matrix.row(2 * i + 1) = motion.row(2 * i + 1);
        right[2 * i + 1] = -free_motion[2 * i + 1];
      } else {
        matrix(2 * i + 1, 2 * i + 1) = 1.0;
        if (touches) matrix(2 * i + 1, 2 * i) = state == 2 ? mu : -mu;
      }
    }
    const SmallVector r = matrix.partialPivLu().solve(right);
    const SmallVector moved = free_motion + motion * r;
    bool admissible = true;
    for (Index i = 0; i < n && admissible; ++i) {
      const int state = code >> (2 * i) & 3;
      const double mu = problem.friction[static_cast<std::size_t>(i)];
      if (state == 0) admissible = moved[2 * i] > 0.0;
      if (state == 1) admissible = mu * r[2 * i] > std::abs(r[2 * i + 1]);
      if (state >= 2) admissible = r[2 * i] > 0.0 && (state == 2 ? 1.0 : -1.0) * moved[2 * i + 1] > 0.0;
    }
    if (!admissible) continue;
    VectorXd branch(2 * n + 1);
    branch << compliance * (problem.load + directions * r), 1.0;
    branches.push_back(branch.normalized());
  }
  return branches;
}

// More contacts than are enumerated at once: what is found is admissible, and something is found where there is a
// branch, among very rough contacts, too, where the rates in motions may have no solution that is found: those in
// forces have one, and no list needs all combinations.
TEST(FindBranches, ManyCoupledContacts) {
  Random random(3);
  int found = 0, missed = 0, enumerated = 0;
  for (int i = 0; i < 72; ++i) {
    const Index n = 7;  // each takes a quarter of a second
    const bool rough = i >= 36;
    if (i == 36) random = Random(3);
    LinearProblem problem = RandomProblem(&random, n);
    problem.stiffness = problem.stiffness * problem.stiffness + 0.5 * MatrixXd::Identity(2 * n, 2 * n);
    for (std::size_t k = 0; k < 7; ++k) {
      problem.friction[k] = rough ? 1.0 : 0.3;
      problem.rn[k] = problem.rt[k] = 0.0;
    }
    if (i % 36 % 31 > 4 || (rough && i % 2 == 0)) continue;
    const std::vector<VectorXd> all = BranchesWithRisingLoad(problem);
    Rest rest(problem.ToScene());
    const BranchSet on = rest.FromStart(1.0);
    EXPECT_EQ(on.complete_by == Completeness::kAllCombinations, on.combinations >= 1 << 14);
    if (on.complete_by == Completeness::kAllCombinations) ++enumerated;
    for (const Branch& branch : on.branches) {
      double distance = 1.0;
      for (const VectorXd& other : all) distance = std::min(distance, (other - branch.direction).norm());
      EXPECT_LE(distance, 1e-9) << "problem " << i;
    }
    if (!on.branches.empty() && !rough) ++found;
    if (on.branches.empty() && !all.empty()) {
      ++missed;
      ADD_FAILURE() << "problem " << i << ": none of " << all.size() << " branches was found";
    }
  }
  EXPECT_GE(found, 8);
  EXPECT_EQ(enumerated, 0);
  EXPECT_EQ(missed, 0);
}

// ----- rigid modes -----

// Two bars in a row, hinged and free at the end.
TEST(FindBranches, RigidModes) {
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0}, {"c", 2.0, 0.5}};
  scene.bars = {{{"a", "b"}, 1.0}, {{"b", "c"}, 1.0}};
  scene.loads = {{"b", 1.0, 0.0}};
  Rest rest(scene);
  const BranchSet on = rest.FromStart(1.0);
  // The load stretches the first bar; the second swings freely, and of all motions that keep its length this is the
  // shortest.
  ASSERT_EQ(on.branches.size(), 1U);
  EXPECT_FALSE(on.branches[0].mechanism);
  EXPECT_NEAR(on.branches[0].direction[1] / on.branches[0].direction[0], -1.0 / 3.0, 1e-12);
  EXPECT_NEAR(on.branches[0].load_rate / on.branches[0].direction[0], 1.0, 1e-12);
  // Nothing bears a load across the bars.
  scene.loads = {{"c", 0.0, 1.0}};
  EXPECT_TRUE(Rest(scene).FromStart(1.0).branches.empty());
}

}  // namespace
}  // namespace contact_path::branches_test
