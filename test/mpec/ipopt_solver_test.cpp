#include "contact_path/mpec/ipopt_solver.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

namespace contact_path::ipopt_solver_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Hock & Schittkowski 1981, problem 71, which is also the example of Ipopt's manual:
//   minimise x0 x3 (x0 + x1 + x2) + x2,  x0 x1 x2 x3 >= 25,  x0^2 + x1^2 + x2^2 + x3^2 = 40,  1 <= x <= 5.
// The upper bounds are written as constraints.
class Hs071 : public NonlinearProgram {
 public:
  Eigen::Index NumVariables() const override { return 4; }
  Eigen::Index NumConstraints() const override { return 6; }
  ProgramBounds Bounds() const override {
    ProgramBounds bounds = {Eigen::VectorXd::Ones(4), Eigen::VectorXd::Constant(6, -kInfinity),
                            Eigen::VectorXd::Constant(6, 5.0)};
    bounds.lower.head<2>() << 25.0, sum_of_squares_;
    bounds.upper.head<2>() << kInfinity, sum_of_squares_;
    return bounds;
  }

  double Objective(const Eigen::VectorXd& x) const override { return x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]; }
  Eigen::VectorXd Gradient(const Eigen::VectorXd& x) const override {
    return Eigen::Vector4d(x[3] * (2.0 * x[0] + x[1] + x[2]), x[0] * x[3], x[0] * x[3] + 1.0,
                           x[0] * (x[0] + x[1] + x[2]));
  }
  Eigen::VectorXd Constraints(const Eigen::VectorXd& x) const override {
    Eigen::VectorXd values(6);
    values << x.prod() + poison_, x.squaredNorm(), x;
    return values;
  }
  MatrixEntries Jacobian(const Eigen::VectorXd& x) const override {
    MatrixEntries entries;
    for (Eigen::Index j = 0; j < 4; ++j) {
      entries.emplace_back(0, j, x.prod() / x[j]);
      entries.emplace_back(1, j, 2.0 * x[j]);
      entries.emplace_back(2 + j, j, 1.0);
    }
    return entries;
  }
  MatrixEntries Hessian(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers) const override {
    const double m0 = multipliers[0], m1 = multipliers[1];
    return {{0, 0, factor * 2.0 * x[3] + 2.0 * m1},
            {1, 0, factor * x[3] + m0 * x[2] * x[3]},
            {1, 1, 2.0 * m1},
            {2, 0, factor * x[3] + m0 * x[1] * x[3]},
            {2, 1, m0 * x[0] * x[3]},
            {2, 2, 2.0 * m1},
            {3, 0, factor * (2.0 * x[0] + x[1] + x[2]) + m0 * x[1] * x[2]},
            {3, 1, factor * x[0] + m0 * x[0] * x[2]},
            {3, 2, factor * x[0] + m0 * x[0] * x[1]},
            {3, 3, 2.0 * m1}};
  }

  void SetSumOfSquares(double value) { sum_of_squares_ = value; }
  void Poison() { poison_ = std::numeric_limits<double>::quiet_NaN(); }

 private:
  double sum_of_squares_ = 40.0;
  double poison_ = 0.0;
};

// As published in Ipopt's documentation, to its digits.
const Eigen::Vector4d kOptimum(1.0, 4.74299963, 3.82114998, 1.37940829);
constexpr double kOptimalValue = 17.0140173;
constexpr double kPublishedDigits = 5e-8;

PrimalDual Start() {
  PrimalDual point;
  point.x = Eigen::Vector4d(1.0, 5.0, 5.0, 1.0);
  return point;
}

TEST(IpoptSolver, FindsThePublishedOptimum) {
  const Hs071 program;
  IpoptSolver solver(nullptr);
  PrimalDual point = Start();
  const SolveOutcome outcome = solver.Solve(program, 0.0, &point);
  EXPECT_EQ(outcome.status, SolveStatus::kSolved);
  EXPECT_GT(outcome.iterations, 0);
  EXPECT_LT(outcome.iterations, 30);
  EXPECT_LE((point.x - kOptimum).cwiseAbs().maxCoeff(), kPublishedDigits);
  EXPECT_NEAR(program.Objective(point.x), kOptimalValue, 1e-7);
}

