// A node on a deformable surface with a closed form.
#ifndef CONTACT_PATH_TEST_SUPPORT_PLANK_H_
#define CONTACT_PATH_TEST_SUPPORT_PLANK_H_

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// A load of 1 stands on a plank of length 1 between two nodes on vertical springs, 0.2 from its left end, and is pushed
// along it against a spring. Each spring takes its share of the load. Lengths are counted from the left end.
struct Plank {
  double springs = 10.0, EA = 1.0, spring = 1.0, push = 0.6;
  double from_origin = 0.0;  // of both coordinates

  Scene MakeScene() const {
    Scene scene;
    scene.nodes = {{"p", from_origin + 0.2, from_origin, false, false},
                   {"a", from_origin, from_origin, true, false},
                   {"b", from_origin + 1.0, from_origin, true, false}};
    scene.bars = {{{"a", "b"}, EA}};
    scene.superelements = {
        {{"a"}, {1.0, 0.0, 0.0, springs}}, {{"b"}, {1.0, 0.0, 0.0, springs}}, {{"p"}, {spring, 0.0, 0.0, 0.0}}};
    scene.loads = {{"p", push, 0.0, false}, {"p", 0.0, -1.0, true}};
    scene.surfaces = {{"plank", {"a", "b"}}};
    scene.contacts = {{"p", "", "", "plank", 0.0}};
    return scene;
  }

  // The largest one of all equations, of an increment.
  double Error(const Increment& increment) const {
    const auto at = [&](std::size_t i) { return increment.positions[i] - from_origin; };
    const double x = at(0), y = at(1), a = at(3), b = at(5), slope = b - a, length = std::hypot(1.0, slope);
    // The reaction turns with the plank: along y it is the load, along x slope times that.
    const double reaction = increment.contacts[0].rn - length;
    const double along = x - 0.2 - (push * increment.load_factor - slope) / spring;
    // Of the tension of the plank, which has been stretched.
    const double across = EA * (length - 1.0) * slope / length;
    const double at_a = a - (across - (1.0 - x)) / springs, at_b = b - (-across - x) / springs;
    double error = 0.0;
    for (const double part : {y - (a + slope * x), reaction, along, at_a, at_b}) {
      if (std::isnan(part)) return part;
      error = std::max(error, std::abs(part));
    }
    return error;
  }
};

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_PLANK_H_
