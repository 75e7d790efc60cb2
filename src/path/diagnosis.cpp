#include "contact_path/path/diagnosis.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "contact_path/path/sentences.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/solid_parts.h"
#include "contact_path/structure/scene_elements.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kMostGiven = 1e-6;             // of the characteristic length, by bodies and pins: as the check has it
constexpr double kNearlyIncompressible = 0.48;  // Poisson's ratio beyond which elements of few nodes lock

std::string SolidName(const Scene& scene, std::size_t i) {
  const std::string& name = scene.solids[i].name;
  return "solids[" + std::to_string(i) + "]" + (name.empty() ? name : " (" + name + ")");
}

// The sharpest curve of its obstacle on which a contact stands, or which begins where it stands. Scaled.
struct SharpestCurve {
  double curvature = 0.0;  // > 0 on both sides
  double size = 0.0;       // of the coordinates, of the node and along the obstacle
};

SharpestCurve SharpestAt(const ContactPair& pair, const PathPoint& point, int patch) {
  SharpestCurve sharpest;
  if (!pair.Curved()) return sharpest;
  const int known = pair.KnownPatch(point.u, point.s, patch);
  PortsAt ports;
  pair.Evaluate(point.u, point.s, known, {}, &ports);
  if (ports.dofs.empty()) return sharpest;
  const double xi = ports[pair.FootPort()].motion;
  const XiRange range = pair.RangeOf(known);
  const LawVector place = ports.Local(point.u, point.s);
  sharpest.size = std::max(std::abs(xi), place.head(place.size() - 1).lpNorm<Eigen::Infinity>());
  const auto look = [&](int at) {
    pair.Evaluate(point.u, point.s, at, {}, &ports);
    const auto dofs = static_cast<Eigen::Index>(ports.dofs.size());
    sharpest.curvature = std::max(sharpest.curvature, ports[kNormal].hessian.topLeftCorner(dofs, dofs).norm());
  };
  look(known);
  if (xi - range.begin <= tolerances::kTouching && pair.HasPatch(known - 1)) look(known - 1);
  if (range.end - xi <= tolerances::kTouching && pair.HasPatch(known + 1)) look(known + 1);
  return sharpest;
}

// By dof, the diagonal of the tangent (scaled): of the elements, of bars with a sense as if they bore, and of pins.
Eigen::VectorXd DiagonalStiffness(const Model& model, const PathPoint& point) {
  Eigen::SparseMatrix<double> tangent = model.structure.TangentPattern();
  model.structure.Tangent(point.u, &tangent);
  Eigen::VectorXd diagonal = tangent.diagonal().cwiseAbs();
  PortsAt at;
  for (std::size_t i = model.contacts.size(); i < model.laws.size(); ++i) {
    const Law& law = model.laws[i];
    const StateRule& held = law.In(law.AllHeld());
    law.Evaluate(point.u, point.s, point.modes[i].piece, {}, &at);
    for (std::size_t p = 0; p < law.NumPorts(); ++p)
      for (std::size_t a = 0; a < at.dofs.size() && held.ports[p].compliance > 0.0; ++a)
        diagonal[at.dofs[a]] += std::pow(at[p].gradient[static_cast<Eigen::Index>(a)], 2) / held.ports[p].compliance;
  }
  return diagonal;
}

// The largest one of the dofs that a contact moves; 0: it moves none.
double LargestOf(const Eigen::VectorXd& stiffness, const ContactPair& pair, const PathPoint& point, int patch) {
  double largest = 0.0;
  for (const int dof : pair.Dofs(pair.KnownPatch(point.u, point.s, patch))) largest = std::max(largest, stiffness[dof]);
  return largest;
}

// With which the parts at a contact resist that its gap at the start, which counts as closed there, is made 0 (scaled).
double ForceOfClosingAtStart(const Model& model, const PathPoint& point, std::size_t contact) {
  const ContactPair& pair = *model.contacts[contact];
  const double gap = std::abs(pair.Gap(model.structure.Start(), 0.0, kNearestPatch));
  if (!(gap <= tolerances::kTouching)) return 0.0;
  return tolerances::kMargin * gap *
         LargestOf(DiagonalStiffness(model, point), pair, point, point.modes[contact].piece);
}

// The element of a solid whose area has shrunk most at one of its integration points, if that is nearly to nothing.
Causes InvertedElement(const Scene& scene, const SceneIndex& index, const std::vector<double>& positions) {
  double smallest = tolerances::kSmallShare;
  Causes found;
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    const std::vector<PlacedElement> elements =
        MakeSolidElements(scene.solids[i], scene, index, Configuration::Of(scene).reference);
    for (std::size_t k = 0; k < elements.size(); ++k) {
      std::vector<double> x;
      for (const int node : elements[k].nodes) {
        const auto at = static_cast<std::size_t>(2 * node);
        x.insert(x.end(), {positions[at], positions[at + 1]});
      }
      const double ratio = elements[k].element->AreaRatio(
          Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())));
      if (!(ratio < smallest)) continue;
      smallest = ratio;
      found = {{sentences::kInvertedElement, std::to_string(k + 1) + " of " + SolidName(scene, i), smallest}};
    }
  }
  return found;
}

