// Runs all cases at the extremes by both methods and all presets, and writes what came out as a page of the
// documentation. Exit status 1 if anything was wrong.
#include <sys/resource.h>

#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include "extremes/run_case.h"

namespace contact_path {
namespace {

constexpr Method kMethods[] = {Method::kBranch, Method::kMpec};
constexpr Accuracy kPresets[] = {Accuracy::kFast, Accuracy::kBalanced, Accuracy::kAccurate};

const char kHead[] = R"(# Stability at the extremes

Written by `scripts/stress`. Each row is a scene taken to an extreme, traced by both methods with all three presets. A number is
the largest error of all increments of the path against the exact answer: in the scaled position, load factor and reactions, relative to
what is at play in the scene. "proved" stands for it where no answer is known: each increment passed the check from the scene alone, as all
others did, too. A word is the named reason of an early end, with the number of increments until there, all of which were right;
"time" means that the limit of the table was reached, after that many increments: a second by `mpec`, 15 by `branch`, and five times
as long for the first increments. What is wrong would stand in bold: errors above 1e-9 of exact increments and above 1e-3 of those of `mpec`
that are not exact, where no more is attainable or admitted in the case (a limit load that is itself tiny, bars of 1e12 times the
stiffness, gaps that eps takes in).

"Attainable" is what rounding alone may do: the bound eps |J| |x| / sigma on the error of a solution of equations whose entries are
known to rounding, with the scaled Jacobian J of the fixed-mode equations, its smallest singular value sigma, the unknowns x, and eps =
2.2e-16; the largest along the path.

)";

std::string Number(double value) {
  std::ostringstream text;
  text.precision(1);
  text << std::scientific << value;
  return value == 0.0 ? "0" : text.str();
}

std::string Cell(const ExtremeCase& extreme, const Outcome& outcome) {
  if (!outcome.fault.empty()) return "**" + outcome.fault + "**";
  std::string text = extreme.error ? Number(outcome.error) : "proved";
  if (outcome.reason == EndReason::kStopCriterion || outcome.reason == EndReason::kMaxIncrements) return text;
  const std::string why = outcome.out_of_time ? "time" : std::string(ToString(outcome.reason));
  return text + " (" + why + ", " + std::to_string(outcome.increments) + " increments)";
}

double MebibytesInUse() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// faults: counts what is wrong.
std::string Table(const std::string& filter, int* faults) {
  std::ostringstream page;
  std::string group;
  double attainable = -1.0;
  for (const ExtremeCase& extreme : ExtremeCases()) {
    if ((extreme.group + ": " + extreme.value).find(filter) == std::string::npos) continue;
    if (extreme.group != group) {
      group = extreme.group;
      page << (page.tellp() > 0 ? "\n" : "") << "## " << static_cast<char>(std::toupper(group[0])) << group.substr(1)
           << "\n\n";
      if (!extreme.exact.empty()) page << "Compared with: " << extreme.exact << ".\n\n";
      page << "| | branch, fast | balanced | accurate | mpec, fast | balanced | accurate | attainable |\n"
              "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    }
    page << "| " << extreme.value;
    const double before = MebibytesInUse();
    for (const Method method : kMethods)
      for (const Accuracy accuracy : kPresets) {
        const double most_seconds = method == Method::kMpec ? 1.0 : extreme.most_seconds;
        const Outcome outcome = RunCase(extreme, method, accuracy, most_seconds);
        page << " | " << Cell(extreme, outcome);
        *faults += outcome.fault.empty() ? 0 : 1;
        std::cerr << extreme.group << ": " << extreme.value << ": " << ToString(method) << ' ' << ToString(accuracy)
                  << ": " << Cell(extreme, outcome) << (outcome.message.empty() ? "" : "; ") << outcome.message << '\n';
      }
    attainable = extreme.long_run ? -1.0 : AttainableError(extreme);
    page << " | " << (attainable < 0.0 ? "" : Number(attainable)) << " |\n";
    if (MebibytesInUse() > before + 1.0)
      std::cerr << "memory: " << before << " -> " << MebibytesInUse() << " MiB at most\n";
  }
  return page.str();
}

}  // namespace
}  // namespace contact_path

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::cerr << "usage: contact_path_extremes PAGE [FILTER]\n";
    return 2;
  }
  int faults = 0;
  const std::string table = contact_path::Table(argc > 2 ? argv[2] : "", &faults);
  std::ofstream page(argv[1]);
  page << contact_path::kHead << table;
  page.close();
  if (!page) {
    std::cerr << "contact_path_extremes: cannot write " << argv[1] << '\n';
    return 2;
  }
  std::cerr << faults << " faults\n";
  return faults == 0 ? 0 : 1;
}
