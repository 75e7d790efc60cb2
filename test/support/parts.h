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

inline Load WeightOf(const std::string& body, double weight) {
  Load load = LoadOnBody(body, 0.0, 0.0, true);
  load.by = -weight;
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

inline TraceRequest RequestOf(const Scene& scene, const std::vector<Stage>& program) { return {scene, {}, program}; }

inline TraceRequest RequestUntil(const StopCriterion& stop, const Scene& scene) {
  TraceRequest request;
  request.scene = scene;
  request.options.stop = {stop};
  return request;
}

inline TraceRequest RequestWithin(int max_increments, const Scene& scene) {
  TraceRequest request;
  request.scene = scene;
  request.options.max_increments = max_increments;
  return request;
}

inline TraceRequest RequestUpToALimit(const Scene& scene, const std::vector<Stage>& program = {}) {
  TraceRequest request = RequestOf(scene, program);
  request.options.at_limit = AtLimit::kStop;
  return request;
}

// A node on springs of this stiffness along both axes, which touches the obstacle "floor" below it. Without loads.
inline Scene NodeOnFloor(const std::string& node, double stiffness, double friction) {
  Scene scene;
  scene.nodes = {{node, 0.0, 0.0}};
  scene.superelements = {{{node}, {stiffness, 0.0, 0.0, stiffness}}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction}};
  scene.contacts = {{node, "floor"}};
  return scene;
}

// The body "box" stands on the obstacle "floor" with the nodes "l" and "r", so far apart; its reference point is so
// high above their middle. Without loads.
inline Scene BoxOnFloor(double width, double height, double friction) {
  Scene scene;
  scene.bodies = {{"box", 0.0, height}};
  scene.nodes = {NodeOf("box", "l", -0.5 * width, 0.0), NodeOf("box", "r", 0.5 * width, 0.0)};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction}};
  scene.contacts = {{"l", "floor"}, {"r", "floor"}};
  return scene;
}

// A disc of this radius and weight in a right angle between two rough planes, turned by a moment of its weight times
// its radius: it turns in place from mu sqrt(2) / (1 + mu^2) on.
inline Scene DiscInARightAngle(double radius, double friction, double weight) {
  Scene scene;
  const double y = std::sqrt(2.0) * radius;
  scene.bodies = {{"disc", 0.0, y}};
  scene.obstacles = {Circle("rim", 0.0, y, radius, 0.0, "disc"),
                     {"left", ObstacleShape::kHalfPlane, 0.0, 0.0, 1.0, 1.0, friction},
                     {"right", ObstacleShape::kHalfPlane, 0.0, 0.0, -1.0, 1.0, friction}};
  scene.contacts = {Rolls("rim", "left"), Rolls("rim", "right")};
  scene.loads = {LoadOnBody("disc", 0.0, -weight, true), LoadOnBody("disc", 0.0, 0.0, false, weight * radius)};
  return scene;
}

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
