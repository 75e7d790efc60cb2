#include "support/random_scene.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace contact_path {
namespace {

constexpr double kPi = 3.14159265358979323846;

double Distance(const Node& a, const Node& b) { return std::hypot(b.x - a.x, b.y - a.y); }

std::string NodeName(std::size_t i) { return "n" + std::to_string(i); }

class Builder {
 public:
  Builder(Decisions* random, const std::string& name, std::size_t most_nodes, std::size_t most_contacts)
      : random_(*random), most_nodes_(most_nodes), most_contacts_(most_contacts) {
    scene_.name = name;
    prestressed_ = random_.Chance(0.1);
  }

  TraceRequest Build() {
    AddBase();
    const std::size_t nodes = 3 + random_.Index(most_nodes_ - 2);
    while (scene_.nodes.size() < nodes) AddNode();
    AddContacts();
    AddLoads();
    if (random_.Chance(0.5)) SwapAxes();
    TraceRequest request;
    request.scene = std::move(scene_);
    request.options.direction = pressed_ || random_.Chance(0.75) ? 1.0 : -1.0;
    return request;
  }

 private:
  bool Fixed(std::size_t i) const { return scene_.nodes[i].fixed_x && scene_.nodes[i].fixed_y; }

  void AddBar(std::size_t a, std::size_t b) {
    Bar bar;
    bar.nodes = {NodeName(a), NodeName(b)};
    bar.EA = std::pow(10.0, random_.Number(-0.5, 0.5));
    bar.strain = std::vector<StrainMeasure>{StrainMeasure::kBiot, StrainMeasure::kGreenLagrange,
                                            StrainMeasure::kLogarithmic}[random_.Index(3)];
    if (prestressed_ && random_.Chance(0.4))
      bar.rest_length = Distance(scene_.nodes[a], scene_.nodes[b]) * random_.Number(0.99, 1.01);
    scene_.bars.push_back(std::move(bar));
  }

  // n . (x - p) >= 0 with the node at distance `gap`; the normal has any length.
  void AddContact(std::size_t node, double angle, double gap, double friction) {
    const Node& at = scene_.nodes[node];
    const double length = random_.Chance(0.5) ? 1.0 : random_.Number(0.2, 5.0);
    const double c = std::cos(angle), s = std::sin(angle);
    const std::string name = "o" + std::to_string(scene_.obstacles.size());
    scene_.contacts.push_back({at.name, name});
    scene_.obstacles.push_back(
        {name, ObstacleShape::kHalfPlane, at.x - gap * c, at.y - gap * s, length * c, length * s, friction});
  }

  double Friction() { return random_.Chance(0.15) ? 0.0 : random_.Number(0.1, 1.2); }

  // A pinned node and another that is pinned, held along one axis, or rests on an obstacle.
  void AddBase() {
    const double width = random_.Number(0.8, 2.0);
    scene_.nodes.push_back({NodeName(0), 0.0, 0.0, true, true});
    scene_.nodes.push_back({NodeName(1), width, random_.Number(-0.3, 0.3), false, false});
    const double kind = random_.Number(0.0, 1.0);
    Node& second = scene_.nodes[1];
    if (kind < 0.55) {
      second.fixed_x = second.fixed_y = true;
    } else if (kind < 0.75) {
      second.fixed_y = true;
      AddBar(0, 1);
    } else {
      AddContact(1, 0.5 * kPi + random_.Number(-0.3, 0.3), 0.0, random_.Number(0.2, 1.2));
      if (random_.Chance(0.5)) AddBar(0, 1);
      pressed_ = true;
      prestressed_ = false;
    }
  }

  // A node that two bars, not in line, hold to others; sometimes three.
  void AddNode() {
    const std::size_t n = scene_.nodes.size();
    for (;;) {
      Node node{NodeName(n), random_.Number(pressed_ ? 0.2 : -0.5, 2.5), random_.Number(0.2, 1.8), false, false};
      const std::size_t a = random_.Index(n), b = random_.Index(n);
      if (a == b) continue;
      bool clear = true;
      for (const Node& other : scene_.nodes) clear = clear && Distance(node, other) > 0.45;
      const Node &first = scene_.nodes[a], &second = scene_.nodes[b];
      const double la = Distance(node, first), lb = Distance(node, second);
      const double sine =
          ((first.x - node.x) * (second.y - node.y) - (first.y - node.y) * (second.x - node.x)) / (la * lb);
      if (!clear || la > 2.0 || lb > 2.0 || std::abs(sine) < 0.4) continue;
      scene_.nodes.push_back(std::move(node));
      AddBar(a, n);
      AddBar(n, b);
      const std::size_t third = random_.Index(n);
      if (third != a && third != b && random_.Chance(0.4)) AddBar(third, n);
      return;
    }
  }