// Names an open contact whose node has come past an end of its boundary and is behind the boundary.
Causes BehindBoundary(const Model& model, const PathPoint& point) {
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const ContactPair& pair = *model.contacts[i];
    const bool ends = pair.Deformable() || (pair.HasPatches() && pair.Round() == 0.0);
    if (!ends || StateOf(point, i) != ContactState::kOpen) continue;
    const double gap = pair.Gap(point.u, point.s, kNearestPatch);
    if (gap < -tolerances::kTouching)
      return {{pair.Deformable() ? sentences::kBehindSurface : sentences::kBehindObstacle,
               model.scene.contacts[i].Name(), -gap * model.scaling.length}};
  }
  return {};
}

// Names a circle that has come upon a second part of the obstacle on which it rolls.
Causes TouchesTwice(const Model& model, const PathPoint& point) {
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    if (StateOf(point, i) == ContactState::kOpen) continue;
    if (model.contacts[i]->TouchesTwice(point.u, point.s, point.modes[i].piece))
      return {{sentences::kTouchesTwice, model.scene.contacts[i].Name()}};
  }
  return {};
}

// Names a contact of a rigid body, or a pin, that gives way by more than stands for the rigid.
Causes IsClamped(const Model& model, const PathPoint& point) {
  for (std::size_t i = 0; i < model.laws.size(); ++i) {
    if (model.laws[i].Elastic()) continue;
    double given = 0.0;
    for (std::size_t p = 0; p < model.laws[i].NumPorts(); ++p)
      given = std::hypot(given, model.laws[i].In(point.modes[i]).ports[p].compliance *
                                    point.forces[model.laws.FirstPort(i) + static_cast<Eigen::Index>(p)]);
    if (given <= kMostGiven) continue;
    return {{sentences::kIsClamped, (i < model.contacts.size() ? "contact " : "pin ") + model.NameOfLaw(i)}};
  }
  return {};
}

}  // namespace

Causes CollapsedPart(const Scene& scene, const SceneIndex& index, const std::vector<double>& positions) {
  double smallest = tolerances::kSmallShare;
  Causes found;
  const auto look = [&](const std::string& first, const std::string& second, sentences::Sentence sentence,
                        const std::string& part) {
    const std::size_t a = index.Node(first), b = index.Node(second);
    const double length = std::hypot(positions[2 * b] - positions[2 * a], positions[2 * b + 1] - positions[2 * a + 1]);
    const double initial = std::hypot(scene.nodes[b].x - scene.nodes[a].x, scene.nodes[b].y - scene.nodes[a].y);
    if (!(length < smallest * initial)) return;
    smallest = length / initial;
    found = {{sentence, part + " (" + first + ", " + second + ")", smallest}};
  };
  for (std::size_t i = 0; i < scene.bars.size(); ++i)
    if (const Bar& bar = scene.bars[i]; bar.sense != BarSense::kTension)
      look(bar.nodes[0], bar.nodes[1], sentences::kCollapsedBar, std::to_string(i));
  for (std::size_t i = 0; i < scene.tendons.size(); ++i)
    if (const Tendon& tendon = scene.tendons[i]; tendon.radii.empty())
      for (std::size_t k = 0; k + 1 < tendon.nodes.size(); ++k)
        look(tendon.nodes[k], tendon.nodes[k + 1], sentences::kCollapsedSpan, TendonName(tendon, i));
  return found;
}

void NameInvertedElement(const Model& model, const PathPoint& point, End* end) {
  if (!IsNumerical(end->reason)) return;
  Causes inverted = InvertedElement(model.scene, model.index, model.InSceneUnits(point).positions);
  if (inverted.empty()) return;
  Append(end->causes, &inverted);
  *end = {EndReason::kElementInverted, std::move(inverted)};
}

Causes LockingSolids(const Scene& scene, const SceneIndex& index) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    const Solid& solid = scene.solids[i];
    const double nu = PoissonRatio(LameOf(scene.materials[index.Material(solid.material)]));
    if (solid.NodesPerElement() > 4 || solid.plane != PlaneState::kStrain || !(nu > kNearlyIncompressible)) continue;
    names.push_back(SolidName(scene, i));
  }
  if (names.empty()) return {};
  return {{sentences::kLockingSolids, Listed(names)}};
}

Causes CurveTooSharp(const Model& model, const PathPoint& point) {
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const double rn = NormalReaction(point, i);
    if (!(rn > 0.0)) continue;
    const SharpestCurve at = SharpestAt(*model.contacts[i], point, point.modes[i].piece);
    const double turn = std::numeric_limits<double>::epsilon() * at.size * at.curvature;
    const double stiffness = rn * at.curvature, radius = model.scaling.length / at.curvature;
    const std::string name = model.scene.contacts[i].Name();
    if (turn * rn > tolerances::kResidual * (1.0 + rn)) return {{sentences::kCurveTurnsReaction, name, radius, turn}};
    if (stiffness > tolerances::kSmallShare / tolerances::kSingularPivot)
      return {{sentences::kCurveHidesStiffness, name, radius, stiffness}};
  }
  return {};
}

