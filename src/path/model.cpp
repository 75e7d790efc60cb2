#include "contact_path/path/model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "contact_path/contact/scene_contacts.h"
#include "contact_path/scene/expand.h"

namespace contact_path {
namespace {

// Where the records have it: x0, y0, x1, ...
std::size_t PositionIndex(const DofMap::Component& position) {
  return static_cast<std::size_t>(kPositionComponents * position.node + position.component);
}

Laws AllLaws(const ContactPairs& contacts, const std::vector<std::unique_ptr<const SlackBar>>& bars,
             const std::vector<std::unique_ptr<const PinJoint>>& pins) {
  Laws laws = LawsOf(contacts);
  for (const auto& bar : bars) laws.Add(bar.get());
  for (const auto& pin : pins) laws.Add(pin.get());
  return laws;
}

double NumFree(const Model& model, int node) {
  double free = 0.0;
  for (const int axis : {0, 1}) free += model.structure.Dof(node, axis) >= 0 ? 1.0 : 0.0;
  return free + (model.structure.Dofs().Dof(node, Field::kRotation, 0) >= 0 ? 1.0 : 0.0);
}

}  // namespace

Model::Model(const Scene& scene_in, const Scaling& scaling_in)
    : Model(scene_in, Configuration::Of(scene_in), scaling_in) {}

Model::Model(const Scene& scene_in, const Configuration& configuration_in, const Scaling& scaling_in)
    : scene(scene_in),
      index(scene),
      configuration(configuration_in),
      scaling(scaling_in),
      origin(OriginOf(scene_in, scaling_in.length)),
      scaled(ScaleScene(CountedFrom(origin, scene_in), scaling_in)),
      scaled_configuration(CountedFrom(origin, configuration_in).Over(scaling.length)),
      structure(scaled, index, scaled_configuration),
      contacts(BuildContacts(scaled, index, structure, scaled_configuration.slip_origins)),
      bars(BuildSlackBars(scaled, index, structure, scaled_configuration.reference)),
      pins(BuildPins(scaled, index, structure, scaled_configuration.reference)),
      laws(AllLaws(contacts, bars, pins)),
      reactions(scaled, index, scaled_configuration, scaling),
      check(scene_in, configuration_in, scaling_in) {}

PathPoint Model::InitialPoint() const {
  PathPoint point;
  point.u = structure.Start();
  point.forces = Eigen::VectorXd::Zero(laws.NumPorts());
  for (std::size_t i = 0; i < laws.size(); ++i) {
    point.modes.push_back(laws[i].Initial(point.u, point.s));
    laws.Put(laws[i].CompliantForces(point.u, point.s, point.modes[i]), i, &point.forces);
  }
  return point;
}

Model::LoadSize Model::SizeOfLoads() const {
  double forces = 0.0, moments = 0.0;
  for (const DofMap::Component& of : structure.Dofs().Components()) {
    if (of.dof < 0) continue;
    double& sum = of.field == Field::kRotation ? moments : forces;
    sum += std::pow(structure.Loads().Reference()[of.dof], 2);
  }
  LoadSize size;
  if (forces + moments == 0.0) return size;
  size.norm = std::sqrt(forces > 0.0 ? forces : moments);
  if (forces > 0.0) size.unit_of_displacement = scaling.length;
  size.unit_of_stiffness =
      size.norm * size.norm * scaling.force * scaling.length / std::pow(size.unit_of_displacement, 2);
  return size;
}

std::vector<double> Model::ComponentsOf(const Eigen::VectorXd& u, const Eigen::VectorXd& motion) const {
  std::vector<double> components(configuration.start.size(), 0.0);
  for (const DofMap::Component& of : structure.Dofs().Components())
    if (of.field == Field::kPosition && of.dof >= 0)
      components[static_cast<std::size_t>(kPositionComponents * of.node + of.component)] = motion[of.dof];
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (!IsAttached(scene.nodes[i])) continue;
    const MovingPlace place(structure.PointOf(static_cast<int>(i)));
    const Eigen::Vector2d of_node = PlaceAt(place, u, 0.0).first * LocalOf(place.Dofs(), motion, 0.0);
    components[2 * i] = of_node.x();
    components[2 * i + 1] = of_node.y();
  }
  return components;
}

void Model::NotePieces(PathPoint* point) const {
  for (std::size_t i = 0; i < laws.size(); ++i)
    point->modes[i] = laws[i].InState(point->u, point->s, point->modes[i].state);
}

PathPoint Model::Transfer(const Model& other, const PathPoint& point) const {
  PathPoint taken = point;
  taken.s = 0.0;
  taken.u.resize(structure.NumDofs());
  const Eigen::VectorXd values = other.structure.AllValues(point.u);
  for (const DofMap::Component& to : structure.Dofs().Components())
    if (to.dof >= 0) taken.u[to.dof] = values[other.structure.Dofs().Index(to.node, to.field, to.component)];
  const std::vector<double> rt = other.TangentialReactions(point);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    SetReaction(i, NormalReaction(point, i), contacts[i]->FromRecord(taken.u, taken.s, rt[i]), &taken);
  NotePieces(&taken);  // an obstacle that has turned need not have them where they were
  return taken;
}

