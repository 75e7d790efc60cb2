#include "contact_path/verify/verify_path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact_path/scene/program.h"
#include "contact_path/scene/scaling.h"
#include "verify/verified_stage.h"

namespace contact_path {
namespace {

constexpr double kRate = 1e-6;      // of unit rates
constexpr double kBend = 0.25;      // of F: what forces may change within an increment of length 1
constexpr double kMoreTurn = 1.5;   // of the angle between the tangents at both ends: the chord is within it
constexpr double kShortest = 1e-5;  // arc length: shorter increments may be rounding, and have no direction
const double kPi = std::acos(-1.0);

// By how much the tangent may turn in an increment [rad].
double LargestTurn(Accuracy accuracy) {
  switch (accuracy) {
    case Accuracy::kFast: return std::acos(0.9);
    case Accuracy::kBalanced: return std::acos(0.98);
    case Accuracy::kAccurate: return std::acos(0.998);
  }
  return kPi;
}

class EventVerifier {
 public:
  EventVerifier(const TraceRequest& request, const std::vector<Increment>& increments,
                const std::vector<double>& stiffest, std::vector<Finding>* findings)
      : request_(request),
        increments_(increments),
        stiffest_(stiffest),
        turn_(kMoreTurn * LargestTurn(request.options.accuracy)),
        index_(request.scene),
        of_program_(ProgramScales(request, index_)),
        findings_(findings) {}

  void Run() {
    for (at_ = 0; at_ < increments_.size(); ++at_) {
      const Increment& now = increments_[at_];
      findings_.SetIncrement(at_);
      if (at_ == 0 || now.stage != increments_[at_ - 1].stage) EnterStage(now);
      if (now.kind != IncrementKind::kStart && now.solve.method != request_.options.method)
        findings_.Report("is of the method ", ToString(now.solve.method), ", the request wants ",
                         ToString(request_.options.method));
      CheckNumber(now);
      CheckBranches(now);
      CheckOrder(now);
      CheckTaken(now);
      CheckSigns(now);
    }
  }

 private:
  void EnterStage(const Increment& start) {
    const std::size_t stage = static_cast<std::size_t>(std::max(start.stage, 1) - 1);
    scaling_ = StageScales(request_, index_, stage, of_program_);
    level_ = kExact * ResidualUnit(stiffest_[stage]) * scaling_.load_factor;
    direction_ = request_.options.Direction();
    if (!request_.program.empty()) direction_ = request_.program[stage].Target() < 0.0 ? -1.0 : 1.0;
    relation_ = 0;
    const Scene scene = StageScene(request_, index_, stage);
    forward_ = request_.options.DrivesForward(IsDriven(scene) || !request_.program.empty());
    machine_ = request_.options.machine_stiffness > 0.0 &&
               std::any_of(scene.loads.begin(), scene.loads.end(), [](const Load& load) { return !load.constant; });
  }

  // The choice of the request for this increment; null: none.
  const BranchChoice* ChoiceFor(const Increment& now) const {
    const BranchChoice* by_event = nullptr;
    for (const BranchChoice& choice : request_.options.branch_choices) {
      if (choice.event == 0 && choice.increment == now.index) return &choice;
      if (by_event == nullptr && choice.event > 0 && choice.event == now.event.number) by_event = &choice;
    }
    return by_event;
  }

  void CheckNumber(const Increment& now) {
    const EventRecord& event = now.event;
    if (!request_.options.LocatesEvents()) {
      if (event.number != 0 || !event.branches.empty())
        findings_.Report("an event, though increments by Ipopt record none");
      return;
    }
    if (event.number != 0 && event.number != ++events_)
      findings_.Report("is event ", event.number, ", but the event after ", events_ - 1);
    if (event.number != 0 || event.branches.empty() || SetsOut(now)) return;
    const BranchChoice* const choice = ChoiceFor(now);
    if (choice == nullptr || choice->event != 0) findings_.Report("an event without a number that no choice asks for");
  }

  // 1: the path parameter goes on, 0: it rests, -1: it goes back.
  int SenseOf(double parameter_rate, double load_rate) const {
    const auto sign = [](double rate) { return rate > kRate ? 1 : rate < -kRate ? -1 : 0; };
    const int sense = sign(parameter_rate);
    return sense == 0 && std::isinf(request_.options.machine_stiffness) ? sign(direction_ * load_rate) : sense;
  }

