// Parts of scenes of bodies and tendons.
#ifndef CONTACT_PATH_TEST_SUPPORT_PARTS_H_
#define CONTACT_PATH_TEST_SUPPORT_PARTS_H_

#include <cmath>
#include <string>

#include "contact_path/scene/scene.h"

namespace contact_path {

inline Load LoadOnBody(const std::string& body, double fx, double fy, bool constant = false, double moment = 0.0) {
  Load load;
  load.body = body;
  load.fx = fx;
  load.fy = fy;
  load.constant = constant;
  load.moment = moment;
  return load;
}

// From a fixed node through a fixed eye, round which it turns by `turn`, to a node that a force of 1 draws along the
// tendon in the stage `pull`.
inline TraceRequest DrawnCord(double turn, double friction, double EA) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "drawn_cord";
  const double c = std::cos(turn), s = std::sin(turn);
  scene.nodes = {{"end", -1.0, 0.0, true, true}, {"eye", 0.0, 0.0, true, true}, {"drawn", c, -s}};
  // Springs across keep the node on the line.
  scene.superelements = {{{"drawn"}, {s * s, s * c, s * c, c * c}}};
  Tendon cord;
  cord.name = "cord";
  cord.nodes = {"end", "eye", "drawn"};
  cord.EA = EA;
  cord.friction = friction;
  scene.tendons = {cord};
  Stage pull;
  pull.name = "pull";
  pull.loads = {{"drawn", c, -s}};
  request.program = {pull};
  request.options.record = {"sections"};
  return request;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_PARTS_H_
