#include "contact_path/scene/validate.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/text.h"
#include "scene/checker.h"
#include "scene/rules.h"

namespace contact_path {
namespace {

void CheckOptions(Checker* checker) {
  const TraceOptions& options = checker->Request().options;
  const KeyPath path("options"), stops = path.Key("stop"), choices = path.Key("branch_choices");
  if (checker->CheckFields(path, options) && options.direction != 0.0 && !checker->Request().program.empty())
    checker->Add(path.Key("direction"), NumberText(options.direction),
                 "must be 0 where there is a program: each stage goes towards its target");
  for (std::size_t i = 0; i < options.stop.size(); ++i) {
    const StopCriterion& stop = options.stop[i];
    checker->CheckFields(stops[i], stop);
    if (stop.when != ">" && stop.when != "<")
      checker->Add(stops[i].Key("when"), TextOrQuotes(stop.when), "must be \">\" or \"<\"");
  }
  const KeyPath at = path.Key("at");  // a variable: a path refers to the one that it extends
  for (std::size_t i = 0; i < options.at.size(); ++i) {
    const Samples& samples = options.at[i];
    const KeyPath key = at[i];
    checker->CheckFields(key, samples);
    if (samples.values.empty() == (samples.count == 0))
      checker->Add(key, samples.quantity, "must have values, or else from, to and count");
    const std::size_t count = std::max(samples.values.size(), static_cast<std::size_t>(std::max(samples.count, 0)));
    if (count > options.MaxIncrements(checker->Request().program.size()))
      checker->Add(key.Key(samples.values.empty() ? "count" : "values"), std::to_string(count),
                   "must be at most max_increments, since each value wants an increment");
  }
  for (std::size_t i = 0; i < options.record.size(); ++i)
    if (const std::string& list = options.record[i];
        list != "sections" && list != "stresses" && list != "pressures" && list != "inner")
      checker->Add(path.Key("record")[i], TextOrQuotes(list), "must be sections, stresses, pressures or inner");
  if (!options.LocatesEvents() && options.at_limit != AtLimit::kFollow)
    checker->Add(path.Key("at_limit"), std::string(ToString(options.at_limit)),
                 "must be follow with method mpec, which does not locate limit points");
  if (!options.LocatesEvents() && options.branch_rule == BranchRule::kForward)
    checker->Add(path.Key("branch_rule"), "forward",
                 "must be dissipation with method mpec, which has the paper's rule");
  if (!options.LocatesEvents() && !options.at.empty())
    checker->Add(path.Key("at"), "", "must be empty with method mpec, which does not locate values");
  if (!options.LocatesEvents() && options.friction_law == FrictionLaw::kTotal)
    checker->Add(path.Key("friction_law"), "total", "must be incremental with method mpec");
  const std::vector<Tendon>& tendons = checker->GetScene().tendons;
  if (options.friction_law == FrictionLaw::kTotal &&
      std::any_of(tendons.begin(), tendons.end(), [](const Tendon& tendon) { return tendon.IsPiece(); }))
    checker->Add(path.Key("friction_law"), "total", "must be incremental where a tendon has friction");
  if (const std::vector<Obstacle>& obstacles = checker->GetScene().obstacles;
      options.friction_law == FrictionLaw::kTotal &&
      std::any_of(obstacles.begin(), obstacles.end(), [](const Obstacle& obstacle) { return !obstacle.body.empty(); }))
    checker->Add(path.Key("friction_law"), "total", "must be incremental where a body carries an obstacle");
  const std::vector<ContactCandidate>& contacts = checker->GetScene().contacts;
  if (options.friction_law == FrictionLaw::kTotal &&
      std::any_of(contacts.begin(), contacts.end(),
                  [](const auto& contact) { return contact.OnSurface() && contact.friction > 0.0; }))
    checker->Add(path.Key("friction_law"), "total", "must be incremental where a contact with a surface has friction");
  if (!options.LocatesEvents() && !options.branch_choices.empty())
    checker->Add(choices, "", "must be empty with method mpec, which does not find the branches of an event");
  for (std::size_t i = 0; i < options.branch_choices.size(); ++i) {
    const BranchChoice& choice = options.branch_choices[i];
    checker->CheckFields(choices[i], choice);
    if (choice.event > 0 && choice.increment > 0)
      checker->Add(choices[i].Key("increment"), std::to_string(choice.increment), "must be 0 where event is given");
  }
}

std::vector<Violation> FoundBy(void (*check)(Checker*), const TraceRequest& request) {
  Checker checker(request);
  try {
    check(&checker);
  } catch (const Checker::Enough&) {
    // What was found so far tells.
  }
  return checker.Take();
}

// The rules of a request in which every node, load and contact is listed by itself, in its own order.
std::vector<Violation> ValidateExpanded(Checker* checker_of_request) {
  Checker& checker = *checker_of_request;
  LoadingRules loading(&checker);
  ContactRules contacts(&checker);
  std::vector<Violation> all, of_program;
  try {
    checker.CheckUtf8(KeyPath("scene").Key("name"), checker.GetScene().name);
    CheckStructure(&checker);
    loading.CheckSceneLoads();
    const bool structure_is_sound = checker.NothingFound();
    contacts.CheckObstacles();
    all = checker.Take();
    loading.CheckSceneMotions();
    loading.CheckProgram();
    of_program = checker.Take();
    // Lengths are compared with the characteristic length, which the program may give.
    contacts.CheckContacts(structure_is_sound && of_program.empty() ? ProgramScales(checker.Request()).length : 0.0);
    CheckOptions(&checker);
  } catch (const Checker::Enough&) {
    // What was found so far tells.
  }
  std::vector<Violation> last = checker.Take();
  for (std::vector<Violation>* const part : {&last, &of_program})
    std::move(part->begin(), part->end(), std::back_inserter(all));
  return all;
}

bool StartsWith(const std::string& text, std::string_view beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

// Whether violations that were found before the expansion leave it without its nodes.
bool PreventExpansion(const std::vector<Violation>& violations) {
  return std::any_of(violations.begin(), violations.end(), [](const Violation& violation) {
    const std::string& key = violation.key;
    if (StartsWith(key, "scene.groups") || StartsWith(key, "scene.surfaces") || StartsWith(key, "scene.bodies"))
      return true;
    const std::string field = key.substr(key.find_last_of('.') + 1);
    return StartsWith(key, "scene.beams") && field != "EA" && field != "EI" && field != "GA" &&
           !StartsWith(field, "hinged[");
  });
}

// Whether a violation of the expanded request is there because of one that was found before.
bool Follows(const Violation& violation, const Violation& cause) {
  const std::string part = cause.key.substr(0, cause.key.find_last_of(']') + 1);
  if (violation.key == cause.key || violation.key == part + ".node") return true;
  const bool is_quantity = StartsWith(violation.key, "options.stop") || StartsWith(violation.key, "options.at[");
  if (StartsWith(cause.key, "scene.contacts")) return is_quantity;
  return StartsWith(cause.key, "scene.supports") &&
         (is_quantity || violation.key.find("support_motions") != std::string::npos);
}

std::string LinesOf(const std::vector<Violation>& violations) {
  if (violations.empty()) return "invalid request";
  const std::size_t listed = violations.size() <= kMostLines ? violations.size() : kMostLines - 1;
  std::string lines;
  for (std::size_t i = 0; i < listed; ++i) lines += (i > 0 ? "\n" : "") + violations[i].ToLine();
  if (listed < violations.size()) lines += "\n... and " + std::to_string(violations.size() - listed) + " more";
  return lines;
}

}  // namespace

std::string Violation::ToLine() const {
  std::string text;
  if (!file.empty()) text += OneLine(file) + ":";
  if (line > 0) text += (file.empty() ? "line " : "") + std::to_string(line) + ":";
  if (!text.empty()) text += " ";
  text += OneLine(key);
  if (!key.empty() && !value.empty()) text += " = ";
  text += OneLine(value);
  if (!key.empty() || !value.empty()) text += ": ";
  return text + OneLine(rule);
}

InvalidRequest::InvalidRequest(std::vector<Violation> violations)
    : std::invalid_argument(LinesOf(violations)), violations_(std::move(violations)) {}

std::vector<Violation> ValidateNumbers(const TraceRequest& request) {
  return FoundBy([](Checker* checker) { checker->CheckNumbers(KeyPath(), checker->Request()); }, request);
}

// What stands for several nodes is judged first: the rules of nodes, loads and contacts cannot be told without it.
std::vector<Violation> Validate(const TraceRequest& request) {
  if (!NeedsExpansion(request)) {
    Checker checker(request);
    return ValidateExpanded(&checker);
  }
  std::vector<Violation> first = FoundBy(CheckParts, request), others;
  if (!PreventExpansion(first)) {
    TraceRequest with_nodes = request;
    ExpandParts(&with_nodes.scene);
    const std::vector<Violation> of_groups = FoundBy(CheckGroups, with_nodes);
    first.insert(first.end(), of_groups.begin(), of_groups.end());
  }
  if (PreventExpansion(first)) {
    others = ValidateNumbers(request);
  } else {
    const Expansion expansion = Expand(request);
    Checker checker(expansion, request.scene.nodes.size());
    others = ValidateExpanded(&checker);
  }
  const std::size_t count = first.size();
  for (const Violation& violation : others)
    if (!std::any_of(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(count),
                     [&](const Violation& cause) { return Follows(violation, cause); }))
      first.push_back(violation);
  return first;
}

}  // namespace contact_path
