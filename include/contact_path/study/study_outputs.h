// What a study takes from a path: a few values, gathered increment by increment.
#ifndef CONTACT_PATH_STUDY_STUDY_OUTPUTS_H_
#define CONTACT_PATH_STUDY_STUDY_OUTPUTS_H_

#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "contact_path/path/end.h"
#include "contact_path/path/increment.h"
#include "contact_path/path/increment_lists.h"
#include "contact_path/path/path_summary.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {

class PathColumn {
 public:
  // name: of the CSV, except solve_time, or a quantity as stop criteria spell it. `request` must be sound and expanded
  // (scene/expand.h), `index` of its scene. Throws std::invalid_argument for another name; what() is what it must be.
  PathColumn(const std::string& name, const TraceRequest& request, const SceneIndex& index);

  // What increments must have for it.
  const LongLists& lists() const { return lists_; }
  // False: a column of words, kind or state_<contact>.
  bool IsNumber() const { return number_ != nullptr; }

  // Of an increment that has its state. Each of the two only where the column is of this kind.
  double Number(const Increment& increment) const { return number_(increment); }
  std::string_view Word(const Increment& increment) const { return word_(increment); }

 private:
  LongLists lists_;
  std::function<double(const Increment&)> number_;
  std::function<std::string_view(const Increment&)> word_;
};

// what() is what the name must be.
class UnknownOutput : public std::invalid_argument {
 public:
  UnknownOutput(std::size_t place, const std::string& rule) : std::invalid_argument(rule), place_(place) {}
  std::size_t place() const { return place_; }  // of the name, from 0

 private:
  std::size_t place_;
};

class StudyOutputs {
 public:
  // names: limit_loads (load factors of the limit points), events (their number), jumps (their number), released
  // (energy of each jump), stable_range (the load factor where the path first becomes unstable), end_reason, and
  // final.<column>, max.<column>, min.<column> of PathColumn. `request` must be sound. Throws UnknownOutput.
  StudyOutputs(const std::vector<std::string>& names, const TraceRequest& request);

  // What increments must have for them.
  LongLists lists() const;

  // Takes every increment, in order.
  void Add(const Increment& increment);

  // By name: numbers with 17 digits, limit loads and energies with a space between them. Of a path without increments
  // all but end_reason are empty, and stable_range of one that does not become unstable.
  std::vector<std::string> Texts(EndReason reason) const;

 private:
  enum class Kind { kLimitLoads, kEvents, kJumps, kReleased, kStableRange, kEndReason, kFinal, kMax, kMin };
  struct Output {
    Kind kind;
    std::optional<PathColumn> column;
    std::optional<double> number;  // so far
    std::string word;              // so far, of a column of words
  };

  std::string Text(const Output& output, EndReason reason) const;

  std::vector<Output> outputs_;
  PathSummary summary_{/*load_scale=*/1.0};
  std::vector<double> released_;
  double load_before_ = 0.0;  // of the last increment
  std::optional<double> stable_range_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STUDY_STUDY_OUTPUTS_H_