  void AddContacts() {
    const std::size_t count = std::max(scene_.contacts.size(), 1 + random_.Index(most_contacts_));
    while (scene_.contacts.size() < count) {
      // A node that has a contact already gets another one now and then: a wedge.
      std::size_t node = 1 + random_.Index(scene_.nodes.size() - 1);
      if (Fixed(node)) continue;
      const bool taken = std::any_of(scene_.contacts.begin(), scene_.contacts.end(),
                                     [&](const ContactCandidate& contact) { return contact.node == NodeName(node); });
      if (taken && !random_.Chance(0.2)) continue;
      double angle = random_.Number(0.0, 2.0 * kPi);
      if (random_.Chance(0.3)) angle = 0.5 * kPi * static_cast<double>(random_.Index(4));
      if (scene_.nodes[node].fixed_y) angle = random_.Chance(0.5) ? 0.0 : kPi;
      const double gap = !taken && random_.Chance(0.35) ? 0.0 : random_.Number(0.003, 0.12);
      AddContact(node, angle, gap, Friction());
    }
  }

  std::size_t FreeNode() {
    for (;;) {
      const std::size_t node = 1 + random_.Index(scene_.nodes.size() - 1);
      if (!scene_.nodes[node].fixed_x && !scene_.nodes[node].fixed_y) return node;
    }
  }

  void AddLoads() {
    const std::size_t count = 1 + random_.Index(2);
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t node = FreeNode();
      double angle = LoadAngle();
      if (!pressed_ && random_.Chance(0.6)) {  // towards an obstacle
        const std::size_t contact = random_.Index(scene_.contacts.size());
        const Obstacle& obstacle = scene_.obstacles[contact];
        angle = std::atan2(-obstacle.ny, -obstacle.nx) + random_.Number(-1.1, 1.1);
        const auto at = std::find_if(scene_.nodes.begin(), scene_.nodes.end(),
                                     [&](const Node& other) { return other.name == scene_.contacts[contact].node; });
        if (!at->fixed_x && !at->fixed_y) node = static_cast<std::size_t>(at - scene_.nodes.begin());
      }
      AddLoad(node, angle, random_.Number(0.5, 1.0), false);
    }
    if (random_.Chance(0.35)) AddLoad(FreeNode(), LoadAngle(), random_.Number(0.002, 0.012), true);
  }

  // Downwards and away from the pinned node where the structure rests on an obstacle: what lifts it has no equilibrium.
  double LoadAngle() { return pressed_ ? -0.5 * kPi + random_.Number(-0.1, 0.9) : random_.Number(0.0, 2.0 * kPi); }

  void AddLoad(std::size_t node, double angle, double size, bool constant) {
    scene_.loads.push_back({NodeName(node), size * std::cos(angle), size * std::sin(angle), constant});
  }

  // Mirrored at the diagonal: then nodes are held along x.
  void SwapAxes() {
    for (Node& node : scene_.nodes) {
      std::swap(node.x, node.y);
      std::swap(node.fixed_x, node.fixed_y);
    }
    for (Load& load : scene_.loads) std::swap(load.fx, load.fy);
    for (Obstacle& obstacle : scene_.obstacles) {
      std::swap(obstacle.px, obstacle.py);
      std::swap(obstacle.nx, obstacle.ny);
    }
  }

  Decisions& random_;
  const std::size_t most_nodes_, most_contacts_;
  Scene scene_;
  bool prestressed_ = false;
  bool pressed_ = false;  // held by a contact
};

}  // namespace

TraceRequest RandomRequest(unsigned seed) {
  Decisions decisions{SplitMix64(seed)};
  return RandomRequest(&decisions, "random_" + std::to_string(seed));
}

TraceRequest RandomRequest(Decisions* decisions, const std::string& name, std::size_t most_nodes,
                           std::size_t most_contacts) {
  return Builder(decisions, name, most_nodes, most_contacts).Build();
}

bool CanBeRotated(const Scene& scene) {
  return std::all_of(scene.nodes.begin(), scene.nodes.end(),
                     [](const Node& node) { return node.fixed_x == node.fixed_y; });
}

}  // namespace contact_path
