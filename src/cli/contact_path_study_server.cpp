// contact_path_study_server SCENE.yaml: traces variants of a scene, one for each line of standard input. Python's
// study/server.py of the Python package is its client.
//
// Says "ready", its version and the kinds of the parameters, then answers each line with a line. Words of a line are
// separated by tabs. Requests: "value PARAMETER VALUE", whether a value is of the type of its parameter: answered by
// what it must be instead, or by nothing, PARAMETER counted from 0; "trace VALUE...", a value for each parameter:
// answered by the number of bytes of the CSV of the path, which follows the line, the status, and the outputs. Another
// line is answered as a trace that failed, or a value that must be another. Exit status 2: a scene, a parameter or an
// output that is not there.
#include <sys/types.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "contact_path/path/csv.h"
#include "contact_path/path/mpec_method.h"
#include "contact_path/path/trace.h"
#include "contact_path/scene/read_scene.h"
#include "contact_path/scene/request_field.h"
#include "contact_path/scene/text.h"
#include "contact_path/scene/validate.h"
#include "contact_path/study/study_outputs.h"
#include "process/process.h"

namespace contact_path {
namespace {

struct Arguments {
  std::string scene_file;
  std::vector<std::string> parameters;  // paths of fields
  std::vector<std::string> outputs;
  bool paths = false;
};

std::vector<std::string> Words(const std::string& line) {
  std::vector<std::string> words(1);
  for (const char c : line) {
    if (c == '\t') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

// As words of a line: names of stages may hold anything.
std::string OneWord(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return text;
}

[[noreturn]] void Reject(const char* list, std::size_t place, const char* field, const std::string& value,
                         const std::string& rule) {
  throw InvalidRequest({{list + ("[" + std::to_string(place) + "]") + field, OneLine(value), rule, "", 0}});
}

// The kinds of the parameters. Throws InvalidRequest in the words of a study.
std::vector<std::string_view> CheckArguments(const Arguments& arguments, const TraceRequest& request) {
  std::vector<std::string_view> kinds;
  std::vector<std::string> keys;
  for (const std::string& path : arguments.parameters) {
    const std::size_t place = keys.size();
    FoundField field;
    try {
      field = FindField(path, request);
    } catch (const std::invalid_argument& error) {
      Reject("parameters", place, ".path", path, error.what());
    }
    for (std::size_t i = 0; i < place; ++i)
      if (keys[i] == field.key)
        Reject("parameters", place, ".path", path,
               "must be another field than that of parameters[" + std::to_string(i) + "]");
    keys.push_back(field.key);
    kinds.push_back(field.kind);
  }
  try {
    const StudyOutputs outputs(arguments.outputs, request);
  } catch (const UnknownOutput& error) {
    Reject("outputs", error.place(), "", arguments.outputs[error.place()], error.what());
  }
  return kinds;
}

// What a trace answers.
struct Answer {
  std::string status;  // "complete", or a word and a reason
  std::vector<std::string> outputs;
  std::string csv;
};

std::string StatusOf(const TraceResult& result) {
  if (result.reached) return "complete";
  const bool is_invalid = result.reason == EndReason::kNoSuchBranch;
  const bool is_failure = result.reason == EndReason::kMemoryLimit || result.reason == EndReason::kCancelled;
  return std::string(is_invalid   ? "invalid"
                     : is_failure ? "failed"
                                  : "ended_early") +
         ": " + std::string(ToString(result.reason)) + ": " + result.message;
}

class Server {
 public:
  // client: the process whose requests it answers.
  Server(const Arguments& arguments, const TraceRequest& request, pid_t client)
      : arguments_(arguments), request_(request), client_(client) {}

  // What the value of a request must be, or nothing.
  std::string CheckValue(const std::vector<std::string>& words) const {
    const std::optional<std::size_t> parameter = words.size() == 3 ? PlaceOf(words[1]) : std::nullopt;
    if (!parameter) return "must be one value, after the place of a parameter" + CountOfParameters();
    TraceRequest varied = request_;
    try {
      SetField(arguments_.parameters[*parameter], words[2], &varied);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  }

  Answer TraceVariant(const std::vector<std::string>& words) const {
    Answer answer;
    try {
      if (words.front() != "trace") throw std::invalid_argument("a request begins with value or trace");
      const std::vector<std::string> values(words.begin() + 1, words.end());
      if (values.size() != arguments_.parameters.size())
        throw std::invalid_argument("a trace needs a value for each parameter" + CountOfParameters());
      TraceRequest varied = request_;
      for (std::size_t i = 0; i < values.size(); ++i) SetField(arguments_.parameters[i], values[i], &varied);
      if (const std::vector<Violation> violations = Validate(varied); !violations.empty())
        throw InvalidRequest(violations);
      FollowPath(varied, &answer);
    } catch (const InvalidRequest& error) {
      answer.status = "invalid: " + error.violations().front().ToLine();
    } catch (const UnknownOutput& error) {
      answer.status = "invalid: outputs[" + std::to_string(error.place()) + "] = " + arguments_.outputs[error.place()] +
                      ": " + error.what();
    } catch (const std::bad_alloc&) {
      answer.status = "failed: not enough memory";
    } catch (const std::exception& error) {
      answer.status = std::string("failed: ") + error.what();
    }
    answer.outputs.resize(arguments_.outputs.size());
    return answer;
  }

 private:
  // Of a parameter; nothing: there is none.
  std::optional<std::size_t> PlaceOf(const std::string& word) const {
    for (std::size_t i = 0; i < arguments_.parameters.size(); ++i)
      if (word == std::to_string(i)) return i;
    return std::nullopt;
  }
  std::string CountOfParameters() const {
    return ", of which there are " + std::to_string(arguments_.parameters.size());
  }

  void FollowPath(const TraceRequest& request, Answer* answer) const {
    StudyOutputs outputs(arguments_.outputs, request);
    std::optional<CsvWriter> csv;
    std::ostringstream rows;
    if (arguments_.paths) {
      csv.emplace(request);
      csv->WriteHeader(rows);
    }
    TraceControl control;
    control.lists = outputs.lists();
    control.on_increment = [&](const Increment& increment) {
      outputs.Add(increment);
      if (csv) csv->WriteRow(increment, rows);
    };
    // Nobody waits for the answer where the client has gone.
    control.cancelled = [client = client_] { return getppid() != client; };
    control.mpec = MakeMpecMethod;
    const TraceResult result = Trace(request, control);
    answer->status = StatusOf(result);
    answer->outputs = outputs.Texts(result.reason);
    answer->csv = rows.str();
  }

  const Arguments& arguments_;
  const TraceRequest& request_;
  const pid_t client_;
};

void Serve(const Arguments& arguments) {
  const pid_t client = getppid();  // as long as it is there
  const TraceRequest request = ReadTraceRequestFile(arguments.scene_file);
  const std::vector<std::string_view> kinds = CheckArguments(arguments, request);
  std::cout << "ready\t" << CONTACT_PATH_VERSION;
  for (const std::string_view kind : kinds) std::cout << '\t' << kind;
  std::cout << std::endl;

  const Server server(arguments, request, client);
  for (std::string line; std::getline(std::cin, line);) {
    const std::vector<std::string> words = Words(line);
    if (words.front() == "value") {
      std::cout << OneWord(server.CheckValue(words)) << std::endl;
      continue;
    }
    const Answer answer = server.TraceVariant(words);
    std::cout << answer.csv.size() << '\t' << OneWord(answer.status);
    for (const std::string& output : answer.outputs) std::cout << '\t' << output;
    std::cout << '\n' << answer.csv << std::flush;
  }
}

}  // namespace
}  // namespace contact_path

int main(int argc, char** argv) {
  contact_path::UseOneThread(argv);
  contact_path::KeepMemory();
  CLI::App app("Traces variants of a scene for scripts/study, one for each line of standard input.",
               "contact_path_study_server");
  contact_path::Arguments arguments;
  app.add_option("SCENE", arguments.scene_file, "Scene file")->required();
  app.add_option("--parameter", arguments.parameters, "Path of a field that varies")->allow_extra_args(false);
  app.add_option("--output", arguments.outputs, "What is wanted of each path")->allow_extra_args(false);
  app.add_flag("--paths", arguments.paths, "Answer with the CSV of each path, too");
  try {
    app.parse(argc, argv);
    contact_path::Serve(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
