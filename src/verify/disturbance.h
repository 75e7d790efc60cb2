// Whether a disturbance of an equilibrium grows, found with dense matrices: apart from stability/ on purpose.
#ifndef CONTACT_PATH_SRC_VERIFY_DISTURBANCE_H_
#define CONTACT_PATH_SRC_VERIFY_DISTURBANCE_H_

#include <Eigen/Dense>
#include <cstddef>
#include <optional>
#include <vector>

#include "contact_path/stability/verdict.h"

namespace contact_path {

// What slides, at the edge of its cone: v moves it by z >= 0 along its sense, and sense rho_along + friction rho_across
// + by_place . v, by which friction has grown beyond what acts, is >= 0, and 0 where z > 0.
struct Sliding {
  Eigen::Index along = 0;
  std::optional<Eigen::Index> across;  // nothing where the place tells the normal force
  double sense = 1.0;
  double friction = 0.0;
  Eigen::VectorXd by_place;  // change of the largest friction force by v; empty: none
  Eigen::VectorXd change;    // of by_place with twice the step of its differences
};

// All scaled. Of motions v and changes rho of reactions: stiffness v = held rho.
struct Disturbed {
  Eigen::MatrixXd stiffness;  // with all reactions as they are
  Eigen::MatrixXd change;     // of the stiffness with twice the step of its differences
  // By reaction: the forces of a unit of it, which measure the motion that it holds, held . v + give rho = 0.
  Eigen::MatrixXd held;
  Eigen::VectorXd give;  // 0: it is rigid
  std::vector<Sliding> sliding;
};

// The motions that are left where everything is held, what slides included. A direction that springs of what gives way
// hold, far stiffer than the structure, follows the others.
class FreeMotions {
 public:
  explicit FreeMotions(const Disturbed& of);

  const Eigen::MatrixXd& Stiffness() const { return stiffness_; }  // of the motions that are left
  bool Symmetric() const { return symmetric_; }
  int Falling() const { return falling_; }  // the number of negative eigenvalues
  // Eigenvalue, or entry of the stiffness of all motions where this is larger.
  double Largest() const { return largest_; }
  // Of that: the smallest eigenvalue, and the error of differences.
  double Smallest() const { return smallest_; }
  double Off() const { return off_; }
  // Whether the signs of all eigenvalues are beyond their errors.
  bool Told() const { return stiffness_.rows() == 0 || smallest_ > kNearSingular + off_; }
  // What is left of forces, by the motions that are left.
  Eigen::VectorXd Of(const Eigen::VectorXd& forces) const { return motions_.transpose() * forces; }
  // force . v of the motion v by the force.
  double Compliance(const Eigen::VectorXd& force) const;

  static constexpr double kNearSingular = 1e-7;

 private:
  Eigen::MatrixXd motions_, stiff_, stiffness_;  // motions: columns
  Eigen::MatrixXd of_stiff_;                     // inverse of the stiffness of what is stiff
  bool symmetric_ = true;
  int falling_ = 0;
  double largest_ = 0.0, smallest_ = 0.0, off_ = 0.0;
};

// By the criteria of method.md; nothing where rounding and differences leave it open, or where too much slides.
std::optional<Verdict> VerdictOf(const Disturbed& of, const FreeMotions& free);

// Whether z . H z > 0 for all z >= 0 other than 0: for no principal submatrix H_I does H_I x = e, the last column of
// the identity, have a solution x < 0 (Keller; Cottle, Habetler & Lemke 1970).
bool PositiveOnCone(const Eigen::MatrixXd& H);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_DISTURBANCE_H_
