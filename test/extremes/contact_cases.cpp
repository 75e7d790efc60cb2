// Redundant contacts and supports, corners, wedges, coincident nodes, thousands of contacts.
#include <cmath>
#include <cstddef>

#include "extremes/extreme_case.h"
#include "support/reference_cases.h"
#include "support/traced_path.h"

namespace contact_path {
namespace {

// The floor of scenes/sliding_bar.yaml several times: their reactions together are those of one.
ExtremeCase SeveralFloors(int count) {
  ExtremeCase extreme{"redundant contacts", Text(count) + " obstacles in one place"};
  Scene scene = sliding_bar::MakeScene();
  for (int i = 1; i < count; ++i) {
    Obstacle floor = scene.obstacles[0];
    floor.name += std::to_string(i);
    scene.contacts.push_back({"b", floor.name});
    scene.obstacles.push_back(std::move(floor));
  }
  extreme.request = Until(scene, "b.x", ">", 4.9);
  extreme.exact = "closed form";
  extreme.error = [](const TraceRequest&, const Increment& increment) {
    const double x = increment.positions[2];
    double reaction = 0.0;
    for (const ContactRecord& contact : increment.contacts) reaction += contact.rn;
    return Largest({increment.load_factor - sliding_bar::LoadFactor(x), increment.positions[3],
                    reaction - sliding_bar::NormalReaction(x)});
  };
  return extreme;
}

// Three bars hold a node that one or two would hold: s = x (k1 + k2 + k3), all in one line.
ExtremeCase RedundantSupports() {
  ExtremeCase extreme{"redundant supports", "three bars in one line, held at each end"};
  Scene scene;
  scene.nodes = {{"a", -1.0, 0.0, true, true}, {"b", 0.0, 0.0, false, true}, {"c", 1.0, 0.0, true, true}};
  scene.bars = {{{"a", "b"}, 1.0}, {{"b", "c"}, 1.0}, {{"a", "c"}, 5.0}};
  scene.loads = {{"b", 1.0, 0.0}};
  extreme.request = Until(scene, "b.x", ">", 0.5);
  extreme.exact = "closed form";
  extreme.error = [](const TraceRequest&, const Increment& increment) {
    return std::abs(increment.load_factor - 2.0 * increment.positions[2]);
  };
  return extreme;
}

// A node on springs pressed into a right-angled corner of two obstacles.
ExtremeCase Corner(double friction) {
  ExtremeCase extreme{"two obstacles at one node", "corner, mu = " + Text(friction)};
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0}};
  scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
  scene.loads = {{"p", 1.0, -1.0}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction},
                     {"wall", ObstacleShape::kHalfPlane, 0.0, 0.0, -1.0, 0.0, friction}};
  scene.contacts = {{"p", "floor"}, {"p", "wall"}};
  extreme.request = Until(scene, "load_factor", ">", 1.0);
  extreme.exact = "closed form";
  extreme.error = [](const TraceRequest&, const Increment& increment) {
    const ContactRecord &floor = increment.contacts[0], &wall = increment.contacts[1];
    const double s = increment.load_factor;
    // t = (1, 0) on the floor, (0, 1) on the wall.
    return Largest({increment.positions[0], increment.positions[1], s - wall.rn + floor.rt, -s + floor.rn + wall.rt});
  };
  return extreme;
}

// A node between two walls without clearance, pressed onto one of them, then pushed along both: k y = s - mu P.
ExtremeCase Wedge(double friction, double clearance) {
  static constexpr double kPress = 1.0;
  ExtremeCase extreme{"two obstacles at one node",
                      "opposite walls, clearance " + Text(clearance) + ", mu = " + Text(friction)};
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0}};
  scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
  scene.loads = {{"p", 0.0, 1.0}, {"p", kPress, 0.0, true}};
  scene.obstacles = {{"left", ObstacleShape::kHalfPlane, 0.0, 0.0, 1.0, 0.0, friction},
                     {"right", ObstacleShape::kHalfPlane, clearance, 0.0, -1.0, 0.0, friction}};
  scene.contacts = {{"p", "left"}, {"p", "right"}};
  extreme.request = Until(scene, "load_factor", ">", 2.0);
  extreme.exact = "closed form, the free wall without reaction";
  // A clearance that the check of an increment cannot tell from none.
  const bool tight = clearance <= 1e-9;
  // eps of mpec takes in what is nearer than its root.
  if (clearance > 0.0) extreme.allowed_regularised = 5e-2;
  extreme.error = [friction, clearance, tight](const TraceRequest& request, const Increment& increment) {
    // Two rough walls may squeeze the node between them as much as it takes to hold it, which mpec follows.
    if (friction > 0.0 && tight && request.options.method == Method::kMpec)
      return Largest(
          {increment.positions[0] - clearance, increment.contacts[1].rn - increment.contacts[0].rn - kPress});
    const double press = kPress - clearance, slid = std::max(0.0, increment.load_factor - friction * press);
    return Largest({increment.positions[0] - clearance, increment.positions[1] - slid, increment.contacts[0].rn,
                    increment.contacts[1].rn - press});
  };
  return extreme;
}

