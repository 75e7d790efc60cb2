#include "contact_path/scene/quantity.h"

#include <array>
#include <functional>

namespace contact_path {
namespace {

struct Component {
  std::string_view word;
  Quantity::Kind kind;
  Unit unit;
};

// Of nodes and contacts.
constexpr std::array<Component, 6> kComponents = {{{"x", Quantity::Kind::kX, units::kLength},
                                                   {"y", Quantity::Kind::kY, units::kLength},
                                                   {"rotation", Quantity::Kind::kRotation, units::kNone},
                                                   {"gap", Quantity::Kind::kGap, units::kLength},
                                                   {"rn", Quantity::Kind::kRn, units::kForce},
                                                   {"rt", Quantity::Kind::kRt, units::kForce}}};
constexpr std::string_view kLoadFactor = "load_factor";

const Component* FindComponent(Quantity::Kind kind) {
  for (const Component& component : kComponents)
    if (component.kind == kind) return &component;
  return nullptr;  // the load factor
}

const Component* FindComponent(std::string_view word) {
  for (const Component& component : kComponents)
    if (component.word == word) return &component;
  return nullptr;
}

}  // namespace

Unit UnitOf(Quantity::Kind kind) {
  const Component* const component = FindComponent(kind);
  return component != nullptr ? component->unit : units::kLoadFactor;
}

std::optional<SpelledQuantity> ReadQuantity(std::string_view text) {
  if (text == kLoadFactor) return SpelledQuantity();
  // Names have no points, so that one tells the spellings apart.
  const std::size_t point = text.rfind('.'), line = text.find('_');
  const bool is_column = point == text.npos;
  const std::size_t at = is_column ? line : point;
  if (at == text.npos) return std::nullopt;
  const std::string_view before = text.substr(0, at), after = text.substr(at + 1);
  const Component* const component = FindComponent(is_column ? before : after);
  const std::string_view name = is_column ? after : before;
  if (component == nullptr || name.empty()) return std::nullopt;
  return SpelledQuantity{component->kind, name, is_column};
}

std::optional<Quantity> FindQuantity(std::string_view text, const SceneIndex& index) {
  const std::optional<SpelledQuantity> spelled = ReadQuantity(text);
  if (!spelled) return std::nullopt;
  Quantity quantity;
  quantity.kind = spelled->kind;
  if (quantity.kind == Quantity::Kind::kLoadFactor) return quantity;
  const std::optional<std::size_t> part =
      quantity.IsOfNode() ? index.FindNode(spelled->name) : index.FindContact(std::string(spelled->name));
  if (!part) return std::nullopt;
  quantity.part = *part;
  return quantity;
}

NearestName NearestPart(const SpelledQuantity& quantity, const Scene& scene) {
  if (Quantity{quantity.kind, 0}.IsOfNode()) return NearestOf(quantity.name, scene.nodes, &Node::name);
  return NearestOf(quantity.name, scene.contacts, &ContactCandidate::Name);
}

NearestName NearestQuantity(std::string_view text, const Scene& scene) {
  NearestName nearest(text);
  nearest.Offer(kLoadFactor);
  const bool is_column = text.find('.') == text.npos;
  const auto offer = [&](const auto& parts, auto name_of, bool of_node) {
    for (const auto& part : parts)
      for (const Component& component : kComponents)
        if (Quantity{component.kind, 0}.IsOfNode() == of_node)
          nearest.Offer(QuantityText(component.kind, std::invoke(name_of, part), is_column));
  };
  offer(scene.nodes, &Node::name, true);
  offer(scene.contacts, &ContactCandidate::Name, false);
  return nearest;
}

std::string QuantityText(Quantity::Kind kind, std::string_view name, bool is_column) {
  const Component* const component = FindComponent(kind);
  if (component == nullptr) return std::string(kLoadFactor);
  std::string text(is_column ? component->word : name);
  text += is_column ? '_' : '.';
  return text.append(is_column ? name : component->word);
}

}  // namespace contact_path
