// `rosrun contact_path verify BAG`: computes anew what can be computed from the scene alone, and tells whether the bag
// proves its path, or all of its paths. Exit status: 0 it does, 1 it does not, 2 bad usage or no bag of a trace.
#include <CLI/CLI.hpp>
#include <cstddef>
#include <exception>
#include <iomanip>
#include <iostream>
#include <locale>
#include <string>
#include <vector>

#include "contact_path/path/path_summary.h"
#include "contact_path/ros/bag_reader.h"
#include "contact_path/ros/convert.h"
#include "contact_path/scene/text.h"
#include "contact_path/scene/validate.h"
#include "contact_path/verify/verify_path.h"

namespace contact_path {
namespace {

void PrintResiduals(const char* name, int increments, const Residuals& residuals) {
  std::cout << std::left << std::setw(22) << name << std::right << std::setw(7) << increments;
  for (double Residuals::*const residual : Residuals::kAll) std::cout << std::setw(13) << residuals.*residual;
  std::cout << '\n';
}

void PrintTable(const RecordedTrace& trace, const Verification& verification) {
  std::cout << std::scientific << std::setprecision(1) << "scene " << OneLine(trace.request.scene.name) << ", "
            << verification.increments << " increments:";
  for (const auto& [kind, count] : verification.kinds) std::cout << ' ' << count << ' ' << ToString(kind);
  std::cout << "\n\nlargest residuals, computed anew\n"
            << std::left << std::setw(22) << "" << std::right << std::setw(7) << "increments";
  for (const char* const name :
       {"equilibrium", "penetration", "tensile", "min form", "cone", "friction law", "supports"})
    std::cout << std::setw(13) << name;
  std::cout << '\n';
  PrintResiduals("exact increments", verification.exact_increments, verification.exact);
  const int regularised = verification.full_increments - verification.exact_increments;
  if (regularised > 0) PrintResiduals("regularised increments", regularised, verification.regularised);
  if (verification.full_increments < verification.increments)
    std::cout << "increments without state    " << std::setw(7)
              << verification.increments - verification.full_increments << '\n';
  std::cout << "\nenergy balance: off by " << verification.energy_balance << " of F L at most, with "
            << verification.work << " of work done by the loads\n";
  if (verification.proved_integrals + verification.open_integrals > 0)
    std::cout << "arc length, work and dissipation: " << verification.proved_integrals
              << " increments through three states, " << verification.open_integrals << " by their ends alone\n";
  std::cout << '\n';
}

// What speaks against the limit points of the result, in a line; empty: nothing does.
std::string LimitPointsContradicted(const contact_path_msgs::TraceResult& result,
                                    const std::vector<Increment>& increments) {
  PathSummary summary(1.0);
  for (const Increment& increment : increments) summary.Add(increment);
  const std::vector<contact_path_msgs::LimitPoint> points = ToMessages(summary.limit_points());
  if (result.limit_points.size() != points.size())
    return "the result lists " + std::to_string(result.limit_points.size()) +
           " limit points, but the increments show " + std::to_string(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (result.limit_points[i] != points[i])
      return "limit_points[" + std::to_string(i) + "] of the result is not the limit point of increment " +
             std::to_string(points[i].index);
  return {};
}

// What the record as a whole lacks; empty if nothing.
std::string Lacks(const RecordedTrace& trace) {
  if (!trace.result) return "truncated: no result, the trace was cut off before its end";
  if (trace.result->increments != trace.increments.size())
    return "truncated: " + std::to_string(trace.increments.size()) + " increments, the result speaks of " +
           std::to_string(trace.result->increments);
  const std::string end = EndContradicted(trace.request, trace.increments, trace.result->end_reason_name);
  return end.empty() ? LimitPointsContradicted(*trace.result, trace.increments) : end;
}

bool Verify(const RecordedTrace& trace) {
  const Verification verification = VerifyPath(trace.request, trace.increments);
  PrintTable(trace, verification);
  for (const Finding& finding : verification.findings)
    std::cout << "increment " << finding.increment << ": " << finding.what << '\n';
  if (verification.findings.size() == kMostLines) std::cout << "...\n";
  const std::string lacks = Lacks(trace);
  if (!lacks.empty()) std::cout << lacks << '\n';
  const bool proved = verification.findings.empty() && lacks.empty();
  if (proved)
    std::cout << "proved: every increment that has its state is an equilibrium of the scene; the trace ended "
              << trace.result->end_reason_name << "; verdicts of stability: " << verification.proved_verdicts
              << " found anew, " << verification.open_verdicts << " not checked\n";
  else
    std::cout << "NOT proved\n";
  return proved;
}

int Run(const std::string& file) {
  const std::vector<RecordedTrace> traces = ReadTraces(file);
  std::cout.imbue(std::locale::classic());
  std::size_t proved = 0;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    if (traces.size() > 1) std::cout << (i > 0 ? "\n" : "") << "trace " << i + 1 << " of " << traces.size() << '\n';
    if (Verify(traces[i])) ++proved;
  }
  if (traces.size() > 1) std::cout << '\n' << proved << " of " << traces.size() << " traces proved\n";
  std::cout << std::flush;
  return proved == traces.size() ? 0 : 1;
}

}  // namespace
}  // namespace contact_path

int main(int argc, char** argv) {
  CLI::App app("Tells whether a bag proves the path that it records.");
  std::string file;
  app.add_option("BAG", file, "Bag of a trace")->required();
  try {
    app.parse(argc, argv);
    return contact_path::Run(file);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << "verify: " << error.what() << '\n';
    return 2;
  }
}