Causes HiddenSlip(const Model& model, const PathPoint& point) {
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const ContactPair& pair = *model.contacts[i];
    if (!pair.Curved() || !pair.Frictional()) continue;
    const double rn = NormalReaction(point, i), margin = pair.Friction() * rn - std::abs(TangentialReaction(point, i));
    if (!(rn > 0.0) || margin > tolerances::kAccepted * (1.0 + rn)) continue;
    const double curvature = SharpestAt(pair, point, point.modes[i].piece).curvature;
    // As it slides by dxi, the reaction turns by curvature * dxi, and the load has to follow.
    const double mu = pair.OnRecord(point.u, point.s, pair.Friction());
    const double load_rate = (1.0 + mu * mu) * rn * curvature;
    const double least = tolerances::kRate;
    if (!(load_rate > 1.0 / least)) continue;
    const std::string name = model.scene.contacts[i].Name();
    const double unit = model.scaling.length / model.scaling.load_factor;
    return {{sentences::kSlipSign, name, unit / load_rate, unit * least},
            {sentences::kOnCurve, name, model.scaling.length / curvature}};
  }
  return {};
}

Causes WhyRefused(const Model& model, const PathPoint& point, const Residuals& residuals) {
  Causes causes = CurveTooSharp(model, point);
  // check/ measures slip along the shorter way round: beyond half a round it changes its sign.
  const auto goes_round = [](const auto& contact) { return contact->Holonomic() && contact->Round() > 0.0; };
  if (residuals.friction_law > tolerances::kAccepted &&
      std::any_of(model.contacts.begin(), model.contacts.end(), goes_round))
    causes.push_back({sentences::kHalfRound});
  for (const Causes& found : {BehindBoundary(model, point), TouchesTwice(model, point), IsClamped(model, point)})
    Append(found, &causes);
  return causes;
}

Causes OverrunContact(const Model& model, const PathPoint& from, const PathPoint& to) {
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const ContactPair& pair = *model.contacts[i];
    if (!pair.Deformable() || StateOf(to, i) == ContactState::kOpen) continue;
    if (pair.Overrun(from.u, to.u, pair.KnownPatch(to.u, to.s, to.modes[i].piece)))
      return {{sentences::kOverrun, model.scene.contacts[i].Name()}};
  }
  return {};
}

Causes StandsAtEnd(const Model& model, const PathPoint& point) {
  std::vector<std::size_t> at_end;
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const ContactPair& pair = *model.contacts[i];
    if (!pair.HasPatches() || StateOf(point, i) == ContactState::kOpen) continue;
    const int patch = pair.KnownPatch(point.u, point.s, point.modes[i].piece);
    const double xi = pair.FootXi(point.u, point.s, patch);
    const XiRange range = pair.RangeOf(patch);
    if ((xi - range.begin <= tolerances::kTouching && !pair.HasPatch(patch - 1)) ||
        (range.end - xi <= tolerances::kTouching && !pair.HasPatch(patch + 1)))
      at_end.push_back(i);
  }
  if (at_end.empty()) return {};
  return {{at_end.size() == 1 ? sentences::kStandsAtEnd : sentences::kStandAtEnds,
           model.scene.contacts[at_end.front()].Name(), static_cast<long>(at_end.size()) - 1}};
}

std::optional<End> PullingContact(const Model& model, const PathPoint& point, double largest_reaction) {
  const double most = std::max(tolerances::kUnitComponent, tolerances::kSmallShare * largest_reaction);
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const double pull = -NormalReaction(point, i);
    const double unit = model.contacts[i]->ForceUnit();
    if (!(pull > most * unit) || pull <= ForceOfClosingAtStart(model, point, i)) continue;
    const double error = tolerances::kResidual * model.contacts[i]->NormalForceUnit();
    const std::string name = model.scene.contacts[i].Name();
    const double force = model.scaling.force;
    if (pull <= error)
      return End{EndReason::kNotDetermined, {{sentences::kReactionSign, name, -force * pull, force * error}}};
    return End{EndReason::kNumericalFailure, {{sentences::kPulls, name, force * pull, force * error}}};
  }
  return std::nullopt;
}

Causes ContactTooSoft(const Model& model, const PathPoint& point, double least) {
  const Eigen::VectorXd stiffness = DiagonalStiffness(model, point);
  const double unit = model.scaling.force / model.scaling.length;
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const double largest = LargestOf(stiffness, *model.contacts[i], point, point.modes[i].piece);
    if (largest > 0.0 && largest < least)
      return {{sentences::kStiffnessSign, model.scene.contacts[i].Name(), unit * largest, unit * least}};
  }
  return {};
}

}  // namespace contact_path
