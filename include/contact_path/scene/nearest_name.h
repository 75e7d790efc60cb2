// The name that a person may have meant.
#ifndef CONTACT_PATH_SCENE_NEAREST_NAME_H_
#define CONTACT_PATH_SCENE_NEAREST_NAME_H_

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace contact_path {

// Keeps the nearest of the names that are offered to it, by the number of letters that are left out, put in, wrong, or
// exchanged with their neighbour; letters of the other case count as half an error. Of equally near names the first.
class NearestName {
 public:
  explicit NearestName(std::string_view wanted);

  // Names of more than 48 bytes, and names after the first 4,000, are left aside.
  void Offer(std::string_view name);
  // The nearest name; empty where none is near: more than a third of the letters differ.
  const std::string& Get() const { return nearest_; }
  // "; did you mean NAME?", or nothing.
  std::string Question() const { return nearest_.empty() ? "" : "; did you mean " + nearest_ + "?"; }

 private:
  const std::string wanted_;
  std::size_t offered_ = 0;
  double distance_;  // of names from here on no longer near
  std::string nearest_;
};

// Offered the names of all parts of a list. name_of: of a part its name; a function, or a member of the part.
template <typename Part, typename NameOf>
NearestName NearestOf(std::string_view wanted, const std::vector<Part>& parts, NameOf name_of) {
  NearestName nearest(wanted);
  for (const Part& part : parts) nearest.Offer(std::invoke(name_of, part));
  return nearest;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_NEAREST_NAME_H_
