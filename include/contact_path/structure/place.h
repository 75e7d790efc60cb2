// Where something is, as a function of unknowns: the chain rule of all that acts on places.
#ifndef CONTACT_PATH_STRUCTURE_PLACE_H_
#define CONTACT_PATH_STRUCTURE_PLACE_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "contact_path/structure/local_vector.h"

namespace contact_path {

// A number that is an unknown, or else held + rate s.
struct Coordinate {
  int dof = -1;  // -1: none
  double held = 0.0;
  double rate = 0.0;

  bool Moves() const { return dof >= 0 || rate != 0.0; }
};

// What is fixed to the frame and was at X at the start is at origin + about + R(angle) (X - start), R a rotation
// counterclockwise. A node is the origin of a frame of its own; a rigid body is a frame, and an obstacle that moves.
struct MovingFrame {
  std::array<Coordinate, 2> origin;                 // x, y [length]
  Coordinate angle = {};                            // [rad]
  Eigen::Vector2d about = Eigen::Vector2d::Zero();  // [length]
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  // [length]
};

struct FixedPoint {
  MovingFrame frame;
  Eigen::Vector2d arm = Eigen::Vector2d::Zero();  // X - start [length]
};

// x(q) of q = (dofs, s): a constant and one or two terms R(angle(q)) z(q), both affine in q.
class MovingPlace {
 public:
  // By entries of q.
  using Motion = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kMostLawDofs + 1>;

  // Where a point is.
  explicit MovingPlace(const FixedPoint& point);
  // From one point to the other.
  static MovingPlace Between(const FixedPoint& from, const FixedPoint& to);
  // Where the point would have been at the start if it were fixed to the frame.
  static MovingPlace SeenFrom(const MovingFrame& frame, const FixedPoint& point);

  const LawDofs& Dofs() const { return dofs_; }
  // Whether no frame turns: At() then is Constant() + ConstantGradient() * q.
  bool Affine() const;
  Eigen::Vector2d Constant() const { return constant_ + terms_.front().held - terms_.front().about; }
  const Motion& ConstantGradient() const { return terms_.front().motion; }
  // Whether the place can change with the entry k of q.
  bool Moves(Eigen::Index k) const;
  Eigen::Vector2d At(const Eigen::VectorXd& u, double s) const;

 private:
  friend class PlaceAt;
  // R(angle) z with z = held + motion q - about, R a rotation by the angle `angle` + rate (turn . q).
  struct Term {
    Eigen::Vector2d held = Eigen::Vector2d::Zero(), about = Eigen::Vector2d::Zero();
    Motion motion;
    double angle = 0.0, rate = 1.0;
    LawVector turn;
    bool turns = false;

    Eigen::Vector2d Arm(const LawVector& q) const { return held + motion * q - about; }
    Eigen::Matrix2d Rotation(const LawVector& q) const;
  };

  // from, seen_from: may be null.
  MovingPlace(const FixedPoint* from, const FixedPoint& to, const MovingFrame* seen_from);
  Term NewTerm() const;
  // sign times the origin of the frame, or times its angle.
  void AddOrigin(const MovingFrame& frame, double sign, Term* term) const;
  void AddAngle(const Coordinate& angle, double sign, Term* term) const;
  // sign times the arm of the point; seen_from: may be null.
  void AddArm(const FixedPoint& point, double sign, const MovingFrame* seen_from);
  void Add(Term term);
  Eigen::Index EntryOf(int dof) const;

  LawDofs dofs_;
  std::vector<Term> terms_;
  Eigen::Vector2d constant_ = Eigen::Vector2d::Zero();
};

// A place and its derivatives at a point, and those of functions of the place.
class PlaceAt {
 public:
  PlaceAt(const MovingPlace& place, const Eigen::VectorXd& u, double s);

  Eigen::Vector2d x;
  MovingPlace::Motion first;  // dx/dq

  // Second derivatives by q of weights . x.
  LawMatrix Second(const Eigen::Vector2d& weights) const;
  // d/dh along q + h direction of the first derivatives, and of the second ones.
  MovingPlace::Motion FirstChange(const LawVector& direction) const;
  LawMatrix SecondChange(const Eigen::Vector2d& weights, const LawVector& direction) const;

  // Of a function of x with this gradient and Hessian: second derivatives by q.
  LawMatrix Hessian(const Eigen::Vector2d& gradient, const Eigen::Matrix2d& hessian) const;
  // d/dh of that along q + h direction. change: d/dh of the Hessian by x.
  LawMatrix HessianChange(const Eigen::Vector2d& gradient, const Eigen::Matrix2d& hessian,
                          const Eigen::Matrix2d& change, const LawVector& direction) const;

 private:
  struct Turned {
    const MovingPlace::Term* term = nullptr;
    std::array<Eigen::Matrix2d, 4> rotation;  // R, and its derivatives by turn . q
    Eigen::Vector2d arm;                      // z
  };

  std::vector<Turned> turned_;  // empty where no frame turns
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_PLACE_H_
