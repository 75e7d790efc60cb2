// A column of the CSV of a path (path/csv.h), by its name.
#ifndef CONTACT_PATH_STUDY_PATH_COLUMN_H_
#define CONTACT_PATH_STUDY_PATH_COLUMN_H_

#include <functional>
#include <string>
#include <string_view>

#include "contact_path/path/increment.h"
#include "contact_path/path/increment_lists.h"
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

}  // namespace contact_path

#endif  // CONTACT_PATH_STUDY_PATH_COLUMN_H_