// Nodes in one place that know nothing of each other, pushed onto one wall.
ExtremeCase CoincidentNodes() {
  ExtremeCase extreme{"coincident nodes", "three nodes, one wall"};
  Scene scene;
  for (const char* const name : {"p", "q", "r"}) {
    scene.nodes.push_back({name, 0.0, 0.0});
    scene.superelements.push_back({{name}, {1.0, 0.0, 0.0, 1.0}});
    scene.loads.push_back({name, 1.0, 0.0});
    scene.contacts.push_back({name, "wall"});
  }
  scene.obstacles = {{"wall", ObstacleShape::kHalfPlane, 0.25, 0.0, -1.0, 0.0, 0.3}};
  extreme.request = Until(scene, "load_factor", ">", 1.0);
  extreme.exact = "closed form";
  extreme.error = [](const TraceRequest&, const Increment& increment) {
    double error = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      error = Largest({error, increment.positions[2 * i] - std::min(increment.load_factor, 0.25),
                       increment.positions[2 * i + 1],
                       increment.contacts[i].rn - std::max(0.0, increment.load_factor - 0.25)});
    return error;
  };
  return extreme;
}

// Nodes on springs of their own in front of a wall: gap i is first + i * more.
ExtremeCase ManyAtOnce(std::size_t count, double more, double friction) {
  constexpr double kFirst = 0.005;
  ExtremeCase extreme{
      "contacts that close within one increment",
      Text(static_cast<double>(count)) + " contacts, gaps " + Text(more) + " apart, mu = " + Text(friction)};
  Scene scene;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = "p" + std::to_string(i), wall = "w" + std::to_string(i);
    scene.nodes.push_back({name, 0.0, 0.0});
    scene.superelements.push_back({{name}, {1.0, 0.0, 0.0, 1.0}});
    scene.loads.push_back({name, 1.0, 0.0});
    scene.obstacles.push_back(
        {wall, ObstacleShape::kHalfPlane, kFirst + static_cast<double>(i) * more, 0.0, -1.0, 0.0, friction});
    scene.contacts.push_back({name, wall});
  }
  extreme.request = Until(scene, "load_factor", ">", 0.02, 0.5, 5000);
  extreme.exact = "closed form";
  extreme.long_run = count > 100;
  extreme.error = [count, more](const TraceRequest&, const Increment& increment) {
    double error = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double gap = kFirst + static_cast<double>(i) * more;
      error = Largest({error, increment.positions[2 * i] - std::min(increment.load_factor, gap),
                       increment.positions[2 * i + 1],
                       increment.contacts[i].rn - std::max(0.0, increment.load_factor - gap)});
    }
    return error;
  };
  return extreme;
}

}  // namespace

void AddContactCases(std::vector<ExtremeCase>* cases) {
  for (const int count : {2, 5}) cases->push_back(SeveralFloors(count));
  cases->push_back(RedundantSupports());
  for (const double friction : {0.0, 0.3, 1e6}) cases->push_back(Corner(friction));
  for (const double clearance : {0.0, 1e-9})
    for (const double friction : {0.0, 0.3, 1.0}) cases->push_back(Wedge(friction, clearance));
  cases->push_back(CoincidentNodes());
  for (const double friction : {0.0, 0.3}) {
    cases->push_back(ManyAtOnce(20, 0.0, friction));
    cases->push_back(ManyAtOnce(50, 1e-9, friction));
    cases->push_back(ManyAtOnce(2000, 1e-7, friction));
    cases->push_back(ManyAtOnce(2000, 0.0, friction));
  }
}

}  // namespace contact_path
