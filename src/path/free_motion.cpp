#include "contact_path/path/free_motion.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <optional>

#include "contact_path/equations/rigid_modes.h"
#include "contact_path/linear/minimum_norm.h"
#include "contact_path/path/end.h"
#include "contact_path/scene/boundary_curve.h"
#include "contact_path/scene/text.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr Eigen::Index kMostMotions = 64;  // looked at
constexpr std::size_t kMostNames = 5;      // listed

using Triplets = std::vector<Eigen::Triplet<double>>;

// A row of the equations: gradient . du = 0.
void AddEquation(const LawDofs& dofs, const LawVector& gradient, int equation, Triplets* entries) {
  for (std::size_t k = 0; k < dofs.size(); ++k)
    entries->emplace_back(dofs[k], equation, gradient[static_cast<Eigen::Index>(k)]);
}

// Whether the limits of forces beyond which it is idle are not at zero.
bool Bears(const Law& law, const Mode& mode, const PortReals& forces, double tolerance) {
  for (const LimitRule& limit : law.In(mode).limits) {
    if (!limit.OfForces() || !law.In(limit.next).idle) continue;
    double value = 0.0;
    for (std::size_t p = 0; p < forces.size(); ++p) value += limit.weights[p] * forces[p];
    if (!(value > tolerance * limit.unit)) return false;
  }
  return true;
}

// What resists a motion du, one column an equation: tangent . du, supports, laws that bear.
Eigen::SparseMatrix<double> Resistance(const Model& model, const PathPoint& point, double force) {
  Eigen::SparseMatrix<double> tangent = model.structure.TangentPattern();
  model.structure.Tangent(point.u, &tangent);
  const double least = tolerances::kRegularPivot * tangent.coeffs().cwiseAbs().maxCoeff();
  Triplets entries;
  for (int column = 0; column < tangent.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(tangent, column); it; ++it)
      if (std::abs(it.value()) > least) entries.emplace_back(it.row(), column, it.value());
  auto equation = static_cast<int>(tangent.cols());
  for (const PrescribedDof& prescribed : model.structure.PrescribedDofs())
    entries.emplace_back(prescribed.dof, equation++, 1.0);
  for (std::size_t i = 0; i < model.laws.size(); ++i) {
    const Law& law = model.laws[i];
    const StateRule& state = law.In(point.modes[i]);
    if (state.idle || !Bears(law, point.modes[i], model.laws.Of(point.forces, i), force)) continue;
    PortsAt ports;
    law.Evaluate(point.u, point.s, point.modes[i].piece, {}, &ports);
    const LawMatrix change = ports.ForceChange(model.laws.Of(point.forces, i));
    for (std::size_t a = 0; law.Curved() && a < ports.dofs.size(); ++a)
      for (std::size_t b = 0; b < ports.dofs.size(); ++b)
        entries.emplace_back(ports.dofs[b], ports.dofs[a],
                             -change(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(a)));
    for (std::size_t p = 0; p < law.NumPorts(); ++p)
      if (law.In(state.held).ports[p].Holds()) AddEquation(ports.dofs, ports[p].gradient, equation++, &entries);
  }
  Eigen::SparseMatrix<double> resistance(tangent.rows(), equation);
  resistance.setFromTriplets(entries.begin(), entries.end());
  return resistance;
}

bool Has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// One word for one of them, another for several.
std::string Counted(const std::vector<std::string>& names, const char* one, const char* several) {
  return names.size() == 1 ? one : several;
}

// The gap of an open candidate. Of one that is on a surface and would touch if that went through its nodes straight
// from one to the next: the reason, that the smooth curve does not.
std::string NearestOpenText(const Model& model, const PathPoint& point, std::size_t contact, double gap) {
  const ContactCandidate& candidate = model.scene.contacts[contact];
  const double length = model.scaling.length;
  std::string text = "the nearest candidate is open: " + candidate.Name() + ", gap " + RoundedText(gap * length);
  if (!candidate.OnSurface()) return text;
  const std::vector<double> positions = model.InSceneUnits(point).positions;
  const auto place = [&](const std::string& name) {
    const std::size_t node = model.index.Node(name);
    return Eigen::Vector2d(positions[2 * node], positions[2 * node + 1]);
  };
  const BoundarySurface& surface = model.scene.surfaces[model.index.Surface(candidate.surface)];
  const Eigen::Vector2d x = place(candidate.node);
  std::vector<Eigen::Vector2d> places;
  for (const std::string& name : surface.nodes) places.push_back(place(name));
  std::size_t nearest = 0;
  double from_edges = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if ((x - places[i]).norm() < (x - places[nearest]).norm()) nearest = i;
    if (!surface.closed && i + 1 == places.size()) continue;
    const Eigen::Vector2d edge = places[(i + 1) % places.size()] - places[i], away = x - places[i];
    const double share = std::clamp(edge.dot(away) / edge.squaredNorm(), 0.0, 1.0);
    from_edges = std::min(from_edges, (away - share * edge).norm());
  }
  if (from_edges > surface.radius + tolerances::kTouching * length) return text;
  const std::array<int, 2> across = SymmetryAxes(surface, model.scene, [&](const std::string& name) -> const Node& {
    return model.scene.nodes[model.index.Node(name)];
  });
  const double off = std::abs(BoundaryCurve(places, surface.closed, 0.0, across).Nearest(places[nearest]).gap);
  return text + " (the smooth curve of surface " + surface.name + " passes " + RoundedText(off) + " from its node " +
         surface.nodes[nearest] + ")";
}