  // Branches in the order of the rule. A bifurcation lists the path itself before those that cross.
  void CheckOrder(const Increment& now) {
    const std::vector<BranchRecord>& branches = now.event.branches;
    if (branches.empty() || now.kind == IncrementKind::kBifurcation || branches[0].turn == 0.0) return;
    bool by_sense = true, by_dissipation = true;
    for (std::size_t k = 1; k < branches.size(); ++k) {
      const BranchRecord &before = branches[k - 1], &branch = branches[k];
      const int sense_before = SenseOf(before.parameter_rate, before.load_rate),
                sense = SenseOf(branch.parameter_rate, branch.load_rate);
      const bool less = branch.dissipation_rate <= before.dissipation_rate + kRate;
      by_sense = by_sense && (sense < sense_before || (sense == sense_before && less));
      by_dissipation = by_dissipation && less;
    }
    // A path that went back since the last increment arrives going back.
    const bool from_start = at_ == 0 || SetsOut(now) || increments_[at_ - 1].stage != now.stage;
    const double change = from_start ? 0.0
                          : machine_ ? now.setting - increments_[at_ - 1].setting
                                     : now.load_factor - increments_[at_ - 1].load_factor;
    const bool back = direction_ * change < 0.0;
    if (!(forward_ && !back ? by_sense : by_dissipation) && !(back && by_sense && forward_))
      findings_.Report("the branches are not in the order of branch_rule");
  }

  // What holds for any branches from here.
  void CheckBranches(const Increment& now) {
    const std::vector<BranchRecord>& branches = now.event.branches;
    for (std::size_t k = 0; k < branches.size(); ++k) {
      const BranchRecord& branch = branches[k];
      const auto wrong = [&](const char* what) { findings_.Report("branch ", k + 1, ": ", what); };
      if (!(std::abs(branch.load_rate) <= 1.0 + kRate)) wrong("a load rate beyond 1");
      if (!(branch.dissipation_rate >= 0.0)) wrong("a negative dissipation rate");
      if (!(branch.turn >= 0.0 && branch.turn <= kPi + kRate)) wrong("an angle beyond pi");
      if (!(std::abs(branch.parameter_rate) <= 1.0 + kRate)) wrong("a rate of the path parameter beyond 1");
      if (!machine_ && !(std::abs(direction_ * branch.load_rate - branch.parameter_rate) <= kRate))
        wrong("the rate of the path parameter is not that of the load");
      if (SetsOut(now) && !(std::abs(std::cos(branch.turn) - direction_ * branch.load_rate) <= kRate))
        wrong("the angle to the load is not the one of its rate");
      if (branch.bars.size() != now.bars.size()) wrong("the number of states is not that of the bars");
      if (now.contacts.empty()) continue;
      if (branch.states.size() != now.contacts.size()) {
        wrong("the number of states is not that of the contacts");
        continue;
      }
      for (std::size_t i = 0; i < branch.states.size(); ++i)
        if (branch.states[i] != ContactState::kOpen && now.contacts[i].gap > kSingular * scaling_.length)
          wrong("closes an open contact");
    }
  }

  // The unit chord of an increment and the lengths that belong to it; nothing where that is too short or has no state.
  struct Chord {
    std::vector<double> motion;  // scaled, and the load factor last
    double arc = 0.0;
  };
  std::optional<Chord> ChordOf(const Increment& from, const Increment& to) const {
    if (from.positions.empty() || !SameSizes(from, to) || from.stage != to.stage) return std::nullopt;
    Chord chord;
    chord.arc = to.arc_length - from.arc_length;
    if (!(chord.arc > kShortest)) return std::nullopt;
    chord.motion = ScaledMotion(from, to, request_.scene, scaling_);
    const double length = std::sqrt(Product(chord.motion, chord.motion));
    for (double& component : chord.motion) component /= length;
    return chord;
  }

  // Whether a path begins at the increment: in a stage, or where a jump has landed.
  static bool SetsOut(const Increment& now) {
    return now.kind == IncrementKind::kStart || now.kind == IncrementKind::kJump;
  }

  // The first increment after this one that moves; none where another branch is taken before, or the structure jumps.
  const Increment* Next() const {
    for (std::size_t i = at_ + 1; i < increments_.size() && increments_[i].stage == increments_[at_].stage; ++i) {
      if (increments_[i].kind == IncrementKind::kJump) return nullptr;
      if (increments_[i].arc_length > increments_[at_].arc_length) return &increments_[i];
      if (increments_[i].event.taken > 0) return nullptr;
    }
    return nullptr;
  }

