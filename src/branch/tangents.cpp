#include "contact_path/branch/tangents.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/branch/plane_tangents.h"
#include "contact_path/equations/second_form.h"
#include "contact_path/iterations.h"
#include "contact_path/linear/linearised_equations.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

using Svd = Eigen::JacobiSVD<Eigen::MatrixXd>;

// Columns of `basis` without what lies in the span of the rows' null space: splits a null space by what moves.
// Returns the part of basis in which the rows `from`..`from + count` vanish (still = true) or its complement.
Eigen::MatrixXd Split(const Eigen::MatrixXd& basis, Eigen::Index from, Eigen::Index count, bool still) {
  if (basis.cols() == 0) return basis;
  const Svd rows(basis.middleRows(from, count), Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  while (rank < rows.singularValues().size() && rows.singularValues()[rank] > tolerances::kDependent) ++rank;
  return still ? basis * rows.matrixV().rightCols(basis.cols() - rank) : basis * rows.matrixV().leftCols(rank);
}

// The null vectors that move: rigid modes change neither the load factor nor a reaction, the proper ones do and have
// no share of the rigid modes.
struct NullSpaceParts {
  Eigen::MatrixXd moving, rigid, proper;
};

NullSpaceParts PartsOf(const Eigen::MatrixXd& null_space, Eigen::Index motion) {
  const Eigen::Index forces = null_space.rows() - motion + 1;
  NullSpaceParts parts;
  if (null_space.cols() == 1) {
    parts.moving = parts.proper = null_space;
    return parts;
  }
  parts.moving = Split(null_space, 0, motion, false);
  parts.rigid = Split(parts.moving, motion - 1, forces, true);
  parts.proper = Split(parts.moving, motion - 1, forces, false);
  for (Eigen::Index k = 0; k < parts.rigid.cols(); ++k) {
    const Eigen::VectorXd mode = parts.rigid.col(k).head(motion).normalized();
    for (Eigen::Index j = 0; j < parts.proper.cols(); ++j) {
      Eigen::VectorXd column = parts.proper.col(j);
      column.head(motion) -= mode.dot(column.head(motion)) * mode;
      parts.proper.col(j) = column;
    }
  }
  return parts;
}

// Of the combinations of the columns: that whose motion is nearest to the direction of arrival.
Eigen::VectorXd NearestTo(const Eigen::VectorXd& arrival, const Eigen::MatrixXd& candidates) {
  const auto motions = candidates.topRows(arrival.size());
  const Svd svd(motions, Eigen::ComputeFullV);
  const Eigen::VectorXd along = svd.matrixV().transpose() * (motions.transpose() * arrival);
  return candidates * (svd.matrixV() * along.cwiseQuotient(svd.singularValues().cwiseAbs2()));
}

// The direction of the arc where the equations leave more than one. A mechanism has rigid modes only: with one of them
// it moves in that direction; with more, the direction nearest to the arrival stands for all of them.
void AddTangent(const NullSpaceParts& parts, const Eigen::VectorXd& arrival, Tangents* tangents) {
  const bool rigid = parts.proper.cols() == 0;
  const Eigen::MatrixXd& candidates = rigid ? parts.rigid : parts.proper;
  if (candidates.cols() == 0) return;
  tangents->mechanism = rigid && candidates.cols() > 1;
  if (rigid) tangents->rigid_modes = static_cast<int>(candidates.cols());
  Eigen::VectorXd tangent =
      candidates.cols() == 1 ? Eigen::VectorXd(candidates.col(0)) : NearestTo(arrival, candidates);
  const double norm = tangent.head(arrival.size()).norm();
  if (!(norm > tolerances::kDependent)) return;
  tangent /= norm;
  tangents->first.push_back(std::move(tangent));
}

// Some rigid modes exist at the point only, as of slack bars that happen to be straight: adds their share of the
// tangent. The equations hold to second order along the curve: psi . F''(z, z) = 0 for each left null vector psi, where
// z is the tangent with a share of each rigid mode. The tangent stays as it is where these equations do not tell.
void AddShareOfModes(const Eigen::VectorXd& x, const Eigen::MatrixXd& modes, const Eigen::MatrixXd& left,
                     ArcEquations* equations, Eigen::VectorXd* tangent) {
  if (modes.cols() == 0 || left.cols() != modes.cols()) return;
  const Eigen::MatrixXd psi = left.topRows(equations->NumEquations()).colwise().normalized();
  const SecondForm second(equations, x);
  const auto form = [&](const Eigen::VectorXd& z) { return Eigen::VectorXd(psi.transpose() * second(z)); };
  Eigen::VectorXd z = *tangent, value = form(z);
  for (int i = 0; i < kMostIterations; ++i) {
    Eigen::MatrixXd slope(modes.cols(), modes.cols());
    for (Eigen::Index k = 0; k < modes.cols(); ++k) slope.col(k) = 2.0 * psi.transpose() * second(z, modes.col(k));
    const Svd svd(slope, Eigen::ComputeFullV);
    if (!(svd.singularValues()[modes.cols() - 1] > tolerances::kNoForm)) return;
    z -= modes * slope.partialPivLu().solve(value);
    value = form(z);
    if (!value.allFinite()) return;
    if (value.norm() > tolerances::kRate * z.squaredNorm()) continue;
    *tangent = z / z.head(equations->NumMotion()).norm();
    return;
  }
}

Tangents SingularTangents(const Eigen::VectorXd& x, const Eigen::VectorXd& arrival, bool crossed,
                          ArcEquations* equations, const MinimumNormSolver& solver) {
  Tangents tangents;
  const NullSpaceParts parts = PartsOf(solver.NullSpace(), arrival.size());
  const Eigen::MatrixXd& plane = crossed ? parts.moving : parts.proper;
  if (plane.cols() == 2 && (crossed || parts.rigid.cols() == 0)) {
    PlaneTangents in_plane = TangentsInPlane(equations, x, plane, solver.LeftNullSpace());
    if (in_plane.determined) {
      tangents.rests = !crossed;
      tangents.first = std::move(in_plane.directions);
      return tangents;
    }
  }
  AddTangent(parts, arrival, &tangents);
  if (!crossed && parts.proper.cols() == 1 && tangents.first.size() == 1)
    AddShareOfModes(x, parts.rigid, solver.LeftNullSpace(), equations, &tangents.first[0]);
  return tangents;
}

// Where rigid motions of parts are all that makes the equations singular. tangent: empty where the equations leave the
// rigid motions alone.
Tangents HeldTangents(const Eigen::VectorXd& arrival, Eigen::VectorXd tangent, const Eigen::MatrixXd& modes) {
  const Eigen::Index motion = arrival.size();
  NullSpaceParts parts;
  parts.rigid = modes;
  if (tangent.size() > 0) {
    tangent -= modes * (modes.transpose() * tangent);
    tangent /= tangent.head(motion).norm();
    const bool changes = tangent.tail(tangent.size() - motion + 1).norm() > tolerances::kDependent;
    Eigen::MatrixXd& of = changes ? parts.proper : parts.rigid;
    of.conservativeResize(tangent.size(), of.cols() + 1);
    of.rightCols<1>() = tangent;
  }
  Tangents tangents;
  AddTangent(parts, arrival, &tangents);
  if (parts.proper.cols() == 0) tangents.rigid = true;
  return tangents;
}

}  // namespace

