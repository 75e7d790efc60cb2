#include "contact_path/verify/verify_path.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <unordered_map>

#include "contact_path/scene/scaling.h"

namespace contact_path {
namespace {

constexpr double kExact = 1e-9;        // of an exact row: all that should be zero, scaled
constexpr double kRegularised = 1e-5;  // of the others
constexpr double kRecorded = 1e-11;    // what was recorded, against what is computed anew: rounding, scaled
constexpr double kChord = 1e-9;        // relative: arc length against chord
constexpr double kEnergy = 1e-2;       // of the work done: energies are quadratures
constexpr double kTurn = 1e-9;         // of the load factor: a smaller change is none
constexpr double kLongestArc = 1.6;    // of its chord: a quarter of a circle and some more

class Verifier {
 public:
  Verifier(const Scene& scene, const std::vector<Increment>& rows)
      : scene_(scene), rows_(rows), scaling_(CharacteristicScales(scene)), check_(scene) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) nodes_.emplace(scene.nodes[i].name, i);
    for (const ContactCandidate& contact : scene.contacts) {
      const auto obstacle = std::find_if(scene.obstacles.begin(), scene.obstacles.end(),
                                         [&](const Obstacle& other) { return other.name == contact.obstacle; });
      const double length = std::hypot(obstacle->nx, obstacle->ny);
      surfaces_.push_back({nodes_.at(contact.node), obstacle->px, obstacle->py, obstacle->nx / length,
                           obstacle->ny / length, obstacle->friction, contact.Name()});
    }
  }

  Verification Run() {
    if (rows_.empty()) Report("the record has no rows");
    for (row_ = 0; row_ < rows_.size(); ++row_) {
      const Increment& row = Row();
      ++result_.rows;
      ++result_.kinds[row.kind];
      CheckPlace(row);
      if (!AllFinite(row)) {
        Report("a number is not finite");
        before_.reset();
        continue;
      }
      if (row_ > 0) CheckProgress(rows_[row_ - 1], row);
      if (!row.positions.empty()) {
        if (row.positions.size() != 2 * scene_.nodes.size() || row.contacts.size() != scene_.contacts.size()) {
          Report("the numbers of positions and contacts are not those of the scene");
          continue;
        }
        CheckState(row);
        before_ = row_;
      }
      CheckLimit();
    }
    CheckEnergy();
    return std::move(result_);
  }

 private:
  struct Surface {
    std::size_t node;
    double px, py, nx, ny, friction;
    std::string name;
  };

  const Increment& Row() const { return rows_[row_]; }

  template <typename... Parts>
  void Report(const Parts&... parts) {
    if (result_.findings.size() >= static_cast<std::size_t>(kMostFindings)) return;
    std::ostringstream text;
    text.precision(6);
    (text << ... << parts);
    result_.findings.push_back({static_cast<int>(row_), text.str()});
  }

  // What should be zero, or less.
  void Bound(const std::string& what, double value, double tolerance) {
    if (!(value <= tolerance)) Report(what, ": ", value, " > ", tolerance);
  }

  static bool AllFinite(const Increment& row) {
    bool finite = std::isfinite(row.load_factor) && std::isfinite(row.arc_length) && std::isfinite(row.dissipation) &&
                  std::isfinite(row.strain_energy) && std::isfinite(row.external_work);
    for (const double x : row.positions) finite = finite && std::isfinite(x);
    for (const ContactRecord& contact : row.contacts)
      finite = finite && std::isfinite(contact.gap) && std::isfinite(contact.rn) && std::isfinite(contact.rt);
    return finite;
  }

  void CheckPlace(const Increment& row) {
    if (row.index != static_cast<int>(row_)) Report("has the index ", row.index, ": rows are missing or out of order");
    if ((row.kind == RowKind::kStart) != (row_ == 0)) Report("is of the kind ", ToString(row.kind));
    if (row_ == 0 && (row.load_factor != 0.0 || row.arc_length != 0.0 || row.positions.empty()))
      Report("is no start: load factor and arc length are 0 there, and the state is recorded");
  }

  void CheckProgress(const Increment& before, const Increment& row) {
    if (row.arc_length < before.arc_length) Report("arc length falls from ", before.arc_length, " to ", row.arc_length);
    const double energy = scaling_.force * scaling_.length;
    Bound("dissipation falls", (before.dissipation - row.dissipation) / energy, kRecorded);
    result_.work += std::abs(row.external_work - before.external_work) / energy;
    const EventRecord& event = before.event;
    if (event.taken < -1 || event.taken >= static_cast<int>(event.ways.size()))
      Report("the way taken from the row before, ", event.taken, ", is none of its ", event.ways.size());
  }

