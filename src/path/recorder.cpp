#include "contact_path/path/recorder.h"

#include <algorithm>
#include <utility>

#include "contact_path/path/sentences.h"
#include "contact_path/scene/expand.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Whether the best branch turns the load back while another goes on with it. change: of the load until there.
bool TurnsBackByChoice(const EventRecord& event, double change) {
  if (event.taken != 1) return false;
  const double sign = change > 0.0 ? 1.0 : -1.0;
  return event.branches[0].load_rate * sign < -tolerances::kRate &&
         std::any_of(event.branches.begin(), event.branches.end(), [&](const BranchRecord& branch) {
           return branch.load_rate * sign > tolerances::kRate &&
                  branch.dissipation_rate < event.branches[0].dissipation_rate - tolerances::kRate;
         });
}

// Whether the path goes back, since no branch goes on. change: of the load until there.
bool NoneGoesOn(const EventRecord& event, double change) {
  if (event.taken < 1 || event.taken > static_cast<int>(event.branches.size())) return false;
  const BranchRecord& taken = event.branches[static_cast<std::size_t>(event.taken) - 1];
  return taken.parameter_rate < -tolerances::kRate && change * taken.load_rate < 0.0 &&
         std::none_of(event.branches.begin(), event.branches.end(),
                      [](const BranchRecord& branch) { return branch.parameter_rate > tolerances::kRate; });
}

std::vector<ContactRecord> ContactsAt(const Model& model, const PathPoint& point, const CheckedState& state) {
  std::vector<ContactRecord> contacts(model.contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i)
    contacts[i] = {model.contacts[i]->GapOnRecord(point.u, point.s, point.modes[i].piece) * model.scaling.length,
                   state.rn[i], state.rt[i], StateOf(point, i)};
  return contacts;
}

std::vector<Resultant> PinsAt(const Model& model, const CheckedState& state) {
  std::vector<Resultant> pins;
  for (const Pin& pin : model.scene.pins) {
    Resultant& of = pins.emplace_back();
    of.rx = state.pins[2 * pins.size() - 2];
    of.ry = state.pins[2 * pins.size() - 1];
    if (pin.stiffness == 0.0) continue;
    const auto rotation = [&](const std::string& node) {
      return state.rotations[model.index.Node(TurnsWith(model.scene.nodes[model.index.Node(node)]))];
    };
    of.rm = pin.stiffness * (rotation(pin.nodes[1]) - rotation(pin.nodes[0]) - pin.angle);
  }
  return pins;
}

PathState StateAt(const Model& model, const PathPoint& point) {
  CheckedState state = model.InSceneUnits(point);
  std::vector<ContactRecord> contacts = ContactsAt(model, point, state);
  std::vector<Resultant> pins = PinsAt(model, state);
  return {state.load_factor, std::move(state.positions), std::move(state.rotations), std::move(contacts),
          std::move(pins)};
}

}  // namespace

void FillState(const Model& model, const PathPoint& point, Increment* increment) {
  static_cast<PathState&>(*increment) = StateAt(model, point);
  increment->bars = model.BarStatesIn(point.modes);
  Reactions reactions = model.ReactionsAt(point);
  increment->supports = std::move(reactions.supports);
  increment->boundaries = std::move(reactions.boundaries);
}

void FillLists(const Model& model, const PathPoint& point, const LongLists& lists, Increment* increment) {
  if (!lists.sections && !lists.stresses && !lists.pressures) return;
  const Eigen::VectorXd values = model.structure.AllValues(point.u);
  if (lists.sections) increment->sections = model.Elements().Sections(values);
  if (lists.stresses) increment->stresses = model.Elements().Stresses(values);
  if (lists.pressures) {
    Pressures pressures = model.PressuresOfContacts().At(values, point, model.TangentialReactions(point));
    increment->pressures = std::move(pressures.contacts);
    increment->widths = std::move(pressures.widths);
  }
}

void Recorder::Start(const Model& model, int stage, AcceptedPoint start, double time) {
  increment_.stage = stage;
  first_of_stage_ = increments_;
  start.kind = IncrementKind::kStart;
  start.solve.method = method_;
  start.solve.exact = true;
  Fill(model, start, time);
  Give(increment_.load_factor);
}

void Recorder::Repeat(const Increment& increment) {
  const double load_before = increment.stage == increment_.stage ? increment_.load_factor : increment.load_factor;
  if (increment.stage != increment_.stage) first_of_stage_ = increment.index;
  increment_ = increment;
  Give(load_before);
}

void Recorder::Append(const Model& model, const AcceptedPoint& accepted, double time) {
  const double load_before = increment_.load_factor;
  increment_.dissipation += accepted.work.friction;
  increment_.external_work += accepted.work.loads;
  increment_.arc_length += accepted.arc_length;
  Fill(model, accepted, time);
  Give(load_before);
}

Causes Recorder::Remarks() const {
  Causes remarks;
  if (turned_back_ > 0)
    remarks.push_back(
        {turned_back_ > 1 ? sentences::kTurnsBackOften : sentences::kTurnsBack, {}, first_turned_back_, turned_back_});
  if (none_goes_on_ > 0) remarks.push_back({sentences::kNoneGoesOn, {}, none_goes_on_});
  return remarks;
}

void Recorder::Fill(const Model& model, const AcceptedPoint& accepted, double time) {
  const PathPoint& point = accepted.point;
  static_cast<IncrementFindings&>(increment_) = accepted;
  increment_.solve.time = time;
  FillState(model, point, &increment_);
  FillLists(model, point, lists_, &increment_);
  increment_.inner = accepted.inner ? StateAt(model, *accepted.inner) : InnerState();
  increment_.index = increments_;
  increment_.strain_energy =
      (model.structure.Energy(point.u) + model.laws.Energy(point)) * model.scaling.force * model.scaling.length;
}

void Recorder::Give(double load_before) {
  const double change = increment_.load_factor - load_before;
  // A load that falls, as in a snap, and rises again is what the user waits for.
  if (change * increment_.load_factor > 0.0 && TurnsBackByChoice(increment_.event, change)) {
    if (turned_back_ == 0) first_turned_back_ = increment_.index;
    ++turned_back_;
  }
  if (driven_ && none_goes_on_ == 0 && NoneGoesOn(increment_.event, change)) none_goes_on_ = increment_.index;
  ++increments_;
  if (on_increment_) on_increment_(increment_);
}

}  // namespace contact_path
