// What has modes: a contact, say. The solvers know laws by their ports, the tables of their states, and their limits.
#ifndef CONTACT_PATH_LAW_LAW_H_
#define CONTACT_PATH_LAW_LAW_H_

#include <Eigen/Core>
#include <bitset>
#include <cstddef>
#include <vector>

#include "contact_path/law/active_set_tolerance.h"
#include "contact_path/law/mode.h"
#include "contact_path/law/ports.h"

namespace contact_path {

// What a port does in a state.
struct PortRule {
  enum class Kind {
    kFree,     // no force
    kHeld,     // motion - reference + compliance * force = 0, the force is an unknown
    kFollows,  // force = ratio * force of port 0
  };
  Kind kind = Kind::kFree;
  double ratio = 0.0;
  double compliance = 0.0;

  bool Holds() const { return kind == Kind::kHeld; }
  bool Follows() const { return kind == Kind::kFollows; }
};

// A limit of a state: what must stay >= 0, and the state beyond.
struct LimitRule {
  enum class Of {
    kMotion,      // sign * (motion - reference)
    kMotionRate,  // the rate of that, of a motion whose reference moves along
    kPiece,       // sign * (motion - Law::BoundOf()), the motion not from its reference: beyond is another piece
    kForces,      // sum of weight * force over the ports
  };
  int id = 0;  // another one for each limit of a state
  Of of = Of::kMotion;
  std::size_t port = 0;  // of a motion; of a piece also one beyond the ports, whose motion has no force
  double sign = 1.0;
  double compliance = 0.0;  // of a rate: times the force, part of the motion; what a port gives way by is no slip
  PortReals weights{};
  double unit = 1.0;  // what tolerances of values and rates are multiplied with
  int next = 0;       // state

  bool OfForces() const { return of == Of::kForces; }
  bool OfRate() const { return of == Of::kMotionRate; }
  bool OfPiece() const { return of == Of::kPiece; }
};

struct StateRule {
  std::array<PortRule, kMostPorts> ports{};
  std::vector<LimitRule> limits;
  int held = 0;           // the state that holds the ports that follow here, and is as this one otherwise; where none
                          // follows, this state itself
  bool symmetric = true;  // whether forces and equations have the same gradients, and no port follows
  bool idle = true;       // set by Law::SetLaw(): no port has a force
  bool slides = false;    // so is this: a port follows

  const LimitRule* Find(int id) const {
    for (const LimitRule& limit : limits)
      if (limit.id == id) return &limit;
    return nullptr;
  }
};

// A force that a law can have at rest: sums of such forces with weights >= 0 are all of them. force: of the ports, of
// the weight 1. The weight that the ray has in forces r of the ports is share . r.
struct Ray {
  PortReals force{}, share{};
};

// A law does not change: mode, forces and memory are of the point of the path. Its memory is a reference for each port,
// the motion from which the port's motion is measured; at the start of an arc it is a function of the place, and 0
// where the port gives way by a compliance of its own. The engine relies on this: one state is idle; port 0 is a gap,
// with a force >= 0, without a reference but that of ReferenceOf(), and held wherever a port follows; it does not
// dissipate. Ratios and compliances are constants of a state. A law of one state that is not idle has no limits, holds
// for ever, with forces of any sign, and has no memory.
// q stands for (dofs, s) throughout: m + 1 entries with m = Dofs(piece).size() <= kMostLawDofs, the load factor last. u
// may have more entries than dofs.
class Law {
 public:
  virtual ~Law() = default;

  std::size_t NumPorts() const { return traits_.num_ports; }
  const StateRule& In(int state) const { return states_[static_cast<std::size_t>(state)]; }
  const StateRule& In(const Mode& mode) const { return In(mode.state); }
  int NumStates() const { return static_cast<int>(states_.size()); }
  // A state in which all ports are held.
  int AllHeld() const;
  // Whether it can let go: a state is idle.
  bool CanBeIdle() const;
  // Of a limit that the state has.
  const LimitRule& Rule(int state, int id) const { return *In(state).Find(id); }

