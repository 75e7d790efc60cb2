// The equations of an arc with one row added, factorised at a point: regular, held, or singular.
#ifndef CONTACT_PATH_BRANCH_FACTORISED_H_
#define CONTACT_PATH_BRANCH_FACTORISED_H_

#include <Eigen/Core>

#include "contact_path/equations/arc_equations.h"
#include "contact_path/linear/bordered_solver.h"

namespace contact_path {

// M = [J; row]. Free motions are known by geometry: rounding of stiff parts may make equations regular that a rigid
// motion makes singular.
struct Factorised {
  enum class Kind {
    kRegular,   // the solver has M
    kHeld,      // free motions are all that makes M singular: the solver has M with springs that hold them
    kSingular,  // the solver has nothing yet
  };

  // regular: smallest over largest pivot of a regular M. held: whether free motions are expected, as along an arc that
  // had them; otherwise M is looked at first, and they are looked for where it is singular.
  Kind Make(ArcEquations* equations, const Eigen::VectorXd& x, const Eigen::SparseMatrix<double>& transposed,
            const Eigen::VectorXd& row, double regular, bool held) {
    free.resize(0, 0);
    const auto is_regular = [&] { return solver.FactorizeRegular(transposed, row, regular, equations->InFrame()); };
    const auto is_held = [&] {
      free = equations->FreeMotions(x, transposed);
      return free.cols() > 0 && transposed.rows() == transposed.cols() + 1 &&
             solver.FactorizeHeld(transposed, row, free, equations->InFrame(), &tangent);
    };
    const bool possible = equations->MayMoveFreely();
    if (possible && held && is_held()) return Kind::kHeld;
    if (free.cols() == 0 && is_regular()) return Kind::kRegular;
    return possible && !held && is_held() ? Kind::kHeld : Kind::kSingular;
  }

  BorderedSolver solver;
  Eigen::MatrixXd free;     // motions, orthonormal columns
  Eigen::VectorXd tangent;  // of a held M: M tangent = (0, 1); empty where the springs alone solve this
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_FACTORISED_H_
