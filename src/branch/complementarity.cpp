#include "contact_path/branch/complementarity.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <optional>

#include "contact_path/branch/lemke.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kUneven = 16.0;

}  // namespace

std::vector<ComplementaritySolution> SolveComplementarity(const Eigen::MatrixXd& M, const Eigen::VectorXd& q) {
  const Eigen::Index n = M.rows();
  // w - M z = q, without free variables.
  Eigen::MatrixXd dense(n, 2 * n);
  dense << Eigen::MatrixXd::Identity(n, n), -M;
  ComplementarityProblem problem{dense.sparseView(), q, n,
                                 Eigen::VectorXd::Constant(n, kOfTies * q.lpNorm<Eigen::Infinity>())};
  std::vector<ComplementaritySolution> solutions;
  const auto note = [&](const std::optional<ComplementaritySolution>& second) {
    if (second && std::find(solutions.begin(), solutions.end(), *second) == solutions.end())
      solutions.push_back(*second);
  };
  note(SolveByLemke(problem, Eigen::VectorXd::Ones(n)));
  if (HasOneSolutionForEach(M)) return solutions;
  // Other ways lead to other solutions, where there are several: the variables covered in other shares, and the two of
  // each pair exchanged.
  Eigen::VectorXd uneven(n);
  for (Eigen::Index p = 0; p < n; ++p) uneven[p] = p % 2 == 0 ? 1.0 : kUneven;
  note(SolveByLemke(problem, uneven));
  dense << -M, Eigen::MatrixXd::Identity(n, n);
  problem.equations = dense.sparseView();
  std::optional<ComplementaritySolution> first = SolveByLemke(problem, Eigen::VectorXd::Ones(n));
  if (first) first->flip();
  note(first);
  return solutions;
}

bool HasOneSolutionForEach(const Eigen::MatrixXd& M) {
  if (M.rows() == 0) return true;
  const Eigen::LLT<Eigen::MatrixXd> factors(0.5 * (M + M.transpose()));
  return factors.info() == Eigen::Success && factors.rcond() > tolerances::kDependent;
}

}  // namespace contact_path
