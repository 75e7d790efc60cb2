// A piece of a string from one round roller to the next.
#ifndef CONTACT_PATH_GEOMETRY_ROLLED_SPAN_H_
#define CONTACT_PATH_GEOMETRY_ROLLED_SPAN_H_

#include <Eigen/Core>

namespace contact_path {

// A string that goes round circles, of the radius |rho| counterclockwise where rho > 0, clockwise where rho < 0,
// leaves one and comes to the next at the angle theta, with d = l e + delta e', e = (cos theta, sin theta), e' = e
// turned by a quarter to the left, d from centre to centre, delta = rho_2 - rho_1 and the free length l. The arcs
// rho (theta_out - theta_in) of all circles are the sum of -delta theta over the spans, so that each span adds
// f(d) = l - delta (theta - theta_0) to the length. Its gradient is e, its Hessian e' e'^T / l.
class RolledSpan {
 public:
  RolledSpan() = default;  // without radii: f is the distance
  // rho: of the first circle and the second one [length]; start: d at the start, longer than |delta|. arcs: what
  // belongs to the span of the arcs at the start [length].
  RolledSpan(double rho_1, double rho_2, const Eigen::Vector2d& start, double arcs);

  double Delta() const { return delta_; }
  const Eigen::Vector2d& StartDirection() const { return direction_; }  // e at the start
  double Arcs() const { return arcs_; }

  struct At {
    Eigen::Vector2d tangent;  // l e
    double arcs = 0.0;        // f - l, with those at the start
  };
  // least: a shorter l counts as this one.
  At Of(const Eigen::Vector2d& d, double least) const;
  // d/dh of l e along d + h v.
  Eigen::Vector2d TangentChange(const Eigen::Vector2d& tangent, const Eigen::Vector2d& v) const;
  // theta - theta_0, between -pi and pi.
  double Turned(const Eigen::Vector2d& tangent) const;

 private:
  double delta_ = 0.0, arcs_ = 0.0;
  Eigen::Vector2d direction_ = Eigen::Vector2d::Zero();
};

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_ROLLED_SPAN_H_
