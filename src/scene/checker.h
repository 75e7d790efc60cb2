// What the rules of a request share: the request, its names, and what was found to be wrong so far.
#ifndef CONTACT_PATH_SRC_SCENE_CHECKER_H_
#define CONTACT_PATH_SRC_SCENE_CHECKER_H_

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_set>
#include <utility>
#include <vector>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/field.h"
#include "contact_path/scene/key_path.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/scene/text.h"
#include "contact_path/scene/validate.h"
#include "scene/input_bounds.h"

namespace contact_path {

inline const KeyPath kScene("scene");

std::string TextOrQuotes(const std::string& text);
// "[a, b]"; of a long list its beginning.
std::string ListText(const std::vector<std::string>& names);

// A rule that needs something which is already known to be wrong is left out, so that one mistake is not reported
// several times.
class Checker {
 public:
  struct Enough {};  // thrown as soon as there are kMostViolations

  // `request` must outlive the checker.
  explicit Checker(const TraceRequest& request)
      : request_(request), index_(request.scene), turning_(NodesThatTurn(request.scene)) {}
  // Of an expanded request; keys are those of the request before. num_nodes: listed there. `expansion` must outlive the
  // checker.
  Checker(const Expansion& expansion, std::size_t num_nodes) : Checker(expansion.request) {
    expansion_ = &expansion;
    num_nodes_ = num_nodes;
  }

  const TraceRequest& Request() const { return request_; }
  const Scene& GetScene() const { return request_.scene; }
  const SceneIndex& Index() const { return index_; }
  // The nodes that are listed in the request, the first ones of the scene.
  std::size_t NumListedNodes() const { return expansion_ == nullptr ? GetScene().nodes.size() : num_nodes_; }
  // Where a contact, or a load or a support motion, stands in the list of the request. loading: 0 = of the scene, else
  // of the stage of this number, from 1.
  std::size_t ContactPlace(std::size_t contact) const {
    return expansion_ == nullptr ? contact : expansion_->contacts[contact];
  }
  std::size_t LoadPlace(std::size_t loading, std::size_t load) const {
    return expansion_ == nullptr ? load : expansion_->loads[loading][load];
  }
  std::size_t MotionPlace(std::size_t loading, std::size_t motion) const {
    return expansion_ == nullptr ? motion : expansion_->motions[loading][motion];
  }

  // Null for a name that the scene does not have.
  const Node* KnownNode(std::string_view name) const { return Known(index_.FindNode(name), GetScene().nodes); }
  const Obstacle* KnownObstacle(std::string_view name) const {
    return Known(index_.FindObstacle(name), GetScene().obstacles);
  }
  const BoundarySurface* KnownSurface(std::string_view name) const {
    return Known(index_.FindSurface(name), GetScene().surfaces);
  }
  // Adds a violation unless the field `body` of a part is empty or names a body.
  void CheckBody(const KeyPath& path, const std::string& body);
  // Whether a beam turns a node that the scene has.
  bool Turns(const std::string& node) const { return turning_[index_.Node(node)]; }
  // Whether a component of a node is free, or its rotation.
  bool HasFreeComponent() const;

  void Add(const KeyPath& path, std::string value, std::string rule);
  // The violations since the last call.
  std::vector<Violation> Take() { return std::exchange(violations_, {}); }
  bool NothingFound() const { return violations_.empty(); }
  std::size_t NumFound() const { return found_; }

  // Checks each field of a part by itself, as its description says. earlier: the names of the parts before it in its
  // list; null for a part without a name. False after adding a violation.
  template <typename Part>
  bool CheckFields(const KeyPath& path, const Part& part, std::unordered_set<std::string>* earlier = nullptr) {
    const std::size_t found_before = found_;
    ForEachField<Part>([&](const auto& field) {
      const auto& value = part.*field.member;
      using Value = std::decay_t<decltype(value)>;
      const KeyPath key = path.Key(field.name);
      CheckNumbersIn(key, value, field.range);
      if constexpr (std::is_same_v<Value, std::string>)
        if (!field.optional || !value.empty()) CheckText(key, value, field.text, earlier);
      if constexpr (std::is_same_v<Value, std::vector<std::string>>)
        for (std::size_t i = 0; i < value.size(); ++i) CheckText(key[i], value[i], field.text, earlier);
    });
    return found_ == found_before;
  }

  // Checks the fields of each part of a list, and then calls check(path of the part, part, whether its fields are
  // sound). earlier: names that the parts must not have.
  template <typename Part, typename Check>
  void CheckList(const KeyPath& list, const std::vector<Part>& parts, Check&& check,
                 std::unordered_set<std::string> earlier = {}) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const KeyPath path = list[i];
      const bool sound = CheckFields(path, parts[i], &earlier);
      check(path, parts[i], sound);
    }
  }

  // Checks each number of a part and of the parts in it by itself: what needs no other field.
  template <typename Part>
  void CheckNumbers(const KeyPath& path, const Part& part) {
    ForEachField<Part>([&](const auto& field) {
      const auto& value = part.*field.member;
      using Value = std::decay_t<decltype(value)>;
      const KeyPath key = path.Key(field.name);
      CheckNumbersIn(key, value, field.range);
      if constexpr (kIsPart<Value>) CheckNumbers(key, value);
      if constexpr (kIsPartList<Value>)
        for (std::size_t i = 0; i < value.size(); ++i) CheckNumbers(key[i], value[i]);
    });
  }

  // A name that is given or made up. earlier: the names before it.
  void CheckName(const KeyPath& key, const std::string& name, std::unordered_set<std::string>* earlier);

  // Adds a violation for each name that stands in the list before.
  void CheckNoRepeats(const KeyPath& list, const std::vector<std::string>& names) {
    std::unordered_set<std::string> earlier;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (!earlier.insert(names[i]).second) Add(list[i], names[i], "must not be repeated");
  }

  // Clients in Python could not read another text. False after adding a violation.
  bool CheckUtf8(const KeyPath& key, const std::string& name);

 private:
  template <typename Part>
  static const Part* Known(std::optional<std::size_t> place, const std::vector<Part>& parts) {
    return place ? &parts[*place] : nullptr;
  }
  template <typename Value>
  void CheckNumbersIn(const KeyPath& key, const Value& value, Range range) {
    if constexpr (std::is_same_v<Value, double>) CheckNumber(key, value, range);
    if constexpr (std::is_same_v<Value, int>)
      if (value < 0 && range == Range::kNotNegative) Add(key, std::to_string(value), "must be >= 0");
    if constexpr (std::is_same_v<Value, std::vector<double>>)
      for (std::size_t i = 0; i < value.size(); ++i) CheckNumber(key[i], value[i], range);
  }
  void CheckNumber(const KeyPath& key, double value, Range range);
  void CheckText(const KeyPath& key, const std::string& text, TextKind kind, std::unordered_set<std::string>* earlier);
  void CheckQuantity(const KeyPath& key, const std::string& text);

  const TraceRequest& request_;
  const SceneIndex index_;
  const std::vector<bool> turning_;  // by node
  const Expansion* expansion_ = nullptr;
  std::size_t num_nodes_ = 0;  // listed, where there is an expansion
  std::vector<Violation> violations_;
  std::size_t found_ = 0;  // also those that were taken
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_CHECKER_H_