Tangents FindTangents(const Eigen::VectorXd& x, const Eigen::VectorXd& arrival, bool crossed, ArcEquations* equations,
                      TangentSolvers* solvers) {
  const Eigen::Index motion = arrival.size(), s = motion - 1;
  const Eigen::SparseMatrix<double>& transposed = equations->TransposedJacobian(x);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(equations->NumEquations());
  Tangents tangents;
  const auto add_by = [&](const BorderedSolver& solver) {
    const LinearisedEquations linearised(transposed);
    for (Eigen::VectorXd& first : tangents.first) {
      linearised.Refine(solver, &first);
      first /= first.head(motion).norm();
      tangents.second.push_back(solver.Solve(-equations->SecondDerivative(x, first), 0.0));
      tangents.load_error.push_back(linearised.ErrorOf(s, solver, first));
    }
  };
  if (!crossed) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(equations->NumUnknowns());
    row.head(motion) = arrival;
    Factorised& factors = solvers->factors;
    const Factorised::Kind kind = factors.Make(equations, x, transposed, row, tolerances::kRegularPivot, true);
    if (kind == Factorised::Kind::kRegular) {
      tangents.first = {factors.solver.Solve(none, 1.0)};
      add_by(factors.solver);
      return tangents;
    }
    if (kind == Factorised::Kind::kHeld) {
      tangents = HeldTangents(arrival, factors.tangent, factors.free);
      if (factors.tangent.size() > 0) {
        add_by(factors.solver);
        return tangents;
      }
      // Rigid motions without load: how they bend is of no use.
      tangents.second.assign(tangents.first.size(), Eigen::VectorXd::Zero(equations->NumUnknowns()));
      tangents.load_error.assign(tangents.first.size(), tolerances::kRate);
      return tangents;
    }
  }
  if (!solvers->singular.Factorize(transposed, crossed ? tolerances::kRootOfRounding : tolerances::kDependentColumn))
    return tangents;
  tangents = SingularTangents(x, arrival, crossed, equations, solvers->singular);
  for (const Eigen::VectorXd& first : tangents.first)
    tangents.second.push_back(solvers->singular.Solve(-equations->SecondDerivative(x, first)));
  tangents.load_error.assign(tangents.first.size(), tolerances::kRate);
  return tangents;
}

}  // namespace contact_path
