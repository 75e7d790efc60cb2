// The stiffness of a structure in which laws hold all that slides.
#ifndef CONTACT_PATH_STABILITY_HELD_STIFFNESS_H_
#define CONTACT_PATH_STABILITY_HELD_STIFFNESS_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "contact_path/linear/bordered_solver.h"
#include "contact_path/linear/frame.h"
#include "contact_path/linear/symmetric_factors.h"

namespace contact_path {

// K at fixed load factor, curvature of laws included, and the motions that the laws hold. Unknowns are u and behind it
// the forces of ports, in the order of the system without its load factor.
class HeldStiffness {
 public:
  // A motion of a port: of its force among the unknowns, and how far.
  struct Slip {
    Eigen::Index force;
    double length;
  };

  // motions: how many components u has. transposed: J' of the system; frame: of the system, or null. free: directions
  // du that are known to have no stiffness, columns; springs hold them. unique: whether the forces have to be. False
  // where it is singular, or a sign is lost.
  bool Set(Eigen::Index motions, const Eigen::SparseMatrix<double>& transposed, const Frame* frame,
           const Eigen::MatrixXd& free, bool unique);

  // Whether K is symmetric, and forces act along the motions that they hold.
  bool symmetric() const { return symmetric_; }
  // Negative eigenvalues of the symmetric part of K on what is not held.
  Eigen::Index negative() const { return negative_; }
  // Of det K.
  int sign() const { return sign_; }

  // By the forces f on u, and by each slip alone: columns of the unknowns. Empty where they are not found.
  Eigen::MatrixXd Responses(const Eigen::VectorXd& f, const std::vector<Slip>& slips) const;
  // What the unknowns weighed with `weights` change by, for a unit force on each component of u.
  Eigen::VectorXd Influence(const Eigen::VectorXd& weights) const;

  // Of the port with this force, by du.
  double Motion(Eigen::Index force, const Eigen::VectorXd& du) const { return forces_.col(force - nd_).dot(du); }
  // The largest stiffness where this force acts, times the motion du there squared.
  double EnergyAt(Eigen::Index force, const Eigen::VectorXd& du) const;
  // Norm of the stiffness against a unit motion of one component of u.
  double StiffnessOf(Eigen::Index dof) const { return stiffness_.col(dof).norm(); }
  // A motion along which the energy of K + machine f f' falls, among the softest ones, by inverse iterations of a
  // subspace; empty: none is found. likely: one of the motions to begin with, or empty.
  Eigen::VectorXd FallingMode(const Eigen::VectorXd& likely, const Eigen::VectorXd& f, double machine) const;

 private:
  Eigen::Index PlaceOf(Eigen::Index force) const { return places_[static_cast<std::size_t>(force - nd_)]; }
  // The unknowns, columns, for these right sides of the equations.
  Eigen::MatrixXd Solve(const Eigen::MatrixXd& right) const;
  void BuildSaddle(const Eigen::SparseMatrix<double>& transposed, const Frame* frame, const Eigen::MatrixXd& free);
  // Of each port that is held, whether its force acts along the gradient of its motion.
  bool ForcesActAlongMotions(const Eigen::SparseMatrix<double>& transposed) const;

  Eigen::Index nd_ = 0;
  // Of the forces in the saddle: where there is a frame, as there, and others are zero.
  std::vector<int> places_;
  Eigen::SparseMatrix<double> saddle_, stiffness_, forces_;  // symmetric K and columns of forces
  SymmetricFactors factors_;                                 // of the saddle
  // Where it is not symmetric.
  Eigen::SparseMatrix<double> transposed_;
  BorderedSolver unsymmetric_;
  bool symmetric_ = true;
  Eigen::Index negative_ = 0;
  int sign_ = 1;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STABILITY_HELD_STIFFNESS_H_