  void CheckState(const Increment& row) {
    ++result_.full_rows;
    if (row.solve.exact) ++result_.exact_rows;
    const double tolerance = row.solve.exact ? kExact : kRegularised;
    const Increment& before = before_ ? rows_[*before_] : row;
    const Residuals residuals = check_.Check(StateOf(before), StateOf(row));
    Bound("equilibrium residual", residuals.equilibrium, tolerance);
    Bound("penetration", residuals.penetration, tolerance);
    Bound("adhesion", residuals.adhesion, tolerance);
    Bound("gap and reaction are both positive", residuals.complementarity, tolerance);
    Bound("reaction outside of the friction cone", residuals.cone, tolerance);
    Bound("friction law", residuals.friction_law, tolerance);
    Keep(residuals, row.solve.exact ? &result_.exact : &result_.regularised);
    CheckRecorded(row, residuals);
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      const Node& node = scene_.nodes[i];
      if ((node.fixed_x && row.positions[2 * i] != node.x) || (node.fixed_y && row.positions[2 * i + 1] != node.y))
        Report("fixed node ", node.name, " has moved");
    }
    for (std::size_t i = 0; i < surfaces_.size(); ++i) CheckContact(surfaces_[i], before, row, i, tolerance);
    if (before_) CheckPiece(before, row);
  }

  static void Keep(const Residuals& residuals, Residuals* largest) {
    for (double Residuals::*const field : {&Residuals::equilibrium, &Residuals::penetration, &Residuals::adhesion,
                                           &Residuals::complementarity, &Residuals::cone, &Residuals::friction_law})
      largest->*field = std::max(largest->*field, residuals.*field);
  }

  void CheckRecorded(const Increment& row, const Residuals& residuals) {
    const auto same = [&](const char* what, double recorded, double anew) {
      if (!(std::abs(recorded - anew) <= kRecorded * (1.0 + std::abs(anew))))
        Report(what, " is recorded as ", recorded, ", but is ", anew);
    };
    same("equilibrium residual", row.residuals.equilibrium, residuals.equilibrium);
    same("penetration residual", row.residuals.penetration, residuals.penetration);
    same("adhesion residual", row.residuals.adhesion, residuals.adhesion);
    same("min form residual", row.residuals.complementarity, residuals.complementarity);
    same("cone residual", row.residuals.cone, residuals.cone);
    // Depends on the row before, which may have been left out.
    if (row_ == 0 || before_ == row_ - 1)
      same("friction law residual", row.residuals.friction_law, residuals.friction_law);
    const double unit = scaling_.force * scaling_.length;
    same("scaled strain energy", row.strain_energy / unit, check_.StrainEnergy(row.positions) / unit);
  }

  void CheckContact(const Surface& surface, const Increment& before, const Increment& row, std::size_t i,
                    double tolerance) {
    const ContactRecord& contact = row.contacts[i];
    const double x = row.positions[2 * surface.node], y = row.positions[2 * surface.node + 1];
    const double gap = (surface.nx * (x - surface.px) + surface.ny * (y - surface.py)) / scaling_.length;
    Bound("recorded gap of " + surface.name + " less the true one", std::abs(contact.gap / scaling_.length - gap),
          kRecorded);
    const double slip = (surface.ny * (x - before.positions[2 * surface.node]) -
                         surface.nx * (y - before.positions[2 * surface.node + 1])) /
                        scaling_.length;
    const double rn = contact.rn / scaling_.force, rt = contact.rt / scaling_.force;
    const auto wrong = [&](const char* state) { Report(surface.name, " is recorded as ", state, ", but is not"); };
    switch (contact.state) {
      case ContactState::kOpen:
        if (std::max(std::abs(rn), std::abs(rt)) > tolerance) wrong("open");
        break;
      case ContactState::kClosed:
        if (std::abs(gap) > tolerance || std::abs(rt) > tolerance || surface.friction != 0.0) wrong("closed");
        break;
      case ContactState::kStick:
        if (std::abs(gap) > tolerance || std::abs(slip) > tolerance) wrong("sticking");
        break;
      case ContactState::kSlipPlus:
        if (std::abs(gap) > tolerance || slip < -tolerance || std::abs(rt + surface.friction * rn) > tolerance)
          wrong("slipping forwards");
        break;
      case ContactState::kSlipMinus:
        if (std::abs(gap) > tolerance || slip > tolerance || std::abs(rt - surface.friction * rn) > tolerance)
          wrong("slipping backwards");
        break;
    }
  }

  // The piece of path between two full rows.
  void CheckPiece(const Increment& before, const Increment& row) {
    double square = std::pow((row.load_factor - before.load_factor) / scaling_.load_factor, 2);
    for (std::size_t i = 0; i < row.positions.size(); ++i)
      square += std::pow((row.positions[i] - before.positions[i]) / scaling_.length, 2);
    const double chord = std::sqrt(square), arc = row.arc_length - before.arc_length;
    if (arc < chord * (1.0 - kChord) - kRecorded) Report("arc length grows by ", arc, ", less than the chord ", chord);
    if (before_ == row_ - 1 && arc > kLongestArc * chord + kRecorded)
      Report("arc length grows by ", arc, ", more than a curve with the chord ", chord, " would");

    // States: method branch has a row of its own where they change; a row of method mpec tells that they have.
    const bool branch = row.solve.method == Method::kBranch;
    bool changed = false;
    for (std::size_t i = 0; i < row.contacts.size(); ++i)
      changed = changed || row.contacts[i].state != before.contacts[i].state;
    const RowKind kind = branch ? before.kind : row.kind;
    if (changed && before_ != 0 && kind != RowKind::kContactEvent && kind != RowKind::kCornerLimit)
      Report("contact states change without an event");
    const EventRecord& event = before.event;
    if (event.taken < 0 || event.taken >= static_cast<int>(event.ways.size()) || before_ != row_ - 1) return;
    const std::vector<ContactState>& states = event.ways[static_cast<std::size_t>(event.taken)].states;
    bool as_taken = states.size() == row.contacts.size();
    for (std::size_t i = 0; as_taken && i < states.size(); ++i) as_taken = states[i] == row.contacts[i].state;
    if (!as_taken) Report("contact states are not those of the way taken from the row before");
  }

  // The load factor turns between the last three rows where a limit point is, and nowhere else.
  void CheckLimit() {
    if (row_ < 2) return;
    const Increment &a = rows_[row_ - 2], &b = rows_[row_ - 1], &c = rows_[row_];
    const double before = b.load_factor - a.load_factor, after = c.load_factor - b.load_factor;
    const double level = kTurn * scaling_.load_factor;
    // mpec tells in the row after.
    const Increment& located = c.solve.method == Method::kBranch ? b : c;
    const bool limit = located.kind == RowKind::kSmoothLimit || located.kind == RowKind::kCornerLimit;
    if (before * after < 0.0 && std::min(std::abs(before), std::abs(after)) > level && !limit)
      Report("the load factor turns without a limit point");
    if (before * after > 0.0 && std::min(std::abs(before), std::abs(after)) > level && limit)
      Report("the load factor does not turn at the limit point");
  }

  void CheckEnergy() {
    if (rows_.empty()) return;
    const double unit = scaling_.force * scaling_.length;
    const Increment& start = rows_.front();
    for (row_ = 0; row_ < rows_.size(); ++row_) {
      const Increment& row = Row();
      const double balance = (row.external_work - start.external_work - (row.strain_energy - start.strain_energy) -
                              (row.dissipation - start.dissipation)) /
                             unit;
      if (!(std::abs(balance) <= kEnergy * result_.work + kRecorded)) {
        Report("energy balance: ", balance, " of F L, with ", result_.work, " of work done on the whole path");
        return;
      }
      result_.energy_balance = std::max(result_.energy_balance, std::abs(balance));
    }
  }

  const Scene& scene_;
  const std::vector<Increment>& rows_;
  const Scaling scaling_;
  const ResidualCheck check_;
  std::unordered_map<std::string, std::size_t> nodes_;
  std::vector<Surface> surfaces_;
  std::size_t row_ = 0;                // being checked
  std::optional<std::size_t> before_;  // the last full row
  Verification result_;
};

}  // namespace

Verification VerifyPath(const Scene& scene, const std::vector<Increment>& rows) { return Verifier(scene, rows).Run(); }

}  // namespace contact_path
