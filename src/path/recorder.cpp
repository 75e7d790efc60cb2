#include "contact_path/path/recorder.h"

#include <algorithm>
#include <utility>

namespace contact_path {
namespace {

constexpr double kLevel = 1e-9;  // of a unit rate: the load neither rises nor falls

// Whether the best way on turns the load back while another goes on with it. change: of the load until there.
bool TurnsBackByChoice(const EventRecord& event, double change) {
  if (event.taken != 0) return false;
  const double sign = change > 0.0 ? 1.0 : -1.0;
  return event.ways[0].load_rate * sign < -kLevel &&
         std::any_of(event.ways.begin(), event.ways.end(),
                     [&](const WayRecord& way) { return way.load_rate * sign > kLevel; });
}

}  // namespace

void Recorder::Start(const Model& model, int stage, const PathPoint& point, const Residuals& residuals,
                     const EventRecord& ways, double time) {
  row_.stage = stage;
  AcceptedPoint accepted;
  accepted.kind = RowKind::kStart;
  accepted.residuals = residuals;
  accepted.solve.exact = true;
  accepted.event = ways;
  Fill(model, point, accepted, time);
  Give(row_.load_factor);
}

void Recorder::Repeat(const Increment& row) {
  const double load_before = row.stage == row_.stage ? row_.load_factor : row.load_factor;
  row_ = row;
  Give(load_before);
}

void Recorder::Append(const Model& model, const AcceptedPoint& accepted, double time) {
  const double load_before = row_.load_factor;
  row_.dissipation += accepted.work.friction;
  row_.external_work += accepted.work.loads;
  row_.arc_length += accepted.arc_length;
  Fill(model, accepted.point, accepted, time);
  Give(load_before);
}

std::string Recorder::Remark() const {
  if (turned_back_ == 0) return {};
  std::string text = "; at row " + std::to_string(first_turned_back_) +
                     " the load turns back, since that dissipates most, where another way goes on with it";
  if (turned_back_ > 1) text += " (the first of " + std::to_string(turned_back_) + " such rows)";
  return text + ": see branch_choices";
}

void Recorder::Fill(const Model& model, const PathPoint& point, const AcceptedPoint& accepted, double time) {
  CheckedState state = model.InSceneUnits(point);
  row_.index = rows_;
  row_.load_factor = state.load_factor;
  row_.kind = accepted.kind;
  row_.positions = std::move(state.positions);
  row_.contacts.resize(model.contacts.size());
  for (std::size_t i = 0; i < model.contacts.size(); ++i)
    row_.contacts[i] = {model.contacts[i].gap.Value(point.u, point.s) * model.scaling.length, state.rn[i], state.rt[i],
                        point.states[i]};
  row_.strain_energy = model.structure.Energy(point.u) * model.scaling.force * model.scaling.length;
  row_.residuals = accepted.residuals;
  row_.solve = accepted.solve;
  row_.solve.time = time;
  row_.event = accepted.event;
}

void Recorder::Give(double load_before) {
  const double change = row_.load_factor - load_before;
  if (change != 0.0 && TurnsBackByChoice(row_.event, change)) {
    if (turned_back_ == 0) first_turned_back_ = row_.index;
    ++turned_back_;
  }
  ++rows_;
  if (on_increment_) on_increment_(row_);
}

}  // namespace contact_path
