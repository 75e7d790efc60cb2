#include "contact_path/scene/request_field.h"

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "contact_path/scene/field.h"
#include "contact_path/scene/key_path.h"
#include "contact_path/scene/text.h"
#include "scene/yaml_tree.h"

namespace contact_path {
namespace {

[[noreturn]] void Reject(const std::string& rule) { throw std::invalid_argument(rule); }

template <typename T, typename = void>
struct HasName : std::false_type {};
template <typename T>
struct HasName<T, std::void_t<decltype(T::name)>> : std::true_type {};

// "obstacles[0]" for a message: of the scene, whose name nobody writes in a path.
std::string Shown(const KeyPath& key) {
  const std::string text = key.ToString();
  constexpr std::string_view kScene = "scene";
  if (text == kScene) return "the scene";
  return text.compare(0, kScene.size() + 1, "scene.") == 0 ? text.substr(kScene.size() + 1) : text;
}

// Follows a path into a request and calls visit(key, value) with the value at its end.
template <typename Visit>
class Walk {
 public:
  Walk(std::string_view path, Visit visit) : rest_(path), visit_(visit) {}

  // Request: TraceRequest, const or not, as the values are then.
  template <typename Request>
  void Begin(Request* request) {
    const std::string_view first = rest_.substr(0, rest_.find('.'));
    if (first == "options" || first == "program") {
      Enter(KeyPath(), request);
    } else {
      Enter(KeyPath("scene"), &request->scene);
    }
  }

 private:
  // The next word of the path.
  std::string_view Next() {
    const std::size_t point = rest_.find('.');
    const std::string_view word = rest_.substr(0, point);
    ended_ = point == rest_.npos;
    rest_ = ended_ ? std::string_view() : rest_.substr(point + 1);
    return word;
  }

  template <typename T>
  void Enter(const KeyPath& key, T* value) {
    using Value = std::remove_const_t<T>;
    if constexpr (kIsPart<Value>) {
      if (ended_) Reject("must go on to a field of " + Shown(key) + ": " + FieldNames<Value>());
      EnterField<Value>(key, Next(), value);
    } else if constexpr (kIsList<Value>) {
      if (ended_) Reject("must go on to one of the " + std::to_string(value->size()) + " elements of " + Shown(key));
      EnterElement(key, FindElement(key, Next(), *value), value);
    } else {
      if (!ended_) Reject("must end at " + Shown(key) + ", which has no fields");
      visit_(key, value);
    }
  }

  template <typename T>
  void EnterElement(const KeyPath& key, std::size_t place, T* list) {
    if constexpr (std::is_same_v<std::remove_const_t<T>, std::vector<bool>>) {  // its elements have no address
      bool element = (*list)[place];
      Enter(key[place], &element);
      if constexpr (!std::is_const_v<T>) (*list)[place] = element;
    } else {
      Enter(key[place], &(*list)[place]);
    }
  }

  template <typename Part, typename T>
  void EnterField(const KeyPath& key, std::string_view name, T* part) {
    bool known = false;
    NearestName nearest(name);
    ForEachField<Part>([&](const auto& field) {
      nearest.Offer(field.name);
      if (field.name != name) return;
      known = true;
      Enter(key.Key(field.name), &(part->*field.member));
    });
    if (!known)
      Reject("must name a field of " + Shown(key) +
             (nearest.Get().empty() ? ": " + FieldNames<Part>() : nearest.Question()));
  }

  template <typename T>
  static std::size_t FindElement(const KeyPath& key, std::string_view word, const std::vector<T>& list) {
    NearestName nearest(word);
    if constexpr (HasName<T>::value) {
      for (std::size_t i = 0; i < list.size(); ++i) {
        if (!word.empty() && list[i].name == word) return i;
        nearest.Offer(list[i].name);
      }
    }
    const std::optional<std::size_t> place = ParseWhole(word);
    if (place && *place < list.size()) return *place;
    if (list.empty()) Reject("must not name an element of " + Shown(key) + ", which has none");
    Reject("must name an element of " + Shown(key) + (HasName<T>::value ? ", by its name or" : ", by") +
           " its place from 0 to " + std::to_string(list.size() - 1) + nearest.Question());
  }

  std::string_view rest_;
  bool ended_ = false;
  Visit visit_;
};

template <typename T>
constexpr std::string_view KindOf() {
  if constexpr (std::is_same_v<T, double>) return "number";
  if constexpr (std::is_same_v<T, int>) return "integer";
  return std::is_same_v<T, bool> ? "truth" : "text";
}

}  // namespace

FoundField FindField(std::string_view path, const TraceRequest& request) {
  FoundField found;
  const auto note = [&found](const KeyPath& key, auto* value) {
    found = {key.ToString(), KindOf<std::remove_const_t<std::remove_reference_t<decltype(*value)>>>()};
  };
  Walk(path, note).Begin(&request);
  return found;
}

void SetField(std::string_view path, const std::string& value, TraceRequest* request) {
  const auto set = [&value](const KeyPath&, auto* field) {
    using Value = std::decay_t<decltype(*field)>;
    if constexpr (std::is_same_v<Value, std::string>) {
      *field = value;
    } else {
      YamlValue written;
      written.kind = YamlValue::Kind::kText;
      written.text = value;
      const std::optional<Value> parsed = ParseScalar<Value>(written);
      if (!parsed) Reject(ScalarRule<Value>(written));
      *field = *parsed;
    }
  };
  Walk(path, set).Begin(request);
}

}  // namespace contact_path