CheckedState Model::InSceneUnits(const PathPoint& point) const {
  CheckedState state;
  state.load_factor = point.s * scaling.load_factor;
  state.positions = configuration.start;
  if (HasRotations(scene)) state.rotations = configuration.start_rotations;
  const Eigen::VectorXd values = structure.AllValues(point.u);
  Eigen::Index k = 0;
  for (const DofMap::Component& from : structure.Dofs().Components()) {
    const double value = values[k++];
    if (from.dof < 0 && structure.AttachmentOf(from.node) == nullptr) {
      continue;
    } else if (from.field == Field::kRotation) {
      state.rotations[static_cast<std::size_t>(from.node)] = value;
    } else {
      state.positions[PositionIndex(from)] =
          value * UnitOf(from.field, scaling.length) + origin[static_cast<std::size_t>(from.component)];
    }
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) state.rn.push_back(NormalReaction(point, i) * scaling.force);
  for (const double rt : TangentialReactions(point)) state.rt.push_back(rt * scaling.force);
  for (const PortReals& forces : ForcesOfPins(point))
    state.pins.insert(state.pins.end(), {forces[0] * scaling.force, forces[1] * scaling.force});
  return state;
}

std::vector<double> Model::TangentialReactions(const PathPoint& point) const {
  std::vector<double> rt;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    rt.push_back(contacts[i]->OnRecord(point.u, point.s, TangentialReaction(point, i)));
  return rt;
}

PathPoint Model::FromIncrement(const Increment& increment) const {
  PathPoint point;
  point.s = increment.load_factor / scaling.load_factor;
  point.u.resize(structure.NumDofs());
  for (const DofMap::Component& to : structure.Dofs().Components())
    if (to.dof < 0) {
      continue;
    } else if (to.field == Field::kRotation) {
      point.u[to.dof] = increment.rotations[static_cast<std::size_t>(to.node)];
    } else {
      point.u[to.dof] = (increment.positions[PositionIndex(to)] - origin[static_cast<std::size_t>(to.component)]) /
                        UnitOf(to.field, scaling.length);
    }
  point.forces = Eigen::VectorXd::Zero(laws.NumPorts());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactRecord& contact = increment.contacts[i];
    SetReaction(i, contact.rn / scaling.force, contacts[i]->FromRecord(point.u, point.s, contact.rt / scaling.force),
                &point);
    point.modes.push_back({NumberOf(contact.state), 0});
  }
  for (std::size_t k = 0; k < bars.size(); ++k) {
    const std::size_t i = LawOfBar(k);
    point.modes.push_back({NumberOf(increment.bars[k]), 0});
    laws.Put(laws[i].CompliantForces(point.u, point.s, point.modes[i]), i, &point.forces);
  }
  for (std::size_t k = 0; k < pins.size(); ++k) {
    point.modes.push_back({});
    laws.Put({increment.pins[k].rx / scaling.force, increment.pins[k].ry / scaling.force}, LawOfPin(k), &point.forces);
  }
  NotePieces(&point);
  return point;
}

Reactions Model::ReactionsAt(const PathPoint& point) const {
  return reactions.At(structure.AllValues(point.u), point, ForcesOfPins(point));
}

std::string Model::NameOfLaw(std::size_t law) const {
  if (law < contacts.size()) return scene.contacts[law].Name();
  if (law < LawOfPin(0)) return OneSidedBars(scene)[law - LawOfBar(0)].name;
  const std::size_t pin = law - LawOfPin(0);
  return PinName(scene.pins.at(pin), pin);
}

std::vector<PortReals> Model::ForcesOfPins(const PathPoint& point) const {
  std::vector<PortReals> forces;
  forces.reserve(pins.size());
  for (std::size_t pin = 0; pin < pins.size(); ++pin) forces.push_back(laws.Of(point.forces, LawOfPin(pin)));
  return forces;
}

const ElementResponse& Model::Elements() const {
  if (elements_ == nullptr)
    elements_ = std::make_unique<const ElementResponse>(scaled, index, scaled_configuration, structure.Dofs(), scaling);
  return *elements_;
}

const PressureProblem& Model::PressuresOfContacts() const {
  if (pressures_ == nullptr)
    pressures_ = std::make_unique<const PressureProblem>(scaled, index, structure.Dofs(), scaling);
  return *pressures_;
}

Residuals Model::Check(const PathPoint& before, const PathPoint& now) const {
  return check.Check(InSceneUnits(before), InSceneUnits(now));
}

std::vector<BarState> Model::BarStatesIn(const Modes& modes) const {
  std::vector<BarState> states;
  for (std::size_t k = 0; k < bars.size(); ++k) states.push_back(static_cast<BarState>(modes[LawOfBar(k)].state));
  return states;
}

double AutomaticStepGrowth(const Model& model) {
  // Prescribed components do not count: how many there are depends on the axes.
  const double all =
      static_cast<double>(model.structure.NumDofs()) - static_cast<double>(model.structure.PrescribedDofs().size());
  double counted = all;
  for (const Beam& beam : model.scene.beams) {
    double inner = 0.0;
    for (std::size_t i = 1; i + 1 < beam.nodes.size(); ++i)
      inner += NumFree(model, static_cast<int>(model.index.Node(beam.nodes[i])));
    counted -= std::max(0.0, inner - kMostNodeComponents);
  }
  if (!(counted > 0.0)) return 1.0;
  return std::sqrt(all / counted * std::max(1.0, counted / 100.0));
}

}  // namespace contact_path
