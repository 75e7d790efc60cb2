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

template <typename Part, typename Is>
bool Any(const std::vector<Part>& parts, Is&& is) {
  return std::any_of(parts.begin(), parts.end(), is);
}

// Options that do not go with others, or with the scene.
void CheckConflicts(const KeyPath& path, const TraceOptions& options, const Scene& scene, Checker* checker) {
  const bool mpec = !options.LocatesEvents(), total = options.friction_law == FrictionLaw::kTotal;
  struct Conflict {
    bool holds;
    const char* field;
    std::string_view value, rule;
  };
  for (const auto& [holds, field, value, rule] :
       {Conflict{mpec && options.at_limit != AtLimit::kFollow, "at_limit", ToString(options.at_limit),
                 "must be follow with method mpec, which does not locate limit points"},
        Conflict{mpec && options.branch_rule == BranchRule::kForward, "branch_rule", "forward",
                 "must be dissipation with method mpec, which has the paper's rule"},
        Conflict{mpec && !options.at.empty(), "at", "", "must be empty with method mpec, which does not locate values"},
        Conflict{mpec && total, "friction_law", "total", "must be incremental with method mpec"},
        Conflict{total && Any(scene.tendons, [](const Tendon& tendon) { return tendon.IsPiece(); }), "friction_law",
                 "total", "must be incremental where a tendon has friction"},
        Conflict{total && Any(scene.obstacles, [](const Obstacle& obstacle) { return !obstacle.body.empty(); }),
                 "friction_law", "total", "must be incremental where a body carries an obstacle"},
        Conflict{total && Any(scene.contacts, [](const auto& of) { return of.OnSurface() && of.friction > 0.0; }),
                 "friction_law", "total", "must be incremental where a contact with a surface has friction"},
        Conflict{mpec && !options.branch_choices.empty(), "branch_choices", "",
                 "must be empty with method mpec, which does not find the branches of an event"}})
    if (holds) checker->Add(path.Key(field), std::string(value), std::string(rule));
}

void CheckOptions(Checker* checker) {
  const TraceOptions& options = checker->Request().options;
  const KeyPath path("options");
  if (checker->CheckFields(path, options) && options.direction != 0.0 && !checker->Request().program.empty())
    checker->Add(path.Key("direction"), NumberText(options.direction),
                 "must be 0 where there is a program: each stage goes towards its target");
  checker->CheckList(path.Key("stop"), options.stop, [&](const KeyPath& key, const StopCriterion& stop, bool) {
    if (stop.when != ">" && stop.when != "<")
      checker->Add(key.Key("when"), TextOrQuotes(stop.when), "must be \">\" or \"<\"");
  });
  checker->CheckList(path.Key("at"), options.at, [&](const KeyPath& key, const Samples& samples, bool) {
    if (samples.values.empty() == (samples.count == 0))
      checker->Add(key, samples.quantity, "must have values, or else from, to and count");
    const std::size_t count = std::max(samples.values.size(), static_cast<std::size_t>(std::max(samples.count, 0)));
    if (count > options.MaxIncrements(checker->Request().program.size()))
      checker->Add(key.Key(samples.values.empty() ? "count" : "values"), std::to_string(count),
                   "must be at most max_increments, since each value wants an increment");
  });
  for (std::size_t i = 0; i < options.record.size(); ++i)
    if (const std::string& list = options.record[i];
        list != "sections" && list != "stresses" && list != "pressures" && list != "inner")
      checker->Add(path.Key("record")[i], TextOrQuotes(list), "must be sections, stresses, pressures or inner");
  CheckConflicts(path, options, checker->GetScene(), checker);
  checker->CheckList(
      path.Key("branch_choices"), options.branch_choices, [&](const KeyPath& key, const BranchChoice& choice, bool) {
        if (choice.event > 0 && choice.increment > 0)
          checker->Add(key.Key("increment"), std::to_string(choice.increment), "must be 0 where event is given");
      });
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
  std::vector<Violation> all, of_program;
  try {
    checker.CheckUtf8(KeyPath("scene").Key("name"), checker.GetScene().name);
    CheckStructure(&checker);
    const bool loads_are_sound = CheckSceneLoads(&checker);
    const bool structure_is_sound = checker.NothingFound();
    const UsableObstacles obstacles = CheckObstacles(&checker);
    all = checker.Take();
    CheckProgram(loads_are_sound, &checker);
    of_program = checker.Take();
    // Lengths are compared with the characteristic length, which the program may give.
    CheckContacts(obstacles, structure_is_sound && of_program.empty() ? ProgramScales(checker.Request()).length : 0.0,
                  &checker);
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
    if (std::none_of(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(count),
                     [&](const Violation& cause) { return Follows(violation, cause); }))
      first.push_back(violation);
  return first;
}

}  // namespace contact_path
