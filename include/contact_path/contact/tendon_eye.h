// An eye through which a tendon slides with friction.
#ifndef CONTACT_PATH_CONTACT_TENDON_EYE_H_
#define CONTACT_PATH_CONTACT_TENDON_EYE_H_

#include <Eigen/Core>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/law/tendon_span.h"

namespace contact_path {

// The tensions T1 before and T2 behind an eye round which the tendon turns by phi, or is wrapped, differ by at most
// |T2 - T1| <= tanh(mu phi / 2) (T1 + T2), that is exp(-mu phi) <= T2 / T1 <= exp(mu phi). As a contact: port 0 has the
// force N = T1 + T2, which is a function of the place and acts on nothing, and the motion -c N, the gap where the
// tendon is slack; port 1 has for its motion w, what has slid from the span before to the span behind [length], and a
// force of which |force| <= N, with the factor tanh(mu phi / 2) (1 + N / (2 EA)): with the factor it is
// T1 + T1^2 / (2 EA) - T2 - T2^2 / (2 EA), since a string that stretches slides faster where it bears more. Where
// the tendon is nearly straight phi is rounded, phi + e ln(1 + exp(-2 phi / e)) with e = 1e-3, so that it has
// derivatives there, and the equations are regular where it comes off a roller: from 0.02 on by nothing that shows.
class TendonEye : public ContactPair {
 public:
  // Round which the tendon is wrapped by phi = wrapped + sense (what the spans turn by since the start). sense: 1
  // counterclockwise, -1 clockwise; 0: an eye without a radius, phi > 0 as an angle between the spans.
  struct Roller {
    double sense = 0.0;
    double wrapped = 0.0;  // at the start [rad], > 0
  };
  // before, behind: of one tendon. slid: dof >= 0, of both. friction: mu > 0.
  TendonEye(const TendonSpan& before, const TendonSpan& behind, const Coordinate& slid, double friction,
            const Roller& roller);

  void Evaluate(const Eigen::VectorXd& u, double s, int piece, const PortReals& reference,
                PortsAt* ports) const override;
  void ForceHessian(const Eigen::VectorXd& u, double s, int piece, const PortReals& forces, const LawVector& weights,
                    LawMatrix* hessian) const override;
  LawVector SecondDirectional(const Eigen::VectorXd& u, double s, int piece, const PortReals& forces,
                              const LawVector& direction) const override;
  Eigen::Vector3d FactorAlong(std::size_t port, const Eigen::VectorXd& u, double s, int piece, const LawVector& first,
                              const LawVector& second) const override;
  double Travel(std::size_t port, const Eigen::VectorXd& u, double s, int piece, const Eigen::VectorXd& du, double ds,
                int piece_after) const override;
  double EnergyAt(const Eigen::VectorXd& /*u*/, double /*s*/, const Mode& /*mode*/,
                  const PortReals& /*forces*/) const override {
    return 0.0;  // the spans have it
  }
  // T1 - T2 of a force of port 1, and that force of T1 - T2.
  double OnRecord(const Eigen::VectorXd& u, double s, double force) const override;
  double FromRecord(const Eigen::VectorXd& u, double s, double reaction) const override;

  double Gap(const Eigen::VectorXd& u, double s, int piece) const override;
  // By how much the pieces are longer at rest than from node to node.
  double GapOnRecord(const Eigen::VectorXd& u, double s, int piece) const override;
  NearestFoot Nearest(const Eigen::VectorXd& u, double s) const override { return {0, Gap(u, s, 0), false}; }

 private:
  struct Function {
    double value;
    LawVector gradient;
    LawMatrix hessian;
  };
  struct Place {
    Function sum, share;  // N, the factor of port 1
  };
  Place At(const Eigen::VectorXd& u, double s) const;
  Eigen::Index SlidEntry() const;

  TendonSpan before_, behind_;
  Coordinate slid_;
  double friction_;
  Roller roller_;
  double compliance_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_TENDON_EYE_H_
