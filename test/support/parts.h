// Parts of scenes that tests make.
#ifndef CONTACT_PATH_TEST_SUPPORT_PARTS_H_
#define CONTACT_PATH_TEST_SUPPORT_PARTS_H_

#include <cmath>
#include <string>
#include <vector>

#include "contact_path/scene/scene.h"

namespace contact_path {

inline Load LoadOnBody(const std::string& body, double fx, double fy, bool constant = false, double moment = 0.0) {
  Load load{"", fx, fy, constant, moment};
  load.body = body;
  return load;
}

// Dead traction on a beam or a boundary, per initial length.
inline Load LoadOnGroup(const std::string& group, double px, double py, bool constant = false) {
  Load load;
  load.group = group;
  load.px = px;
  load.py = py;
  load.constant = constant;
  return load;
}

inline Node NodeOf(const std::string& body, const std::string& name, double x, double y) {
  return {name, x, y, false, false, false, body};
}

// Of a body, where one is named.
inline Obstacle Circle(const std::string& name, double x, double y, double radius, double friction,
                       const std::string& body = "") {
  Obstacle circle{name, ObstacleShape::kCircle, x, y, 0.0, 0.0, friction, radius};
  circle.body = body;
  return circle;
}

// The rim of a body on another obstacle.
inline ContactCandidate Rolls(const std::string& rim, const std::string& partner) {
  ContactCandidate contact;
  contact.obstacles = {rim, partner};
  return contact;
}

// target: load factor at the end; 0: 1.
inline Stage LoadingStage(const std::vector<Load>& loads, double target = 0.0) { return {"", loads, {}, {}, target}; }

inline Stage MovingStage(const std::vector<SupportMotion>& supports, double target = 0.0) {
  return {"", {}, supports, {}, target};
}

// part: of what is left; 0: all.
inline Stage UnloadingStage(double part = 0.0) { return {"", {}, {}, {}, part, true}; }

// From a fixed node through a fixed eye, round which it turns by `turn`, to a node that a force of 1 draws along the
// tendon.
inline TraceRequest DrawnCord(double turn, double friction, double EA) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "drawn_cord";
  const double c = std::cos(turn), s = std::sin(turn);
  scene.nodes = {{"end", -1.0, 0.0, true, true}, {"eye", 0.0, 0.0, true, true}, {"drawn", c, -s}};
  // Springs across keep the node on the line.
  scene.superelements = {{{"drawn"}, {s * s, s * c, s * c, c * c}}};
  scene.tendons = {{"cord", {"end", "eye", "drawn"}, EA, 0.0, friction}};
  request.program = {LoadingStage({{"drawn", c, -s}})};
  request.options.record = {"sections"};
  return request;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_PARTS_H_
