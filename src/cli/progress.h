// What a person sees of a trace on a terminal: a bar while it runs, its events and the branches from each, a summary
// when it has ended.
#ifndef CONTACT_PATH_CLI_PROGRESS_H_
#define CONTACT_PATH_CLI_PROGRESS_H_

#include <chrono>
#include <functional>
#include <ostream>
#include <string>

#include "contact_path/path/increment.h"
#include "contact_path/path/path_summary.h"
#include "contact_path/path/trace.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

class Progress {
 public:
  using Clock = std::function<std::chrono::steady_clock::time_point()>;

  // With `show_bar`, one line of `out` is rewritten as the trace goes on. `out` must outlive this.
  Progress(const TraceRequest& request, bool show_bar, std::ostream& out, Clock clock = std::chrono::steady_clock::now);
  ~Progress() { Wipe(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Takes every increment, in order.
  void Add(const Increment& increment);

  // Takes the bar off the terminal.
  void Wipe();

  // One line without line break: how the trace ended, increments, limit points, events, time.
  std::string Summary(const TraceResult& result) const;

 private:
  void Draw(const Increment& increment, double done);

  ProgressEstimate estimate_;
  const bool show_bar_;
  std::ostream& out_;
  const Clock clock_;
  PathSummary summary_;
  const std::chrono::steady_clock::time_point begin_;
  std::chrono::steady_clock::time_point first_increment_;
  std::chrono::steady_clock::time_point drawn_;  // time of the last drawing
  bool visible_ = false;                         // the bar stands on the terminal
};

// request: expanded (scene/expand.h). Writes the branches from `increment`, a line each, best first; nothing where no
// branches part. Of the contacts and bars it names those that change their state, and counts the others. load_scale: of
// the load factor, ProgramScales(request).load_factor.
void PrintBranches(const TraceRequest& request, const Increment& increment, double load_scale, std::ostream& out);

}  // namespace contact_path

#endif  // CONTACT_PATH_CLI_PROGRESS_H_
