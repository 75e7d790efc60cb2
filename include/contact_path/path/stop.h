// Stop criteria of a request, ready to be asked after every increment.
#ifndef CONTACT_PATH_PATH_STOP_H_
#define CONTACT_PATH_PATH_STOP_H_

#include <cstddef>
#include <string>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// What a stop criterion speaks of: the load factor, or a coordinate of a node.
class StopQuantity {
 public:
  // Those of options.stop, in its order. `request` must be sound.
  static std::vector<StopQuantity> Of(const TraceRequest& request);

  bool IsLoadFactor() const { return component_ == kLoadFactor; }
  // Into Increment::positions; not of the load factor.
  std::size_t Component() const { return static_cast<std::size_t>(component_); }
  double Value(const Increment& increment) const;

 private:
  static constexpr int kLoadFactor = -1;
  int component_ = kLoadFactor;  // into Increment::positions
};

class StopTest {
 public:
  // `request` must be sound and outlive the test.
  explicit StopTest(const TraceRequest& request);

  // The first criterion that holds in `increment`, by more than rounding, or null. Increment 0 is not asked: a
  // criterion can end a path, not forbid its start.
  const StopCriterion* FirstThatHolds(const Increment& increment) const;

 private:
  struct Item {
    const StopCriterion* criterion;
    StopQuantity quantity;
    double rounding;  // of the quantity
  };
  std::vector<Item> items_;
};

// "b.x > 4.95".
std::string ToText(const StopCriterion& criterion);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_STOP_H_
