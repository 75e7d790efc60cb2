#include "contact_path/verify/verify_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "contact_path/check/residuals.h"
#include "contact_path/path/stop.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/tendon_route.h"
#include "contact_path/tolerances.h"
#include "verify/verified_stage.h"

namespace contact_path {
namespace {

constexpr double kFrictionLeft = 2e-6;  // of that at the load factor 0

bool ProgramDone(const TraceRequest& request, const Increment& last) {
  return last.stage == static_cast<int>(request.program.size()) && AtTarget(request, last);
}

bool SameState(const Increment& a, const Increment& b, const Scene& scene, const Scaling& scaling) {
  if (a.stage != b.stage || !SameSizes(a, b)) return false;
  double worst = 0.0;
  for (const double component : ScaledMotion(a, b, scene, scaling)) worst = std::max(worst, std::abs(component));
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    const ContactRecord &p = a.contacts[i], &q = b.contacts[i];
    if (p.state != q.state) return false;
    worst = std::max({worst, std::abs(p.rn - q.rn) / scaling.force, std::abs(p.rt - q.rt) / scaling.force});
  }
  return worst <= kSingular;
}

// Whether no contact is left at the last increment, and the load is zero or beyond minus the target of its stage.
bool Escapes(const TraceRequest& request, const std::vector<Increment>& increments) {
  const Increment& last = increments.back();
  if (!request.options.stop.empty() || last.contacts.empty()) return false;
  for (const ContactRecord& contact : last.contacts)
    if (contact.state != ContactState::kOpen) return false;
  double largest = 0.0;
  for (const Increment& increment : increments) largest = std::max(largest, std::abs(increment.load_factor));
  if (std::abs(last.load_factor) <= kExact * largest) return true;
  if (last.stage < 1 || request.program.empty()) return false;
  const double target = request.program[static_cast<std::size_t>(last.stage) - 1].Target();
  return last.load_factor * target < 0.0 && std::abs(last.load_factor) > std::abs(target);
}

// Whether next to nothing is left of the friction of a contact.
bool FrictionIsGone(const TraceRequest& request, const Increment& last) {
  const Scene scene = StageScene(request, static_cast<std::size_t>(std::max(last.stage, 1) - 1));
  const SceneIndex index(scene);
  for (const FrictionChange& change : scene.friction_changes)
    for (const ContactCandidate& contact : scene.contacts) {
      if (contact.OnSurface() || contact.obstacle != change.obstacle) continue;
      const double friction = contact.FrictionWith(scene.obstacles[index.Obstacle(change.obstacle)]);
      if (friction + change.rate * last.load_factor <= kFrictionLeft * friction) return true;
    }
  return false;
}

// Whether nothing is left of an angle by which a tendon is wrapped.
bool TendonComesOff(const TraceRequest& request, const Increment& last) {
  const Scene& scene = request.scene;
  const SceneIndex index(scene);
  const auto measure = [&](const WrapLimit& limit, const WrapLimit::Turn& turn) {
    const Tendon& tendon = scene.tendons[turn.tendon];
    const RolledSpan span = RouteIn(scene, index, tendon).spans[turn.span];
    const std::vector<Eigen::Vector2d> ends = PointsOf({static_cast<int>(index.Node(tendon.nodes[turn.span])),
                                                        static_cast<int>(index.Node(tendon.nodes[turn.span + 1]))},
                                                       last.positions);
    return limit.MeasureOf(span, ends[1] - ends[0]);
  };
  const std::vector<WrapLimit> limits = WrapLimits(scene, index);
  return std::any_of(limits.begin(), limits.end(), [&](const WrapLimit& limit) {
    return limit.Left([&](const WrapLimit::Turn& turn) { return measure(limit, turn); },
                      limit.body.empty() ? 0.0 : last.rotations[index.Node(limit.body)]) <= tolerances::kRootOfRounding;
  });
}

}  // namespace

std::string EndContradicted(const TraceRequest& request_given, const std::vector<Increment>& increments,
                            std::string_view reason) {
  const ExpandedRequest expanded(request_given);
  const TraceRequest& request = expanded.Get();
  if (increments.empty()) return {};
  const Increment& last = increments.back();
  const std::string says = "the result says " + std::string(reason) + ", but ";
  if (reason == "stop_criterion") {
    if (last.positions.empty() || ProgramDone(request, last)) return {};
    const auto stage = static_cast<std::size_t>(std::max(last.stage, 1) - 1);
    const Scaling scaling = StageScales(request, stage);
    const Scene scene = StageScene(request, stage);
    const double stiffest = ResidualCheck(scene, StageConfiguration(request, stage), scaling).LargestStiffness() *
                            scaling.length / scaling.force;
    const bool may_hold =
        last.index > 0 && StopTest(request, SceneIndex(request.scene)).MayHold(last, kRoundingOfParts * stiffest);
    return may_hold ? "" : says + "none holds in the last increment";
  }
  if (reason == "max_increments") {
    const auto first = std::find_if(increments.begin(), increments.end(),
                                    [&](const Increment& increment) { return increment.stage == last.stage; });
    const int wanted = request.options.LastIncrement(first->index);
    return last.index == wanted ? "" : says + "the request wants " + std::to_string(wanted) + " increments";
  }
  if (reason == "path_end") {
    if (last.positions.empty() || Escapes(request, increments) || FrictionIsGone(request, last) ||
        TendonComesOff(request, last))
      return {};
    if (!request.options.LocatesEvents()) return says + "increments by Ipopt cannot tell the end of a path";
    const bool parts = last.kind == IncrementKind::kStart || last.event.number > 0 || !last.event.branches.empty();
    return parts && last.event.taken == 0 ? "" : says + "the path goes on from the last increment";
  }
  if (reason == "at_limit" || reason == "no_landing") {
    const AtLimit wanted = reason == "at_limit" ? AtLimit::kStop : AtLimit::kJump;
    return request.options.at_limit == wanted ? ""
                                              : says + "at_limit is " + std::string(ToString(request.options.at_limit));
  }
  if (reason == "closed_path") {
    if (last.positions.empty()) return {};
    const auto stage = static_cast<std::size_t>(std::max(last.stage, 1) - 1);
    const Scaling scaling = StageScales(request, stage);
    const bool met = std::any_of(increments.begin(), increments.end() - 1, [&](const Increment& other) {
      return SameState(other, last, request.scene, scaling);
    });
    return met ? "" : says + "no earlier increment has the state of the last one";
  }
  return {};
}

}  // namespace contact_path
