#include "contact_path/path/model.h"

#include "contact_path/contact/scene_contacts.h"

namespace contact_path {
namespace {

// A candidate closer than this touches: rounding of the scene's coordinates. Scaled length.
constexpr double kTouching = 1e-9;

}  // namespace

Model::Model(const Scene& scene_in, const Scaling& scaling_in)
    : scene(scene_in),
      scaling(scaling_in),
      scaled(ScaleScene(scene_in, scaling_in)),
      structure(scaled),
      contacts(BuildContacts(scaled, structure)),
      check(scene_in, scaling_in) {}

PathPoint Model::InitialPoint() const {
  PathPoint point;
  point.u = structure.InitialPositions();
  point.rn = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(contacts.size()));
  point.rt = point.rn;
  for (const auto& contact : contacts) {
    const bool touches = contact->Gap(point.u, point.s) <= kTouching;
    const ContactState rest = contact->Frictional() ? ContactState::kStick : ContactState::kClosed;
    point.states.push_back(touches ? rest : ContactState::kOpen);
  }
  return point;
}

PathPoint Model::Transfer(const Model& other, const PathPoint& point) const {
  PathPoint taken = point;
  taken.s = 0.0;
  taken.u.resize(structure.NumDofs());
  const Eigen::VectorXd positions = other.structure.FullPositions(point.u);
  for (int node = 0; node < static_cast<int>(scene.nodes.size()); ++node)
    for (const int axis : {0, 1})
      if (const int dof = structure.Dof(node, axis); dof >= 0) taken.u[dof] = positions[2 * node + axis];
  return taken;
}

CheckedState Model::InSceneUnits(const PathPoint& point) const {
  CheckedState state;
  state.load_factor = point.s * scaling.load_factor;
  state.positions.reserve(2 * scene.nodes.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int dof_x = structure.Dof(static_cast<int>(i), 0), dof_y = structure.Dof(static_cast<int>(i), 1);
    state.positions.push_back(dof_x < 0 ? scene.nodes[i].x : point.u[dof_x] * scaling.length);
    state.positions.push_back(dof_y < 0 ? scene.nodes[i].y : point.u[dof_y] * scaling.length);
  }
  for (Eigen::Index i = 0; i < point.rn.size(); ++i) {
    state.rn.push_back(point.rn[i] * scaling.force);
    state.rt.push_back(point.rt[i] * scaling.force);
  }
  return state;
}

PathPoint Model::FromIncrement(const Increment& increment) const {
  PathPoint point;
  point.s = increment.load_factor / scaling.load_factor;
  point.u.resize(structure.NumDofs());
  for (int i = 0; i < static_cast<int>(increment.positions.size()); ++i)
    if (const int dof = structure.Dof(i / 2, i % 2); dof >= 0)
      point.u[dof] = increment.positions[static_cast<std::size_t>(i)] / scaling.length;
  const auto count = static_cast<Eigen::Index>(increment.contacts.size());
  point.rn.resize(count);
  point.rt.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const ContactRecord& contact = increment.contacts[static_cast<std::size_t>(i)];
    point.rn[i] = contact.rn / scaling.force;
    point.rt[i] = contact.rt / scaling.force;
    point.states.push_back(contact.state);
  }
  return point;
}

Residuals Model::Check(const PathPoint& before, const PathPoint& now) const {
  return check.Check(InSceneUnits(before), InSceneUnits(now));
}

}  // namespace contact_path
