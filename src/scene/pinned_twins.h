// Nodes that are pinned to nodes of bodies.
#ifndef CONTACT_PATH_SRC_SCENE_PINNED_TWINS_H_
#define CONTACT_PATH_SRC_SCENE_PINNED_TWINS_H_

#include <algorithm>
#include <string>
#include <unordered_map>
#include <vector>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// Nodes of bodies in parts that take no such nodes: nodes of their own in their places, pinned to them.
class PinnedTwins {
 public:
  // scene: expanded; must outlive this.
  explicit PinnedTwins(const Scene& scene) {
    for (const Node& node : scene.nodes)
      if (IsAttached(node)) attached_.emplace(node.name, node);
  }

  bool IsOfBody(const std::string& node) const { return attached_.count(node) > 0; }
  std::string TwinOf(const std::string& node) {
    if (std::find(twins_.begin(), twins_.end(), node) == twins_.end()) twins_.push_back(node);
    return node + kTwin;
  }
  // The curve of a surface that contacts touch is that of twins.
  void Bear(BoundarySurface* surface) {
    for (std::string& node : surface->nodes)
      if (IsOfBody(node)) node = TwinOf(node);
  }
  // Calls add(load) with the force on the twin, and the moment on the body.
  template <typename Add>
  void Move(const Load& load, Add&& add) {
    const auto found = attached_.find(load.node);
    if (found == attached_.end()) return add(load);
    if (load.fx != 0.0 || load.fy != 0.0 || load.moment == 0.0)
      add(Load{TwinOf(load.node), load.fx, load.fy, load.constant});
    if (load.moment != 0.0) add(Load{found->second.body, 0.0, 0.0, load.constant, load.moment});
  }
  void AddTo(Scene* scene) const {
    for (const std::string& name : twins_) {
      const Node& at = attached_.at(name);
      scene->nodes.push_back({name + kTwin, at.x, at.y});
      scene->nodes.back().twin_of = name;
      scene->pins.push_back({{name + kTwin, name}, 0.0, 0.0, name + "_pinned"});
    }
  }

 private:
  static constexpr const char* kTwin = "/pinned";

  std::unordered_map<std::string, Node> attached_;
  std::vector<std::string> twins_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_PINNED_TWINS_H_
