// Stop criteria of a request, ready to be asked after every increment.
#ifndef CONTACT_PATH_PATH_STOP_H_
#define CONTACT_PATH_PATH_STOP_H_

#include <string>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/scene/quantity.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {

// The quantities of options.stop, in its order. `request` must be sound, `index` of its scene.
std::vector<Quantity> StopQuantities(const TraceRequest& request, const SceneIndex& index);

// The value of a quantity in an increment that has its state; of the load factor in any increment. Not of an obstacle.
double ValueOf(const Quantity& quantity, const Increment& increment);
// Also of an obstacle, in any increment. request: of the path.
double ValueOf(const Quantity& quantity, const Increment& increment, const TraceRequest& request);

class StopTest {
 public:
  // `request` must be sound and outlive the test, `index` of its scene.
  StopTest(const TraceRequest& request, const SceneIndex& index);

  // Takes an increment of the path that has its state.
  void Note(const Increment& increment);
  // The first criterion that holds in `increment`, or null. A criterion holds by more than rounding; where the path
  // locates its value, it holds at the value, too, once a noted increment was short of it. Increment 0 is not asked: a
  // criterion can end a path, not forbid its start. at_criteria: those whose value the increment has.
  const StopCriterion* FirstThatHolds(const Increment& increment, const std::vector<int>& at_criteria = {}) const;
  // Whether a criterion may have ended a path here, whatever the increments before. force_rounding: what rounding of
  // the positions changes forces by, of the characteristic one.
  bool MayHold(const Increment& increment, double force_rounding) const;

 private:
  struct Item {
    const StopCriterion* criterion;
    Quantity quantity;
    double unit;               // of the quantity, in the scene
    double rounding;           // of the quantity
    bool located;              // the path has an increment at the value
    bool short_of_it = false;  // a noted increment was on the other side of the value
    // How far the increment is beyond the value, and the rounding of that.
    struct Beyond {
      double by;
      double rounding;
    };
    Beyond BeyondIn(const Increment& increment, const TraceRequest& request) const;
  };
  const TraceRequest& request_;
  std::vector<Item> items_;
};

// "b.x > 4.95".
std::string ToText(const StopCriterion& criterion);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_STOP_H_
