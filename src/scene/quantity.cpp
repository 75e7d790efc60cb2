#include "contact_path/scene/quantity.h"

#include <array>

#include "contact_path/scene/expand.h"

namespace contact_path {
namespace {

struct Component {
  std::string_view word;
  Quantity::Kind kind;
  Unit unit;
};

// Of nodes, obstacles, contacts, supports, boundaries, sections and elements. A word stands for the first kind that it
// has.
constexpr std::array<Component, 26> kComponents = {{{"x", Quantity::Kind::kX, units::kLength},
                                                    {"y", Quantity::Kind::kY, units::kLength},
                                                    {"x", Quantity::Kind::kObstacleX, units::kLength},
                                                    {"y", Quantity::Kind::kObstacleY, units::kLength},
                                                    {"turn", Quantity::Kind::kTurn, units::kNone},
                                                    {"rotation", Quantity::Kind::kRotation, units::kNone},
                                                    {"gap", Quantity::Kind::kGap, units::kLength},
                                                    {"rn", Quantity::Kind::kRn, units::kForce},
                                                    {"rt", Quantity::Kind::kRt, units::kForce},
                                                    {"pressure", Quantity::Kind::kPressure, units::kStiffness},
                                                    {"traction", Quantity::Kind::kTraction, units::kStiffness},
                                                    {"width", Quantity::Kind::kWidth, units::kLength},
                                                    {"rx", Quantity::Kind::kForceX, units::kForce},
                                                    {"ry", Quantity::Kind::kForceY, units::kForce},
                                                    {"rm", Quantity::Kind::kMoment, units::kMoment},
                                                    {"N", Quantity::Kind::kN, units::kForce},
                                                    {"Q", Quantity::Kind::kQ, units::kForce},
                                                    {"M", Quantity::Kind::kM, units::kMoment},
                                                    {"M1", Quantity::Kind::kM1, units::kMoment},
                                                    {"M2", Quantity::Kind::kM2, units::kMoment},
                                                    {"sxx", Quantity::Kind::kSxx, units::kStress},
                                                    {"syy", Quantity::Kind::kSyy, units::kStress},
                                                    {"sxy", Quantity::Kind::kSxy, units::kStress},
                                                    {"szz", Quantity::Kind::kSzz, units::kStress},
                                                    {"mises", Quantity::Kind::kMises, units::kStress},
                                                    {"energy", Quantity::Kind::kEnergy, units::kMoment}}};
constexpr std::string_view kLoadFactor = "load_factor", kSetting = "setting";

const Component* FindComponent(Quantity::Kind kind) {
  for (const Component& component : kComponents)
    if (component.kind == kind) return &component;
  return nullptr;  // the load factor, the setting
}

const Component* FindComponent(std::string_view word) {
  for (const Component& component : kComponents)
    if (component.word == word) return &component;
  return nullptr;
}

bool Holds(const SupportedNode& support, Quantity::Kind kind) {
  if (kind == Quantity::Kind::kMoment) return support.rotation;
  return kind == Quantity::Kind::kForceX ? support.x : support.y;
}

std::optional<Quantity> FindReaction(Quantity::Kind kind, std::string_view name, const SceneIndex& index) {
  const std::optional<std::size_t> support = index.FindSupport(name);
  if (support && Holds(index.Support(*support), kind)) return Quantity{kind, *support};
  const std::optional<std::size_t> boundary = index.FindBoundary(name);
  if (!support && boundary) return Quantity{kind, *boundary, Quantity::Of::kBoundary};
  const std::optional<std::size_t> pin = support ? std::nullopt : index.FindPin(std::string(name));
  if (pin && (kind != Quantity::Kind::kMoment || index.HasSpring(*pin)))
    return Quantity{kind, *pin, Quantity::Of::kPin};
  return std::nullopt;
}

// A bar has no shear force and no moments.
std::optional<Quantity> FindInElements(Quantity::Kind kind, std::string_view name, const SceneIndex& index) {
  const ElementNames& names = index.Elements();
  const bool of_section = Quantity{kind}.IsOfSection();
  const std::optional<std::size_t> part = of_section ? names.FindSection(name) : names.FindElement(name);
  if (!part || (of_section && kind != Quantity::Kind::kN && names.HasOnlyN(*part))) return std::nullopt;
  return Quantity{kind, *part};
}

}  // namespace

Unit UnitOf(Quantity::Kind kind) {
  if (kind == Quantity::Kind::kSetting) return units::kLength;
  const Component* const component = FindComponent(kind);
  return component != nullptr ? component->unit : units::kLoadFactor;
}

std::optional<SpelledQuantity> ReadQuantity(std::string_view text) {
  if (text == kLoadFactor) return SpelledQuantity();
  if (text == kSetting) return SpelledQuantity{Quantity::Kind::kSetting, {}, false};
  // Names of sections and elements end with a point and a number, other names have no points.
  const std::size_t point = text.rfind('.'), line = text.find('_');
  const bool is_column = point == text.npos || FindComponent(text.substr(point + 1)) == nullptr;
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
  if (quantity.kind == Quantity::Kind::kLoadFactor || quantity.kind == Quantity::Kind::kSetting) return quantity;
  if (quantity.IsOfSection() || quantity.IsOfElement()) return FindInElements(quantity.kind, spelled->name, index);
  if (quantity.kind == Quantity::Kind::kWidth) {
    const std::optional<std::size_t> boundary = index.FindBoundary(spelled->name);
    return boundary ? std::optional(Quantity{quantity.kind, *boundary, Quantity::Of::kBoundary}) : std::nullopt;
  }
  if (quantity.IsReaction()) return FindReaction(quantity.kind, spelled->name, index);
  if (const std::optional<std::size_t> obstacle = index.FindObstacle(spelled->name)) {
    const bool is_node = index.FindNode(spelled->name).has_value();
    if (quantity.kind == Quantity::Kind::kX && !is_node) quantity.kind = Quantity::Kind::kObstacleX;
    if (quantity.kind == Quantity::Kind::kY && !is_node) quantity.kind = Quantity::Kind::kObstacleY;
    quantity.part = *obstacle;
    if (quantity.IsOfObstacle()) return quantity;
  }
  const std::optional<std::size_t> part =
      quantity.IsOfNode() ? index.FindNode(spelled->name) : index.FindContact(std::string(spelled->name));
  if (!part) return std::nullopt;
  quantity.part = *part;
  return quantity;
}

NearestName NearestPart(const SpelledQuantity& quantity, const Scene& scene) {
  const Quantity of{quantity.kind};
  NearestName nearest(quantity.name);
  const auto offer = [&](const auto& parts) {
    for (const auto& part : parts) nearest.Offer(part.name);
  };
  if (of.IsReaction() || of.kind == Quantity::Kind::kWidth) {
    for (const SupportedNode& support : SupportedNodes(scene))
      if (of.IsReaction() && Holds(support, of.kind)) nearest.Offer(scene.nodes[support.node].name);
    offer(TouchedBoundaries(scene));
    for (std::size_t i = 0; i < scene.pins.size(); ++i) nearest.Offer(PinName(scene.pins[i], i));
  }
  if (of.IsOfNode()) offer(scene.nodes);
  if (of.kind == Quantity::Kind::kX || of.kind == Quantity::Kind::kY || of.kind == Quantity::Kind::kTurn)
    offer(scene.obstacles);
  if (of.IsOfContact())
    for (const ContactCandidate& contact : scene.contacts) nearest.Offer(contact.Name());
  return nearest;
}

NearestName NearestQuantity(std::string_view text, const Scene& scene) {
  NearestName nearest(text);
  nearest.Offer(kLoadFactor);
  nearest.Offer(kSetting);
  const bool is_column = text.find('.') == text.npos;
  const auto offer = [&](const std::string& name, auto is_of) {
    for (const Component& component : kComponents)
      if (is_of(Quantity{component.kind})) nearest.Offer(QuantityText(component.kind, name, is_column));
  };
  for (const Node& node : scene.nodes) offer(node.name, [](const Quantity& of) { return of.IsOfNode(); });
  for (const Obstacle& obstacle : scene.obstacles)
    offer(obstacle.name, [](const Quantity& of) { return of.IsOfObstacle(); });
  for (const ContactCandidate& contact : scene.contacts)
    offer(contact.Name(), [](const Quantity& of) { return of.IsOfContact(); });
  for (const SupportedNode& support : SupportedNodes(scene))
    offer(scene.nodes[support.node].name,
          [&](const Quantity& of) { return of.IsReaction() && Holds(support, of.kind); });
  for (std::size_t i = 0; i < scene.pins.size(); ++i)
    offer(PinName(scene.pins[i], i), [&](const Quantity& of) {
      return of.IsReaction() && (of.kind != Quantity::Kind::kMoment || scene.pins[i].stiffness > 0.0);
    });
  for (const TouchedBoundary& boundary : TouchedBoundaries(scene))
    offer(boundary.name, [](const Quantity& of) { return of.IsReaction() || of.kind == Quantity::Kind::kWidth; });
  return nearest;
}

std::string PartOf(Quantity::Kind kind) {
  const Quantity of{kind};
  if (of.IsReaction())
    return "a component that a support holds, an obstacle or surface with contact candidates, or a pin";
  if (kind == Quantity::Kind::kWidth) return "an obstacle or surface with contact candidates";
  if (of.IsOfSection()) return "a segment of a beam, as leg.1, or of N a bar, as bar1";
  if (of.IsOfElement()) return "an element of a solid, as block.1";
  if (kind == Quantity::Kind::kRotation) return "a node of the scene";
  if (kind == Quantity::Kind::kTurn) return "an obstacle of the scene";
  return of.IsOfNode() ? "a node or an obstacle of the scene" : "a contact of the scene";
}

std::string QuantityText(Quantity::Kind kind, std::string_view name, bool is_column) {
  const Component* const component = FindComponent(kind);
  if (component == nullptr) return std::string(kind == Quantity::Kind::kSetting ? kSetting : kLoadFactor);
  std::string text(is_column ? component->word : name);
  text += is_column ? '_' : '.';
  return text.append(is_column ? name : component->word);
}

}  // namespace contact_path