TEST(IpoptSolver, MultipliersMakeTheLagrangianStationary) {
  const Hs071 program;
  IpoptSolver solver(nullptr);
  PrimalDual point = Start();
  ASSERT_EQ(solver.Solve(program, 0.0, &point).status, SolveStatus::kSolved);
  ASSERT_EQ(point.multipliers.size(), 6);
  ASSERT_EQ(point.lower_multipliers.size(), 4);
  Eigen::VectorXd gradient = program.Gradient(point.x) - point.lower_multipliers;
  for (const auto& entry : program.Jacobian(point.x))
    gradient[entry.col()] += point.multipliers[entry.row()] * entry.value();
  EXPECT_LE(gradient.cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_GT(point.lower_multipliers[0], 1.0);  // x0 is at its bound
}

TEST(IpoptSolver, WarmStartFromTheOptimumIsShort) {
  const Hs071 program;
  IpoptSolver solver(nullptr);
  PrimalDual point = Start();
  const int cold = solver.Solve(program, 0.0, &point).iterations;
  const Eigen::VectorXd optimum = point.x;
  const SolveOutcome warm = solver.Solve(program, 1e-9, &point);
  EXPECT_EQ(warm.status, SolveStatus::kSolved);
  EXPECT_LE(warm.iterations, cold / 2);
  EXPECT_LE((point.x - optimum).norm(), 1e-6);
}

TEST(IpoptSolver, WarmStartWithoutMultipliersIsACold) {
  const Hs071 program;
  IpoptSolver solver(nullptr);
  PrimalDual cold = Start(), warm = Start();
  const SolveOutcome from_cold = solver.Solve(program, 0.0, &cold), from_warm = solver.Solve(program, 1e-3, &warm);
  EXPECT_EQ(from_warm.status, SolveStatus::kSolved);
  EXPECT_EQ(from_warm.iterations, from_cold.iterations);
  EXPECT_EQ(warm.x, cold.x);
}

TEST(IpoptSolver, SameResultBitForBit) {
  Hs071 program;
  IpoptSolver solver(nullptr);
  PrimalDual first = Start();
  const SolveOutcome first_outcome = solver.Solve(program, 0.0, &first);
  // Something else in between must leave no trace.
  program.SetSumOfSquares(36.0);
  PrimalDual other = Start();
  solver.Solve(program, 0.0, &other);
  solver.Solve(program, 1e-4, &other);
  program.SetSumOfSquares(40.0);
  PrimalDual second = Start();
  const SolveOutcome second_outcome = solver.Solve(program, 0.0, &second);
  IpoptSolver fresh(nullptr);
  PrimalDual third = Start();
  fresh.Solve(program, 0.0, &third);
  EXPECT_EQ(first_outcome.iterations, second_outcome.iterations);
  for (const PrimalDual* point : {&second, &third}) {
    EXPECT_EQ(point->x, first.x);
    EXPECT_EQ(point->multipliers, first.multipliers);
    EXPECT_EQ(point->lower_multipliers, first.lower_multipliers);
  }
}

TEST(IpoptSolver, CancelsAtTheNextIteration) {
  const Hs071 program;
  for (const int after : {0, 1, 3}) {
    int asked = 0;
    IpoptSolver solver([&] { return ++asked > after; });
    PrimalDual point = Start();
    const SolveOutcome outcome = solver.Solve(program, 0.0, &point);
    EXPECT_EQ(outcome.status, SolveStatus::kCancelled);
    EXPECT_EQ(outcome.iterations, after);
    EXPECT_EQ(asked, after + 1);
    EXPECT_TRUE(point.x.allFinite());
  }
}

TEST(IpoptSolver, WorksAgainAfterACancelledSolve) {
  const Hs071 program;
  bool cancel = true;
  IpoptSolver solver([&] { return cancel; });
  PrimalDual point = Start();
  EXPECT_EQ(solver.Solve(program, 0.0, &point).status, SolveStatus::kCancelled);
  cancel = false;
  point = Start();
  EXPECT_EQ(solver.Solve(program, 0.0, &point).status, SolveStatus::kSolved);
}

TEST(IpoptSolver, ProgramWithoutASolutionFails) {
  Hs071 program;
  program.SetSumOfSquares(3.0);  // x >= 1 asks for 4 at least
  IpoptSolver solver(nullptr);
  PrimalDual point = Start();
  EXPECT_EQ(solver.Solve(program, 0.0, &point).status, SolveStatus::kFailed);
}

TEST(IpoptSolver, ProgramThatIsNotFiniteFails) {
  Hs071 program;
  program.Poison();
  IpoptSolver solver(nullptr);
  PrimalDual point = Start();
  EXPECT_EQ(solver.Solve(program, 0.0, &point).status, SolveStatus::kFailed);
}

// Ipopt reads ipopt.opt from the working directory unless told not to.
class OptionsFile : public testing::Test {
 protected:
  OptionsFile() {
    directory_ = testing::TempDir() + "ipopt_options_" + std::to_string(getpid());
    EXPECT_EQ(mkdir(directory_.c_str(), 0700), 0);
    char buffer[4096];
    before_ = getcwd(buffer, sizeof(buffer));
    EXPECT_EQ(chdir(directory_.c_str()), 0);
    std::ofstream("ipopt.opt") << "max_iter 0\n";
  }
  ~OptionsFile() override {
    std::remove("ipopt.opt");
    EXPECT_EQ(chdir(before_.c_str()), 0);
    rmdir(directory_.c_str());
  }

  std::string directory_, before_;
};

TEST_F(OptionsFile, ChangesNothing) {
  const Hs071 program;
  IpoptSolver solver(nullptr);
  PrimalDual point = Start();
  EXPECT_EQ(solver.Solve(program, 0.0, &point).status, SolveStatus::kSolved);
}

}  // namespace
}  // namespace contact_path::ipopt_solver_test