  void CheckTaken(const Increment& now) {
    const EventRecord& event = now.event;
    if (event.taken < 1 || event.taken > static_cast<int>(event.branches.size())) return;
    const BranchChoice* const choice = ChoiceFor(now);
    const int wanted = choice == nullptr ? 1 : std::max(choice->branch, 1);
    // The machine goes on along what it holds.
    const bool by_machine = choice == nullptr && request_.options.at_limit != AtLimit::kFollow &&
                            event.branches[static_cast<std::size_t>(event.taken) - 1].parameter_rate >= -kRate;
    if (event.taken != wanted && !by_machine)
      findings_.Report("branch ", event.taken, " is taken, but ", wanted, " is wanted");
    const Increment* const next = Next();
    if (next == nullptr) return;
    const std::optional<Chord> after = ChordOf(now, *next);
    if (!after) return;
    const BranchRecord& taken = event.branches[static_cast<std::size_t>(event.taken) - 1];
    const double reach = 2.0 * std::sin(0.5 * turn_) + kRate;
    if (!(std::abs(taken.load_rate - after->motion.back()) <= reach))
      findings_.Report("the branch taken has the load rate ", taken.load_rate, ", the increment after it ",
                       after->motion.back());
    if (request_.options.friction_law == FrictionLaw::kTotal && taken.dissipation_rate != 0.0)
      findings_.Report("the branch taken dissipates, though by the total law of friction nothing does");
    // A branch may begin with other reactions, which the increment before the next one has.
    const std::vector<ContactRecord>& begin = (next - 1)->contacts;
    double friction = 0.0, change = 0.0;
    for (std::size_t i = 0; i < begin.size() && i < next->contacts.size(); ++i) {
      friction += std::abs(begin[i].rt) / scaling_.force;
      change += std::abs(next->contacts[i].rt - begin[i].rt) / scaling_.force;
    }
    const double rate = (next->dissipation - now.dissipation) / (scaling_.force * scaling_.length) / after->arc;
    if (request_.options.friction_law == FrictionLaw::kIncremental && begin.size() == next->contacts.size() &&
        !(std::abs(taken.dissipation_rate - rate) <=
          reach * friction + change + kBend * after->arc * (1.0 + friction) + kRate))
      findings_.Report("the branch taken has the dissipation rate ", taken.dissipation_rate,
                       ", the increment after it ", rate);
    if (at_ == 0 || SetsOut(now)) return;
    const std::optional<Chord> before = ChordOf(increments_[at_ - 1], now);
    if (!before) return;
    const double angle = std::acos(std::clamp(Product(before->motion, after->motion), -1.0, 1.0));
    if (!(std::abs(taken.turn - angle) <= 2.0 * turn_ + kRate))
      findings_.Report("the branch taken turns by ", taken.turn, ", the increments do by ", angle);
  }

  // Signs on arcs of method branch.
  void CheckSigns(const Increment& now) {
    if (request_.options.method != Method::kBranch || at_ == 0 || SetsOut(now)) return;
    const Increment& before = increments_[at_ - 1];
    const bool on_arc =
        before.event.branches.empty() || (before.kind == IncrementKind::kBifurcation && before.event.taken == 1);
    const bool goes_on = on_arc && before.stage == now.stage && before.kind != IncrementKind::kJump;
    const bool moves = goes_on && now.arc_length != before.arc_length;
    if (!moves) relation_ = 0;
    const int sign = now.solve.determinant_sign;
    if (moves && sign * before.solve.determinant_sign < 0)
      findings_.Report("the determinant changes its sign, but there is no bifurcation");
    const double change = now.load_factor - before.load_factor;
    const bool smooth = now.kind == IncrementKind::kRegular || now.kind == IncrementKind::kSample;
    // Where contacts slip, or something touches without force, unstable directions are no eigenvectors of the
    // stiffness. The force of a bar is not on record.
    const bool slips = !now.bars.empty() || TouchesWithoutForce(now, scaling_) ||
                       std::any_of(now.contacts.begin(), now.contacts.end(),
                                   [](const ContactRecord& contact) { return Slips(contact.state); });
    if (!smooth || slips || now.stability.unstable_directions < 0 || std::abs(change) <= level_) return;
    const int parity = now.stability.unstable_directions % 2 == 0 ? 1 : -1;
    const int relation = sign * parity * (change > 0.0 ? 1 : -1);
    if (relation == 0) return;
    if (relation_ != 0 && relation != relation_)
      findings_.Report("the number of unstable directions does not go with the determinant and the load");
    relation_ = relation;
  }

  const TraceRequest& request_;
  const std::vector<Increment>& increments_;
  const std::vector<double>& stiffest_;  // by stage
  const double turn_;                    // of an increment, with a margin [rad]
  const SceneIndex index_;
  const Scaling of_program_;
  Scaling scaling_;         // of the stage
  double level_ = 0.0;      // of the stage: change of the load factor
  double direction_ = 1.0;  // of the load at the start of the stage
  bool forward_ = false;    // BranchRule::kForward holds in the stage
  bool machine_ = false;    // loads the stage
  int events_ = 0;          // numbered so far
  int relation_ = 0;        // of the signs on this arc; 0: not known
  std::size_t at_ = 0;      // being checked
  Findings findings_;
};

}  // namespace

void VerifyEvents(const TraceRequest& request, const std::vector<Increment>& increments,
                  const std::vector<double>& stiffest, std::vector<Finding>* findings) {
  EventVerifier(request, increments, stiffest, findings).Run();
}

}  // namespace contact_path