  // Of a known piece.
  virtual LawDofs Dofs(int /*piece*/) const { return traits_.dofs; }
  // Whether it couples unknowns that elements need not couple: then it has no place in a frame, and a system in which
  // it holds has none.
  bool Couples() const { return traits_.couples; }
  // Whether what it holds gives way: its forces are not redundant beside those of another law.
  bool Compliant() const { return traits_.compliant; }
  // The small compliance, of another law in series with it, that alone may tell its forces; 0: there is none.
  double ToldBy() const { return traits_.told_by; }
  // Whether its compliances are its own, and its forces functions of the place; otherwise compliances are there to make
  // reactions unique.
  bool Elastic() const { return traits_.elastic; }
  // Whether Hessians can be other than zero, or factors other than 1.
  bool Curved() const { return traits_.curved; }
  // Whether its forces follow the motion since the start of the program, and not since the last increment. Verdicts of
  // stability do not cover it.
  bool Holonomic() const { return traits_.holonomic; }
  // Whether the gradient of a port can be other than zero in the entry k of q: its sparsity.
  bool Moves(std::size_t port, std::size_t k) const { return traits_.moves[port][k]; }
  // An upper bound of |d Reach()| over |(du, ds)|; infinite where there is none.
  double LargestReachRate() const { return traits_.largest_reach_rate; }
  // A power of 2 up to 1, of the order of its forces where the parts that it is of are far softer than the structure as
  // a whole: forces are compared with tolerances times this force.
  double ForceUnit() const { return traits_.force_unit; }
  // Largest ratio of a port that follows, in any state.
  double LargestRatio() const { return traits_.largest_ratio; }

  // The ports at a place. piece: prolonged beyond its ends.
  virtual void Evaluate(const Eigen::VectorXd& u, double s, int piece, const PortReals& reference,
                        PortsAt* ports) const = 0;
  // The motion of one port. Where there is no such piece: something that has the sign of its limits.
  virtual double Motion(std::size_t port, const Eigen::VectorXd& u, double s, int piece,
                        const PortReals& reference) const;
  // *hessian = second derivatives by q of weights . (sum of force * factor * gradient over the ports), with constant
  // forces: m + 1 square, symmetric. Asked of curved laws only, as SecondDirectional().
  virtual void ForceHessian(const Eigen::VectorXd& u, double s, int piece, const PortReals& forces,
                            const LawVector& weights, LawMatrix* hessian) const;
  // d2/dh2 of the force along q + h direction at h = 0, by q; forces of the ports do not change. Where factors are 1
  // throughout, the force is a gradient, and this is ForceHessian() with the direction for weights, times the
  // direction.
  virtual LawVector SecondDirectional(const Eigen::VectorXd& u, double s, int piece, const PortReals& forces,
                                      const LawVector& direction) const;
  // The factor of a port and its first two derivatives by h along q + h first + h^2 / 2 second.
  virtual Eigen::Vector3d FactorAlong(std::size_t port, const Eigen::VectorXd& u, double s, int piece,
                                      const LawVector& first, const LawVector& second) const;
  // What a force of the port works along, from (u, s) on `piece` to (u + du, s + ds) on `piece_after`, and its rate.
  virtual double Travel(std::size_t port, const Eigen::VectorXd& u, double s, int piece, const Eigen::VectorXd& du,
                        double ds, int piece_after) const;
  double TravelRate(std::size_t port, const Eigen::VectorXd& u, double s, int piece, const Eigen::VectorXd& du,
                    double ds) const;

  // Those of ports that are held and give way by a compliance of their own; the others are 0.
  PortReals CompliantForces(const Eigen::VectorXd& u, double s, const Mode& mode) const;
  // Stored in the compliance of its ports [force length]: compliance * factor * force^2 / 2 each. What changes the
  // factor works on it (FixedModeSystem::DrivingForceAlong).
  virtual double EnergyAt(const Eigen::VectorXd& u, double s, const Mode& mode, const PortReals& forces) const;

