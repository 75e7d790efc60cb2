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

IncrementLists::IncrementLists(const TraceRequest& request, const SceneIndex& index)
    : nodes_(request.scene.nodes.size()),
      rotations_(HasRotations(request.scene) ? nodes_ : 0),
      contacts_(request.scene.contacts.size()),
      supports_(SupportedNodes(request.scene).size()),
      boundaries_(TouchedBoundaries(request.scene).size()),
      bars_(OneSidedBars(request.scene).size()),
      pins_(request.scene.pins.size()) {
  const LongLists lists = LongLists::Of(request, index);
  sections_ = lists.sections ? index.Elements().NumSections() : 0;
  stresses_ = lists.stresses ? index.Elements().NumElements() : 0;
  pressures_ = lists.pressures ? contacts_ : 0;
  widths_ = lists.pressures ? boundaries_ : 0;
}

bool IncrementLists::Fit(const Increment& increment) const {
  const bool forces = increment.supports.size() == supports_ && increment.boundaries.size() == boundaries_ &&
                      increment.bars.size() == bars_ && increment.pins.size() == pins_;
  const InnerState& inner = increment.inner;
  const bool no_inner =
      inner.positions.empty() && inner.rotations.empty() && inner.contacts.empty() && inner.pins.empty();
  if (increment.positions.empty())
    return forces && no_inner && increment.rotations.empty() && increment.contacts.empty() &&
           increment.sections.empty() && increment.stresses.empty() && increment.pressures.empty() &&
           increment.widths.empty();
  const bool inner_fits = no_inner || (inner.positions.size() == 2 * nodes_ && inner.rotations.size() == rotations_ &&
                                       inner.contacts.size() == contacts_ && inner.pins.size() == pins_);
  return forces && inner_fits && increment.positions.size() == 2 * nodes_ && increment.rotations.size() == rotations_ &&
         increment.contacts.size() == contacts_ && increment.sections.size() == sections_ &&
         increment.stresses.size() == stresses_ && increment.pressures.size() == pressures_ &&
         increment.widths.size() == widths_;
}

}  // namespace contact_path
