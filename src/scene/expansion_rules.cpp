
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "contact_path/scene/text.h"
#include "scene/rules.h"

namespace contact_path {
namespace {

constexpr int kMostSegments = 1000000;

class BeamRules {
 public:
  explicit BeamRules(Checker* checker) : checker_(*checker), scene_(checker->GetScene()) {}

  void Check() {
    const KeyPath list = kScene.Key("beams");
    std::unordered_set<std::string> earlier;
    for (std::size_t i = 0; i < scene_.beams.size(); ++i) CheckBeam(list[i], i, &earlier);
    if (checker_.NothingFound()) CheckHinges(list);
  }

 private:
  void CheckBeam(const KeyPath& path, std::size_t place, std::unordered_set<std::string>* earlier) {
    Beam beam = scene_.beams[place];
    beam.name = BeamName(beam, place);
    checker_.CheckFields(path, beam);
    checker_.CheckName(path.Key("name"), beam.name, earlier);
    CheckTwoNodes(&checker_, path.Key("nodes"), beam.nodes);
    if (beam.segments > kMostSegments)
      checker_.Add(path.Key("segments"), std::to_string(beam.segments),
                   "must be at most " + std::to_string(kMostSegments));
    if (std::isfinite(beam.angle) && !(std::abs(beam.angle) < 2.0 * M_PI))
      checker_.Add(path.Key("angle"), NumberText(beam.angle), "must be between -2 pi and 2 pi");
    if (!beam.hinged.empty() && beam.hinged.size() != 2)
      checker_.Add(path.Key("hinged"), std::to_string(beam.hinged.size()) + " entries",
                   "must be empty or have 2 entries: whether the beam is hinged at its first and its second node");
  }

  // A beam with a hinge must be held at its other end, too.
  void CheckHinges(const KeyPath& list) {
    std::unordered_map<std::string, int> parts;  // at a node
    ForEachElementList(scene_, [&](std::string_view, const auto& elements) {
      for (const auto& element : elements)
        for (const std::string& node : element.nodes) ++parts[node];
    });
    std::unordered_set<std::string> in_contact;  // or held; nodes, groups, and beams with inner nodes on a surface
    const auto hold = [&](const auto& part) {
      in_contact.insert({part.node, part.node.substr(0, part.node.find('/')), part.group});
      if (part.group.empty()) return;
      for (const Group& group : scene_.groups)
        if (group.name == part.group) in_contact.insert(group.nodes.begin(), group.nodes.end());
    };
    std::for_each(scene_.supports.begin(), scene_.supports.end(), hold);
    for (const ContactCandidate& contact : scene_.contacts) {
      hold(contact);
      if (const BoundarySurface* const surface = checker_.KnownSurface(contact.surface))
        for (const std::string& node : surface->nodes) in_contact.insert(node.substr(0, node.find('/')));
    }
    for (std::size_t i = 0; i < scene_.beams.size(); ++i) {
      const Beam& beam = scene_.beams[i];
      if (beam.hinged.empty() || in_contact.count(BeamName(beam, i)) > 0) continue;
      for (const std::size_t hinge : {std::size_t{0}, std::size_t{1}}) {
        const std::size_t other = 1 - hinge;
        const Node& end = *checker_.KnownNode(beam.nodes[other]);
        const bool turns = end.fixed_rotation && !beam.hinged[other];
        if (!beam.hinged[hinge] || parts[end.name] > 1 || end.fixed_x || end.fixed_y || turns ||
            in_contact.count(end.name) > 0)
          continue;
        checker_.Add(list[i].Key("hinged")[hinge], "true",
                     "the hinge leaves node " + end.name + " loose: no support, contact or other part holds it");
      }
    }
  }

  Checker& checker_;
  const Scene& scene_;
};

void CheckBodies(Checker* checker) {
  const std::vector<RigidBody>& bodies = checker->GetScene().bodies;
  checker->CheckList(kScene.Key("bodies"), bodies, [&](const KeyPath& path, const RigidBody& body, bool) {
    if (checker->KnownNode(body.name) != nullptr)
      checker->Add(path.Key("name"), body.name, "must not be the name of a node, too");
  });
}

class GroupRules {
 public:
  explicit GroupRules(Checker* checker) : checker_(*checker), scene_(checker->GetScene()) {}

  void Check() {
    for (const Beam& beam : scene_.beams) beams_.insert(beam.name);
    const auto check_group = [&](const KeyPath& path, const Group& group, bool) {
      if (group.nodes.empty()) checker_.Add(path.Key("nodes"), "[]", "at least one node is needed");
      checker_.CheckNoRepeats(path.Key("nodes"), group.nodes);
      groups_.insert(group.name);
    };
    checker_.CheckList(kScene.Key("groups"), scene_.groups, check_group, beams_);
    CheckSurfaces();
    CheckSupports();
    CheckLoading(kScene, scene_);
    const KeyPath contacts = kScene.Key("contacts"), program("program");
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
      const ContactCandidate& contact = scene_.contacts[i];
      CheckGroup(contacts[i], contact.node, contact.group);
      if (contact.OnSurface()) CheckSurfaceName(contacts[i], contact.surface);
      if (contact.Rolls()) CheckRolling(contacts[i], contact);
    }
    for (std::size_t i = 0; i < checker_.Request().program.size(); ++i)
      CheckLoading(program[i], checker_.Request().program[i]);
  }

