#include "contact_path/path/model.h"

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
      check(scene_in) {}

PathPoint Model::InitialPoint() const {
  PathPoint point;
  point.u = structure.InitialPositions();
  point.rn = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(contacts.size()));
  point.rt = point.rn;
  for (const ContactGeometry& contact : contacts) {
    const bool touches = contact.gap.Value(point.u) <= kTouching;
    const ContactState rest = contact.Frictional() ? ContactState::kStick : ContactState::kClosed;
    point.states.push_back(touches ? rest : ContactState::kOpen);
  }
  return point;
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

Residuals Model::Check(const PathPoint& before, const PathPoint& now) const {
  return check.Check(InSceneUnits(before), InSceneUnits(now));
}

}  // namespace contact_path
