#include "scene/checker.h"

#include <cmath>
#include <optional>

#include "contact_path/scene/quantity.h"

namespace contact_path {

std::string TextOrQuotes(const std::string& text) { return text.empty() ? "\"\"" : text; }

std::string ListText(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 8;
  std::string text = "[";
  for (std::size_t i = 0; i < names.size() && i < kShown; ++i) text += (i > 0 ? ", " : "") + TextOrQuotes(names[i]);
  return text + (names.size() > kShown ? ", ...]" : "]");
}

void Checker::CheckBody(const KeyPath& path, const std::string& body) {
  if (body.empty()) return;
  if (const Node* const node = KnownNode(body); node == nullptr || !IsBody(*node))
    Add(path.Key("body"), body, "must name a body of the scene");
}

bool Checker::HasFreeComponent() const {
  const std::vector<Node>& nodes = request_.scene.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!nodes[i].fixed_x || !nodes[i].fixed_y || (turning_[i] && !nodes[i].fixed_rotation)) return true;
  return false;
}

void Checker::Add(const KeyPath& path, std::string value, std::string rule) {
  Violation violation{path.ToString(), std::move(value), std::move(rule)};
  // The nodes of a group share their load.
  if (!violations_.empty() && violations_.back().ToLine() == violation.ToLine()) return;
  violations_.push_back(std::move(violation));
  if (++found_ >= kMostViolations) throw Enough();
}

void Checker::CheckNumber(const KeyPath& key, double value, Range range) {
  if (range == Range::kNotNegativeOrInfinite) {
    if (!(value >= 0.0)) Add(key, NumberText(value), "must be >= 0");
  } else if (!std::isfinite(value)) {
    Add(key, NumberText(value), "must be finite");
  } else if (std::abs(value) > kLargestInput) {
    Add(key, NumberText(value), "must not exceed 1e+100 in magnitude");
  } else if (range == Range::kNotNegative && value < 0.0) {
    Add(key, NumberText(value), "must be >= 0");
  } else if (range == Range::kPositive && value < kSmallestInput) {
    Add(key, NumberText(value), "must be > 0 (at least 1e-100)");
  } else if (range == Range::kZeroOrPositive && value != 0.0 && value < kSmallestInput) {
    Add(key, NumberText(value), "must be 0 or positive (at least 1e-100)");
  }
}

void Checker::CheckText(const KeyPath& key, const std::string& text, TextKind kind,
                        std::unordered_set<std::string>* earlier) {
  const auto name_one = [&](std::optional<std::size_t> place, const std::string& what, const auto& parts) {
    if (place) return;
    const NearestName nearest = NearestOf(text, parts, [](const auto& part) { return part.name; });
    Add(key, TextOrQuotes(text), "must name " + what + " of the scene" + nearest.Question());
  };
  switch (kind) {
    case TextKind::kAny: CheckUtf8(key, text); break;
    case TextKind::kNewName: CheckName(key, text, earlier); break;
    case TextKind::kNode: name_one(index_.FindNode(text), "a node", request_.scene.nodes); break;
    case TextKind::kMaterial: name_one(index_.FindMaterial(text), "a material", request_.scene.materials); break;
    case TextKind::kObstacle: name_one(index_.FindObstacle(text), "an obstacle", request_.scene.obstacles); break;
    case TextKind::kQuantity: CheckQuantity(key, text); break;
  }
}

bool Checker::CheckUtf8(const KeyPath& key, const std::string& name) {
  if (FindNoUtf8(name) == std::string_view::npos) return true;
  Add(key, name, "must be UTF-8");
  return false;
}

void Checker::CheckName(const KeyPath& key, const std::string& name, std::unordered_set<std::string>* earlier) {
  if (name.empty()) {
    Add(key, TextOrQuotes(name), "must not be empty");
  } else if (!CheckUtf8(key, name)) {
    return;
  } else if (!IsFitForColumn(name)) {
    Add(key, name, "must not contain white space, control characters or any of @ , \" . /");
  } else if (!earlier->insert(name).second) {
    Add(key, name, "must be unique, but an earlier one has the same name");
  }
}

void Checker::CheckQuantity(const KeyPath& key, const std::string& text) {
  const std::optional<SpelledQuantity> quantity = ReadQuantity(text);
  if (!quantity) {
    Add(key, TextOrQuotes(text),
        "must be a quantity, as load_factor, <node>.x, <contact>.rn, <obstacle>.ry or <beam>.1.M" +
            NearestQuantity(text, request_.scene).Question());
  } else if (quantity->kind == Quantity::Kind::kLoadFactor) {
    if (!request_.program.empty())
      Add(key, text, "must be of a node or contact where there is a program: each stage has a target of its own");
  } else if (quantity->kind == Quantity::Kind::kSetting) {
    if (request_.options.machine_stiffness == 0.0) Add(key, text, "must go with a machine: see machine_stiffness");
  } else if (!FindQuantity(text, index_)) {
    const NearestName nearest = NearestPart(*quantity, request_.scene);
    const std::string question =
        nearest.Get().empty()
            ? ""
            : "; did you mean " + QuantityText(quantity->kind, nearest.Get(), quantity->is_column) + "?";
    Add(key, text, "must refer to " + PartOf(quantity->kind) + question);
  } else if (quantity->kind == Quantity::Kind::kRotation && !Turns(std::string(quantity->name))) {
    Add(key, text, "must be of a node that a beam turns");
  }
}

}  // namespace contact_path