 private:
  template <typename Value>
  using Named = std::initializer_list<std::pair<const char*, Value>>;  // fields

  // there: "is a group".
  void CheckLeftOut(const KeyPath& path, Named<const std::string*> fields, const std::string& there) {
    for (const auto& [name, value] : fields)
      if (!value->empty()) checker_.Add(path.Key(name), *value, "must be left out where there " + there);
  }
  // what: "a surface: px and py act on it".
  void CheckZero(const KeyPath& path, Named<double> fields, const std::string& what) {
    for (const auto& [name, value] : fields)
      if (value != 0.0) checker_.Add(path.Key(name), NumberText(value), "must be 0 where there is " + what);
  }

  void CheckGroup(const KeyPath& path, const std::string& node, const std::string& group) {
    if (group.empty()) return;
    CheckLeftOut(path, {{"node", &node}}, "is a group");
    if (groups_.count(group) > 0 || beams_.count(group) > 0) return;
    NearestName nearest(group);
    for (const Group& known : scene_.groups) nearest.Offer(known.name);
    for (const Beam& known : scene_.beams) nearest.Offer(known.name);
    checker_.Add(path.Key("group"), group, "must name a group or a beam of the scene" + nearest.Question());
  }

  void CheckRolling(const KeyPath& path, const ContactCandidate& contact) {
    const KeyPath key = path.Key("obstacles");
    CheckLeftOut(path,
                 {{"node", &contact.node},
                  {"obstacle", &contact.obstacle},
                  {"group", &contact.group},
                  {"surface", &contact.surface}},
                 "are obstacles");
    if (contact.obstacles.size() != 2)
      return checker_.Add(key, ListText(contact.obstacles), "must name two obstacles: a circle, and what it may touch");
    const Obstacle* const circle = checker_.KnownObstacle(contact.obstacles[0]);
    const Obstacle* const partner = checker_.KnownObstacle(contact.obstacles[1]);
    for (std::size_t i = 0; i < 2; ++i)
      if (checker_.KnownObstacle(contact.obstacles[i]) == nullptr)
        return checker_.Add(key[i], contact.obstacles[i],
                            "must name an obstacle of the scene" +
                                NearestOf(contact.obstacles[i], scene_.obstacles, &Obstacle::name).Question());
    if (circle->shape != ObstacleShape::kCircle || circle->inside || circle->body.empty())
      return checker_.Add(key[0], circle->name, "must be a circle that a body carries, and not be its inside");
    if (partner->body == circle->body)
      return checker_.Add(key[1], partner->name, "must not be carried by the same body, " + circle->body);
    if (partner->shape == ObstacleShape::kCircle && partner->inside && !(circle->radius < partner->radius))
      return checker_.Add(key[0], circle->name, "must have a smaller radius than " + partner->name);
    const Node* const centre = checker_.KnownNode(CentreNode(*circle, scene_));
    if (centre != nullptr && (centre->body != circle->body || centre->x != circle->px || centre->y != circle->py))
      checker_.Add(key[0], circle->name, "must not have the name of a node that is not at the centre of the circle");
  }

  template <typename Part>
  void CheckBody(const KeyPath& path, const Part& part) {
    if (part.body.empty()) return;
    CheckLeftOut(path, {{"node", &part.node}, {"group", &part.group}}, "is a body");
    checker_.CheckBody(path, part.body);
  }

  void CheckSurfaces() {
    checker_.CheckList(kScene.Key("surfaces"), scene_.surfaces, [&](const auto& path, const auto& surface, bool) {
      const KeyPath nodes = path.Key("nodes");
      const std::size_t least = surface.closed ? 3 : 2;
      if (surface.nodes.size() < least)
        checker_.Add(nodes, ListText(surface.nodes), "at least " + std::to_string(least) + " nodes are needed");
      checker_.CheckNoRepeats(nodes, surface.nodes);
    });
  }

  // What a traction on a surface leaves out.
  void CheckSurfaceLoad(const KeyPath& path, const Load& load) {
    CheckLeftOut(path, {{"node", &load.node}, {"group", &load.group}}, "is a surface");
    CheckZero(path, {{"fx", load.fx}, {"fy", load.fy}, {"moment", load.moment}}, "a surface: px and py act on it");
    CheckSurfaceName(path, load.surface);
  }

