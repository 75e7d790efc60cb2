#include "support/same_request.h"

#include <cstddef>
#include <string>
#include <vector>

namespace contact_path {
namespace {

template <typename Value>
bool Same(const Value& a, const Value& b) {
  return a == b;
}

bool Same(double a, double b) { return a == b || (a != a && b != b); }

bool Same(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!Same(a[i], b[i])) return false;
  return true;
}

class Comparison {
 public:
  std::string Run(const TraceRequest& a, const TraceRequest& b) {
    Compare("scene", a.scene, b.scene);
    Compare("options", a.options, b.options);
    List("program", a.program, b.program);
    return first_;
  }

 private:
  template <typename Value>
  void Field(const std::string& key, const Value& a, const Value& b) {
    if (first_.empty() && !Same(a, b)) first_ = key;
  }

  template <typename Part>
  void List(const std::string& key, const std::vector<Part>& a, const std::vector<Part>& b) {
    Field("size of " + key, a.size(), b.size());
    for (std::size_t i = 0; first_.empty() && i < a.size(); ++i)
      Compare(key + "[" + std::to_string(i) + "]", a[i], b[i]);
  }

  void Compare(const std::string& key, const Node& a, const Node& b) {
    Field(key + ".name", a.name, b.name);
    Field(key + ".x", a.x, b.x);
    Field(key + ".y", a.y, b.y);
    Field(key + ".fixed_x", a.fixed_x, b.fixed_x);
    Field(key + ".fixed_y", a.fixed_y, b.fixed_y);
  }
  void Compare(const std::string& key, const Bar& a, const Bar& b) {
    Field(key + ".nodes", a.nodes, b.nodes);
    Field(key + ".EA", a.EA, b.EA);
    Field(key + ".rest_length", a.rest_length, b.rest_length);
    Field(key + ".strain", a.strain, b.strain);
  }
  void Compare(const std::string& key, const Superelement& a, const Superelement& b) {
    Field(key + ".nodes", a.nodes, b.nodes);
    Field(key + ".stiffness", a.stiffness, b.stiffness);
    Field(key + ".rest_positions", a.rest_positions, b.rest_positions);
  }
  void Compare(const std::string& key, const Load& a, const Load& b) {
    Field(key + ".node", a.node, b.node);
    Field(key + ".fx", a.fx, b.fx);
    Field(key + ".fy", a.fy, b.fy);
    Field(key + ".constant", a.constant, b.constant);
  }
  void Compare(const std::string& key, const Obstacle& a, const Obstacle& b) {
    Field(key + ".name", a.name, b.name);
    Field(key + ".shape", a.shape, b.shape);
    Field(key + ".px", a.px, b.px);
    Field(key + ".py", a.py, b.py);
    Field(key + ".nx", a.nx, b.nx);
    Field(key + ".ny", a.ny, b.ny);
    Field(key + ".friction", a.friction, b.friction);
  }
  void Compare(const std::string& key, const ContactCandidate& a, const ContactCandidate& b) {
    Field(key + ".node", a.node, b.node);
    Field(key + ".obstacle", a.obstacle, b.obstacle);
  }
  void Compare(const std::string& key, const SupportMotion& a, const SupportMotion& b) {
    Field(key + ".node", a.node, b.node);
    Field(key + ".dx", a.dx, b.dx);
    Field(key + ".dy", a.dy, b.dy);
  }
  void Compare(const std::string& key, const ObstacleMotion& a, const ObstacleMotion& b) {
    Field(key + ".obstacle", a.obstacle, b.obstacle);
    Field(key + ".dx", a.dx, b.dx);
    Field(key + ".dy", a.dy, b.dy);
  }
  void Compare(const std::string& key, const StopCriterion& a, const StopCriterion& b) {
    Field(key + ".quantity", a.quantity, b.quantity);
    Field(key + ".when", a.when, b.when);
    Field(key + ".value", a.value, b.value);
  }
  void Compare(const std::string& key, const BranchChoice& a, const BranchChoice& b) {
    Field(key + ".event", a.event, b.event);
    Field(key + ".increment", a.increment, b.increment);
    Field(key + ".branch", a.branch, b.branch);
  }
  void Compare(const std::string& key, const Stage& a, const Stage& b) {
    Field(key + ".name", a.name, b.name);
    List(key + ".loads", a.loads, b.loads);
    List(key + ".support_motions", a.support_motions, b.support_motions);
    List(key + ".obstacle_motions", a.obstacle_motions, b.obstacle_motions);
    Field(key + ".target", a.Target(), b.Target());
  }
  void Compare(const std::string& key, const Scene& a, const Scene& b) {
    Field(key + ".name", a.name, b.name);
    List(key + ".nodes", a.nodes, b.nodes);
    List(key + ".bars", a.bars, b.bars);
    List(key + ".superelements", a.superelements, b.superelements);
    List(key + ".loads", a.loads, b.loads);
    List(key + ".obstacles", a.obstacles, b.obstacles);
    List(key + ".contacts", a.contacts, b.contacts);
    List(key + ".support_motions", a.support_motions, b.support_motions);
    List(key + ".obstacle_motions", a.obstacle_motions, b.obstacle_motions);
  }
  void Compare(const std::string& key, const TraceOptions& a, const TraceOptions& b) {
    Field(key + ".method", a.method, b.method);
    Field(key + ".accuracy", a.accuracy, b.accuracy);
    Field(key + ".direction", a.direction, b.direction);
    Field(key + ".step", a.step, b.step);
    Field(key + ".max_increments", a.max_increments, b.max_increments);
    Field(key + ".full_state_every", a.full_state_every, b.full_state_every);
    List(key + ".stop", a.stop, b.stop);
    List(key + ".branch_choices", a.branch_choices, b.branch_choices);
  }

  std::string first_;
};

}  // namespace

std::string FirstDifference(const TraceRequest& a, const TraceRequest& b) { return Comparison().Run(a, b); }

}  // namespace contact_path
