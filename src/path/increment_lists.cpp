#include "contact_path/path/increment_lists.h"

#include "contact_path/scene/expand.h"

namespace contact_path {

LongLists LongLists::Of(const TraceRequest& request, const SceneIndex& index) {
  LongLists lists{request.options.Records("sections"), request.options.Records("stresses"),
                  request.options.Records("pressures")};
  for (const StopCriterion& criterion : request.options.stop)
    lists.Add(FindQuantity(criterion.quantity, index).value());
  for (const Samples& samples : request.options.at) lists.Add(FindQuantity(samples.quantity, index).value());
  return lists;
}

void LongLists::Add(const Quantity& quantity) {
  Add(LongLists{quantity.IsOfSection(), quantity.IsOfElement(), quantity.IsOfPressure()});
}

void LongLists::Add(const LongLists& others) {
  sections = sections || others.sections;
  stresses = stresses || others.stresses;
  pressures = pressures || others.pressures;
}

IncrementLists::IncrementLists(const TraceRequest& request, const SceneIndex& index) {
  const Scene& scene = request.scene;
  const std::size_t nodes = scene.nodes.size(), contacts = scene.contacts.size();
  always_ = {SupportedNodes(scene).size(), TouchedBoundaries(scene).size(), OneSidedBars(scene).size()};
  state_ = {2 * nodes, HasRotations(scene) ? nodes : 0, contacts, scene.pins.size()};
  const LongLists lists = LongLists::Of(request, index);
  long_ = {lists.sections ? index.Elements().NumSections() : 0, lists.stresses ? index.Elements().NumElements() : 0,
           lists.pressures ? contacts : 0, lists.pressures ? always_[1] : 0};
}

bool IncrementLists::Fit(const Increment& increment) const {
  const auto lengths = [](const PathState& of) -> Lengths {
    return {of.positions.size(), of.rotations.size(), of.contacts.size(), of.pins.size()};
  };
  const bool has_state = !increment.positions.empty();
  const Lengths none = {}, no_state = {0, 0, 0, state_[3]}, inner = lengths(increment.inner);
  const std::array<std::size_t, 3> always = {increment.supports.size(), increment.boundaries.size(),
                                             increment.bars.size()};
  const Lengths wanted = {increment.sections.size(), increment.stresses.size(), increment.pressures.size(),
                          increment.widths.size()};
  return always == always_ && lengths(increment) == (has_state ? state_ : no_state) &&
         wanted == (has_state ? long_ : none) && (inner == none || (has_state && inner == state_));
}

}  // namespace contact_path