  // What the weight of a solid or a beam leaves out.
  void CheckWeight(const KeyPath& path, const Load& load) {
    const bool of_solid = !load.solid.empty();
    const std::string part = of_solid ? "solid" : "beam";
    const std::string& wanted = of_solid ? load.solid : load.beam;
    CheckLeftOut(path, {{"node", &load.node}, {"group", &load.group}, {"surface", &load.surface}, {"body", &load.body}},
                 "is a " + part);
    if (of_solid) CheckLeftOut(path, {{"beam", &load.beam}}, "is a " + part);
    CheckZero(path, {{"fx", load.fx}, {"fy", load.fy}, {"moment", load.moment}, {"px", load.px}, {"py", load.py}},
              "a " + part + ": bx and by act on it");
    NearestName nearest(wanted);
    bool known = false;
    const auto offer = [&](const std::string& name) {
      nearest.Offer(name);
      known = known || name == wanted;
    };
    for (std::size_t i = 0; of_solid && i < scene_.solids.size(); ++i) offer(SolidName(scene_.solids[i], i));
    for (std::size_t i = 0; !of_solid && i < scene_.beams.size(); ++i) offer(BeamName(scene_.beams[i], i));
    if (!known) checker_.Add(path.Key(part), wanted, "must name a " + part + " of the scene" + nearest.Question());
  }

  void CheckSurfaceName(const KeyPath& path, const std::string& surface) {
    if (checker_.KnownSurface(surface) != nullptr) return;
    const NearestName nearest = NearestOf(surface, scene_.surfaces, &BoundarySurface::name);
    checker_.Add(path.Key("surface"), surface, "must name a surface of the scene" + nearest.Question());
  }

  void CheckSupports() {
    const KeyPath list = kScene.Key("supports");
    for (std::size_t i = 0; i < scene_.supports.size(); ++i) {
      const Support& support = scene_.supports[i];
      const KeyPath path = list[i];
      if (support.group.empty()) checker_.CheckFields(path, support);
      CheckGroup(path, support.node, support.group);
      if (!support.fixed_x && !support.fixed_y && !support.fixed_rotation)
        checker_.Add(path, support.group.empty() ? support.node : support.group,
                     "fixed_x, fixed_y or fixed_rotation must be true");
      if (const std::string* const node = support.fixed_rotation ? FirstThatNoBeamTurns(support) : nullptr)
        checker_.Add(path.Key("fixed_rotation"), "true", "must be false: no beam turns node " + *node);
    }
  }

  // Null: there is none among its nodes.
  const std::string* FirstThatNoBeamTurns(const Support& support) const {
    const auto stays = [&](const std::string& node) {
      return checker_.KnownNode(node) != nullptr && !checker_.Turns(node);
    };
    if (stays(support.node)) return &support.node;
    for (const Group& group : scene_.groups) {
      const auto found = std::find_if(group.nodes.begin(), group.nodes.end(), stays);
      if (group.name == support.group && found != group.nodes.end()) return &*found;
    }
    return nullptr;
  }

  // Of a scene or a stage.
  template <typename Loading>
  void CheckLoading(const KeyPath& where, const Loading& loading) {
    const KeyPath list = where.Key("loads"), motions = where.Key("support_motions");
    for (std::size_t i = 0; i < loading.support_motions.size(); ++i) {
      CheckGroup(motions[i], loading.support_motions[i].node, loading.support_motions[i].group);
      CheckBody(motions[i], loading.support_motions[i]);
    }
    for (std::size_t i = 0; i < loading.loads.size(); ++i) {
      const Load& load = loading.loads[i];
      if (!load.solid.empty() || !load.beam.empty()) {
        CheckWeight(list[i], load);
        continue;
      }
      if (const double weight = load.bx != 0.0 ? load.bx : load.by; weight != 0.0 && load.body.empty())
        checker_.Add(list[i].Key(load.bx != 0.0 ? "bx" : "by"), NumberText(weight),
                     "must be 0: a weight needs a solid, a beam or a body");
      if (!load.surface.empty()) {
        CheckSurfaceLoad(list[i], load);
        continue;
      }
      CheckGroup(list[i], load.node, load.group);
      CheckBody(list[i], load);
      const bool traction = load.px != 0.0 || load.py != 0.0;
      if (traction && beams_.count(load.group) == 0)
        checker_.Add(list[i].Key(load.px != 0.0 ? "px" : "py"), NumberText(load.px != 0.0 ? load.px : load.py),
                     "must be 0: a traction needs a surface, or a beam as its group");
    }
  }

  Checker& checker_;
  const Scene& scene_;
  std::unordered_set<std::string> groups_, beams_;
};

}  // namespace

void CheckParts(Checker* checker) {
  BeamRules(checker).Check();
  CheckBodies(checker);
}

void CheckGroups(Checker* checker) { GroupRules(checker).Check(); }

}  // namespace contact_path