// Whether a node, or the body that it is of, is among those that move freely.
bool IsAmong(const std::vector<std::string>& free_nodes, const Model& model, const std::string& node) {
  return Has(free_nodes, node) || Has(free_nodes, model.scene.nodes[model.index.Node(node)].body);
}

// Of the candidates with a node that moves freely, or with a surface that has one, the nearest, where all are open.
std::string NearestOpen(const Model& model, const PathPoint& point, const std::vector<std::string>& free_nodes) {
  std::optional<std::size_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < model.scene.contacts.size(); ++i) {
    const ContactCandidate& candidate = model.scene.contacts[i];
    std::vector<std::string> nodes = {candidate.node};
    if (candidate.OnSurface()) {
      const BoundarySurface& surface = model.scene.surfaces[model.index.Surface(candidate.surface)];
      nodes.insert(nodes.end(), surface.nodes.begin(), surface.nodes.end());
    }
    if (std::none_of(nodes.begin(), nodes.end(),
                     [&](const std::string& node) { return IsAmong(free_nodes, model, node); }))
      continue;
    const double gap = model.contacts[i]->Gap(point.u, point.s, point.modes[i].piece);
    if (!(gap > tolerances::kActive)) return {};
    if (!(gap < least)) continue;
    least = gap;
    nearest = i;
  }
  return nearest ? NearestOpenText(model, point, *nearest, least) : std::string();
}

struct Names {
  std::vector<std::string> nodes, contacts, obstacles;
  std::vector<std::string> rough;  // of these obstacles, with their coefficients of friction
};

// Nodes that move freely, their contacts that touch, and the obstacles that these touch.
Names FreeNames(const Model& model, const PathPoint& point, double force) {
  Names names;
  const Scene& scene = model.scene;
  for (const int node : FreeNodes(model, point, force))
    names.nodes.push_back(scene.nodes[static_cast<std::size_t>(node)].name);
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const ContactCandidate& contact = scene.contacts[i];
    if (!IsAmong(names.nodes, model, contact.node) ||
        model.contacts[i]->Gap(point.u, point.s, point.modes[i].piece) > tolerances::kActive)
      continue;
    names.contacts.push_back(contact.Name());
    if (contact.OnSurface() || contact.at_eye) continue;
    if (!Has(names.obstacles, contact.obstacle)) names.obstacles.push_back(contact.obstacle);
    // Not every node can slide on a rough obstacle.
    const ContactPair& pair = *model.contacts[i];
    if (!pair.Frictional()) continue;
    const std::string rough =
        contact.obstacle + " (" + NumberText(pair.OnRecord(point.u, point.s, pair.Friction())) + ")";
    if (!Has(names.rough, rough)) names.rough.push_back(rough);
  }
  return names;
}

std::string TextOf(const Names& names) {
  if (names.nodes.empty()) return {};
  std::string text = Counted(names.nodes, "node ", "nodes ") + Listed(names.nodes, kMostNames) +
                     Counted(names.nodes, " moves freely", " move freely");
  if (!names.contacts.empty())
    text += "; " + Listed(names.contacts, kMostNames) + Counted(names.contacts, " touches", " touch");
  return text;
}

}  // namespace

std::vector<int> FreeNodes(const Model& model, const PathPoint& point, double force) {
  std::vector<int> nodes;
  try {
    MinimumNormSolver solver;
    const Eigen::SparseMatrix<double> resistance = Resistance(model, point, force);
    if (!solver.Factorize(resistance)) return nodes;
    const Eigen::Index motions = std::min(point.u.size() - solver.Rank(), kMostMotions);
    Eigen::VectorXd largest = Eigen::VectorXd::Zero(point.u.size());
    for (Eigen::Index k = 0; k < motions; ++k) largest = largest.cwiseMax(solver.NullVector(k).cwiseAbs());
    // In a fine mesh, the entries that are left out give a rigid motion of a part a resistance of its own.
    if (motions == 0) {
      const Eigen::SparseMatrix<double> held = resistance.rightCols(resistance.cols() - point.u.size());
      const Eigen::MatrixXd modes = RigidModes(model.structure).At(point.u, held);
      if (modes.cols() > 0) largest = modes.cwiseAbs().rowwise().maxCoeff();
    }
    for (std::size_t i = 0; i < model.scene.nodes.size(); ++i)
      for (const int axis : {0, 1}) {
        const int dof = model.structure.Dof(static_cast<int>(i), axis);
        if (dof < 0 || !(largest[dof] > tolerances::kSameTangent)) continue;
        nodes.push_back(static_cast<int>(i));
        break;
      }
  } catch (const std::bad_alloc&) {
    nodes.clear();  // nothing can be said
  }
  return nodes;
}

std::string FreeMotionText(const Model& model, const PathPoint& point, double force) {
  return TextOf(FreeNames(model, point, force));
}

std::string FreeMotionQuestion(const Model& model, const PathPoint& point, double force) {
  const Names names = FreeNames(model, point, force);
  if (names.nodes.empty()) return {};
  std::string question = "is a contact or a support missing?";
  if (const std::string open = NearestOpen(model, point, names.nodes); !open.empty())
    return TextOf(names) + "; " + open + ": " + question;
  if (!names.obstacles.empty())
    question = Counted(names.obstacles, "does the normal of ", "do the normals of ") +
               Listed(names.obstacles, kMostNames) + " point to the side where the " +
               Counted(names.contacts, "node", "nodes") + " may be? " + question;
  if (!names.rough.empty()) question += " is the friction of " + Listed(names.rough, kMostNames) + " too small?";
  return TextOf(names) + ": " + question;
}

}  // namespace contact_path
