// contact_path_trace SCENE.yaml: traces the equilibrium path of a scene file and writes its increments as CSV.
// contact_path_trace --resume BAG: goes on with a trace that was cut short.
//
// Exit status: 0 what was asked for was reached (path/end.h); 1 it was not, all accepted increments written; 2
// bad usage or invalid scene.
#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_path/linear/blas.h"
#include "contact_path/path/csv.h"
#include "contact_path/path/earlier_trace.h"
#include "contact_path/path/mpec_method.h"
#include "contact_path/path/trace.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/read_scene.h"
#include "contact_path/scene/text.h"
#include "contact_path/scene/validate.h"
#ifdef CONTACT_PATH_WITH_ROS
#include "contact_path/ros/bag_reader.h"
#include "ros/bag_sink.h"
#endif
#include "cli/progress.h"
#include "cli/trace_log.h"
#include "process/process.h"

namespace contact_path {
namespace {

constexpr char kProgram[] = "contact_path_trace";

enum ExitStatus { kReached = 0, kEndedEarly = 1, kBadInput = 2 };

struct Arguments {
  std::string scene_file;               // empty: resume
  std::string resume;                   // bag to go on from; empty: trace the scene file
  std::optional<std::string> csv_file;  // "-": standard output; nothing: standard output, unless there is a bag
  std::optional<std::string> bag_file;  // nothing: no bag
  std::optional<std::string> log_file;  // nothing: no log
  std::optional<std::string> method;
  std::optional<std::string> accuracy;
  std::optional<std::string> friction_law;
  std::optional<double> step;
  std::optional<int> max_increments;
  bool events = false;
  bool quiet = false;
};

// Takes each increment as it is accepted; throws std::runtime_error where it cannot be written.
using Sink = std::function<void(const Increment&)>;

// Set by SIGINT and SIGTERM.
volatile std::sig_atomic_t cancel_requested = 0;

void PrintError(const std::string& message) { std::cerr << kProgram << ": " << message << '\n'; }

// The first signal asks the trace to end; a second one ends the program at once.
void HandleSignals() {
  struct sigaction action = {};
  action.sa_handler = [](int) { cancel_requested = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool IsCancelled() { return cancel_requested != 0; }

// "; did you mean --method?", where an option is misspelt.
std::string OptionMeant(const CLI::App& app) {
  for (const std::string& unknown : app.remaining()) {
    if (unknown.rfind("--", 0) != 0) continue;
    NearestName nearest(unknown.substr(0, unknown.find('=')));
    for (const CLI::Option* const option : app.get_options())
      for (const std::string& name : option->get_lnames()) nearest.Offer("--" + name);
    return nearest.Question();
  }
  return "";
}

void DeclareOptions(CLI::App& app, Arguments& arguments) {
  const auto add = [&app](const char* name, auto& value, const char* type, const char* description) {
    return app.add_option(name, value, description)->type_name(type);
  };
  CLI::Option* const scene = app.add_option("SCENE", arguments.scene_file, "Scene file (YAML)");
  add("--csv", arguments.csv_file, "FILE",
      "Write the increments to this file; -, or none and no --bag: standard output");
#ifdef CONTACT_PATH_WITH_ROS
  add("--bag", arguments.bag_file, "FILE", "Record the trace to this bag too");
  scene->excludes(add("--resume", arguments.resume, "BAG",
                      "Go on with the trace of this bag; of its increments, those that can be kept are"));
#else
  scene->required();
#endif
  add("--log", arguments.log_file, "FILE",
      "Write each trial step, increment and event to this file too, as a JSON object a line");
  add("--method", arguments.method, "NAME", "branch or mpec, instead of the scene's")->needs(scene);
  add("--accuracy", arguments.accuracy, "NAME", "fast, balanced or accurate, instead of the scene's")->needs(scene);
  add("--friction-law", arguments.friction_law, "NAME",
      "incremental (Coulomb's law) or total (holonomic), instead of the scene's")
      ->needs(scene);
  add("--step", arguments.step, "NUMBER", "Increment length, instead of the scene's; 0 = automatic")->needs(scene);
  add("--max-increments", arguments.max_increments, "NUMBER",
      "Largest number, instead of that of the scene or bag; 0 = 1000 for each stage");
  app.add_flag("--events", arguments.events,
               "Print each event and the branches from there on standard error: what branch_choices chooses from");
  app.add_flag("--quiet", arguments.quiet, "Say nothing on standard error unless what was asked for is not reached");
  app.set_version_flag("--version", std::string(kProgram) + ' ' + CONTACT_PATH_VERSION, "Print the version and exit");
}

// The word as an option of the trace. Throws InvalidRequest where it is not known.
template <typename Enum>
Enum KnownWord(const std::string& option, const std::string& word) {
  const std::optional<Enum> value = ParseWord<Enum>(word);
  if (!value) throw InvalidRequest({{option, '"' + word + '"', WordRule<Enum>(word), "command line", 0}});
  return *value;
}

// What is to be traced, and what there is of it.
struct Task {
  TraceRequest request;
  std::optional<std::vector<Increment>> increments;  // of the trace to go on with
};

// The scene file with the options of the command line. Throws InvalidRequest.
TraceRequest ReadRequest(const Arguments& arguments) {
  TraceRequest request = ReadTraceRequestFile(arguments.scene_file);
  TraceOptions& options = request.options;
  if (arguments.method) options.method = KnownWord<Method>("--method", *arguments.method);
  if (arguments.accuracy) options.accuracy = KnownWord<Accuracy>("--accuracy", *arguments.accuracy);
  if (arguments.friction_law) options.friction_law = KnownWord<FrictionLaw>("--friction-law", *arguments.friction_law);
  if (arguments.step) options.step = *arguments.step;
  return request;
}

// Throws InvalidRequest; std::runtime_error for a bag that cannot be gone on from.
Task ReadTask(const Arguments& arguments) {
  Task task;
  if (!arguments.scene_file.empty()) task.request = ReadRequest(arguments);
#ifdef CONTACT_PATH_WITH_ROS
  if (arguments.scene_file.empty()) {
    HandleSignals();
    RecordedTrace so_far = ReadTraceSoFar(arguments.resume, IsCancelled);
    // The CSV has all states.
    so_far.increments.resize(RestoreStates(so_far.request, &so_far.increments));
    task.request = std::move(so_far.request);
    task.increments = std::move(so_far.increments);
  }
#endif
  if (arguments.max_increments) task.request.options.max_increments = *arguments.max_increments;
  std::vector<Violation> violations = Validate(task.request);
  for (Violation& violation : violations) violation.file = "command line";
  if (!violations.empty()) throw InvalidRequest(violations);
  return task;
}

// Whether what `option` would overwrite is what is read; says so on standard error.
bool IsInput(const char* option, const std::string& file, const Arguments& arguments) {
  const std::string& input = arguments.scene_file.empty() ? arguments.resume : arguments.scene_file;
  std::error_code none_there;
  if (!std::filesystem::equivalent(file, input, none_there)) return false;
  PrintError(std::string(option) + " " + file + " is the " + (arguments.scene_file.empty() ? "bag" : "scene file") +
             " itself");
  return true;
}

// Empties `file` for writing. Nothing where that cannot be done; says why on standard error.
std::optional<std::ofstream> Open(const char* option, const std::string& file) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  if (!out) {
    PrintError(std::string("cannot open ") + option + " '" + file + "': " + std::strerror(errno));
    return std::nullopt;
  }
  return out;
}

// Flushes, so that every increment is out before the next one is computed.
void RequireWritten(std::ostream& out, const std::string& name) {
  if (!out.flush()) throw std::runtime_error("cannot write " + name + ": " + std::strerror(errno));
}

Sink StartCsv(const TraceRequest& request, std::ostream& out, const std::string& name) {
  const CsvWriter csv(request);
  csv.WriteHeader(out);
  RequireWritten(out, name);
  return [&out, name, csv](const Increment& increment) {
    csv.WriteRow(increment, out);
    RequireWritten(out, name);
  };
}

// Traces with the increments going to `csv` and `log_out`, where these are not null. Throws std::runtime_error where
// they cannot be written.
ExitStatus RunTrace(const Task& task, const Arguments& arguments, std::ostream* csv, std::ostream* log_out) {
  const TraceRequest& request = task.request;
  const ExpandedRequest expanded(request);
  const bool csv_on_terminal = csv == &std::cout && isatty(STDOUT_FILENO) == 1;
  Progress progress(request, !arguments.quiet && !csv_on_terminal && isatty(STDERR_FILENO) == 1, std::cerr);
  std::vector<Sink> sinks;
  if (csv != nullptr)
    sinks.push_back(StartCsv(request, *csv, csv == &std::cout ? "standard output" : *arguments.csv_file));
  sinks.emplace_back([&progress](const Increment& increment) { progress.Add(increment); });
  if (arguments.events) {
    sinks.emplace_back([&, load_scale = ProgramScales(expanded.Get()).load_factor](const Increment& increment) {
      progress.Wipe();
      PrintBranches(expanded.Get(), increment, load_scale, std::cerr);
    });
  }
  std::optional<TraceLog> log;
  if (log_out != nullptr) {
    log.emplace(expanded.Get(), log_out);
    RequireWritten(*log_out, *arguments.log_file);
    sinks.emplace_back([&](const Increment& increment) {
      log->Add(increment);
      RequireWritten(*log_out, *arguments.log_file);
    });
  }
#ifdef CONTACT_PATH_WITH_ROS
  std::optional<BagSink> bag;
  if (arguments.bag_file) {
    bag.emplace(*arguments.bag_file, request);
    sinks.emplace_back([&bag](const Increment& increment) { bag->Add(increment); });
  }
#endif

  if (const std::string advice = BlasAdvice(request.scene.nodes.size()); !advice.empty() && !arguments.quiet)
    PrintError(advice);
  HandleSignals();
  TraceControl control;
  control.on_increment = [&sinks](const Increment& increment) {
    for (const Sink& sink : sinks) sink(increment);
  };
  control.cancelled = IsCancelled;
  control.mpec = MakeMpecMethod;
  if (log) control.on_trial = [&log](const TrialStep& trial) { log->Add(trial); };
  const TraceResult result =
      task.increments ? ResumeTrace(request, *task.increments, control) : Trace(request, control);
#ifdef CONTACT_PATH_WITH_ROS
  if (bag) bag->End(result);
#endif

  if (log) {
    log->End(result, progress.Summary(result));
    RequireWritten(*log_out, *arguments.log_file);
  }
  if (!result.reached || !arguments.quiet) {
    progress.Wipe();
    PrintError(progress.Summary(result));
  }
  if (result.reason == EndReason::kNoSuchBranch) return kBadInput;
  return result.reached ? kReached : kEndedEarly;
}

ExitStatus Run(const Arguments& arguments) {
  try {
    const Task task = ReadTask(arguments);
    if (arguments.bag_file && IsInput("--bag", *arguments.bag_file, arguments)) return kBadInput;
    if (arguments.csv_file && IsInput("--csv", *arguments.csv_file, arguments)) return kBadInput;
    if (arguments.log_file && IsInput("--log", *arguments.log_file, arguments)) return kBadInput;
    std::optional<std::ofstream> file, log;
    std::ostream* csv = arguments.csv_file || !arguments.bag_file ? &std::cout : nullptr;
    if (arguments.csv_file && *arguments.csv_file != "-") {
      if (!(file = Open("--csv", *arguments.csv_file))) return kBadInput;
      csv = &*file;
    }
    if (arguments.log_file && !(log = Open("--log", *arguments.log_file))) return kBadInput;
    return RunTrace(task, arguments, csv, log ? &*log : nullptr);
  } catch (const InvalidRequest& invalid) {
    std::cerr << invalid.what() << '\n';
    return kBadInput;
  } catch (const std::exception& error) {
    PrintError(error.what());
    return kEndedEarly;
  }
}

}  // namespace
}  // namespace contact_path

int main(int argc, char** argv) {
  contact_path::UseOneThread(argv);
  contact_path::KeepMemory();
  // A reader that goes away is a write error like any other.
  std::signal(SIGPIPE, SIG_IGN);

  CLI::App app("Traces the equilibrium path of a plane elastic structure with contact and friction.",
               contact_path::kProgram);
  contact_path::Arguments arguments;
  contact_path::DeclareOptions(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& answered) {  // --help, --version
    app.exit(answered);
    return std::cout.flush() ? contact_path::kReached : contact_path::kEndedEarly;
  } catch (const CLI::ParseError& error) {
    contact_path::PrintError(error.what() + contact_path::OptionMeant(app));
    return contact_path::kBadInput;
  }
  if (arguments.scene_file.empty() && arguments.resume.empty()) {
    contact_path::PrintError("SCENE is required");
    return contact_path::kBadInput;
  }
  return contact_path::Run(arguments);
}