  // References at a place from which an arc sets out.
  virtual PortReals ReferenceAt(const Eigen::VectorXd& u, double s, int piece) const = 0;
  // The same for the equations of ports that are held with these forces. Where compliances are not its own, the gap of
  // a law that touches to rounding is the reference of port 0: forces begin at nothing there.
  PortReals ReferenceOf(const Eigen::VectorXd& u, double s, const Mode& mode, const PortReals& forces) const;
  // How far an idle law is from its limit, for the search of what an increment may reach.
  virtual double Reach(const Eigen::VectorXd& u, double s) const = 0;

  // The modes that may follow at a point: one mode where nothing is at a limit. The mode of now comes first, if it is
  // among them.
  virtual Modes ModesAt(const Eigen::VectorXd& u, double s, const Mode& now, const PortReals& forces,
                        const ActiveSetTolerance& tolerance) const = 0;
  // The limits of a mode, and those of other pieces that are near an idle law: an increment is wanted there, and
  // nothing fails.
  virtual void AddLimits(const Mode& mode, int law, std::vector<Limit>* limits) const;
  virtual void AddNear(const Mode& /*mode*/, int /*law*/, std::vector<Limit>* /*limits*/) const {}
  // Where a piece ends, of a limit of the kind kPiece.
  virtual double BoundOf(const Mode& /*mode*/, int /*id*/) const { return 0.0; }
  // The mode beyond a limit; the piece of one that becomes idle or ceases to be so is for NextAt() to find. A piece may
  // be none: Exists().
  virtual Mode Next(const Mode& mode, int id) const { return {Rule(mode.state, id).next, mode.piece}; }
  virtual Mode NextAt(const Eigen::VectorXd& /*u*/, double /*s*/, const Mode& mode, int id) const {
    return Next(mode, id);
  }
  virtual bool Exists(const Mode& /*mode*/) const { return true; }
  // The mode in which a program starts at a place, without forces, and the mode in a state there.
  virtual Mode Initial(const Eigen::VectorXd& u, double s) const = 0;
  virtual Mode InState(const Eigen::VectorXd& /*u*/, double /*s*/, int state) const { return {state, 0}; }
  // The mode at the start of a step that comes along in `mode`: pieces may follow each other without an event.
  virtual Mode AtStart(const Eigen::VectorXd& /*u*/, double /*s*/, const Mode& mode) const { return mode; }
  // With a piece that is one: points need not know those of idle laws.
  virtual Mode Known(const Eigen::VectorXd& /*u*/, double /*s*/, const Mode& mode) const { return mode; }
  virtual Mode OfPoint(const Mode& mode) const { return mode; }
  // Whether an idle law is behind its limit, on another piece than that of its mode.
  virtual bool Passed(const Eigen::VectorXd& /*u*/, double /*s*/, const Mode& /*mode*/) const { return false; }
  // Whether curvatures change from one piece to the other.
  virtual bool ChangesPiece(int /*from*/, int /*to*/) const { return false; }
  // All forces at rest. Asked of what does not give way.
  virtual std::vector<Ray> Rays(const Eigen::VectorXd& u, double s, int piece,
                                const ActiveSetTolerance& tolerance) const = 0;

 protected:
  using Terms = std::bitset<kMostLawDofs + 1>;
  struct Traits {
    std::size_t num_ports = 1;
    LawDofs dofs;  // of all pieces, unless Dofs() is another function
    bool couples = false, compliant = false, elastic = false, curved = false, holonomic = false;
    std::array<Terms, kMostPorts> moves{};  // also of motions without a force
    double force_unit = 1.0;
    double largest_ratio = 0.0;
    double largest_reach_rate = 1.0;
    double told_by = 0.0;  // ToldBy()
  };
  const LawDofs& OwnDofs() const { return traits_.dofs; }
  // What does not change; set once, by the constructor. `idle` and `slides` follow from the ports.
  void SetLaw(const Traits& traits, std::vector<StateRule> states);

 private:
  Traits traits_;
  std::vector<StateRule> states_;
};

// bound: of the forces at play in a law (Structure::ForceBounds()). The smallest unit that is no less than it, and at
// most 1; more only where rounding makes forces uncertain, as Structure::ResidualUnits() tells of them. A power of 2,
// so that scaling by it is exact.
double ForceUnitAbove(double bound);

}  // namespace contact_path

#endif  // CONTACT_PATH_LAW_LAW_H_
