// Meshes of solids for tests.
#ifndef CONTACT_PATH_TEST_SUPPORT_SOLID_GRID_H_
#define CONTACT_PATH_TEST_SUPPORT_SOLID_GRID_H_

#include <Eigen/Core>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/scene/scene.h"

namespace contact_path {

// E: Young's modulus. a of a Ciarlet-Geymonat material is 0.3 times the shear modulus, within its bounds from nu =
// 0.23.
inline Material ElasticMaterial(const std::string& name, double E, double nu,
                                MaterialModel model = MaterialModel::kNeoHookean) {
  Material material;
  material.name = name;
  material.model = model;
  material.E = E;
  material.nu = nu;
  if (model == MaterialModel::kCiarletGeymonat) material.a = 0.3 * E / (2.0 * (1.0 + nu));
  return material;
}

// With lambda = 1.5 and mu = 1.
inline Material LameMaterial(MaterialModel model) {
  Material material = ElasticMaterial("m", 2.6, 0.3, model);
  material.E = material.nu = 0.0;
  material.lambda = 1.5;
  material.mu = 1.0;
  return material;
}

// Without elements so far.
inline Solid SolidOf(const std::string& material, int nodes_per_element = 4) {
  Solid solid;
  solid.material = material;
  solid.nodes_per_element = nodes_per_element;
  return solid;
}

// A mesh of nx x ny cells over the unit square, mapped by `place`. A node at (i / 2 nx, j / 2 ny) has the name "i_j":
// corners of cells have even numbers, mid-sides odd ones. Triangles halve the cells. solid: what it is made of, and
// nodes_per_element.
inline void AddGrid(Scene* scene, int nx, int ny, const std::function<Eigen::Vector2d(double, double)>& place,
                    Solid solid) {
  const auto per_element = solid.NodesPerElement();
  std::vector<std::vector<std::pair<int, int>>> cells;  // corners in the lattice of half cells
  for (int j = 0; j < 2 * ny; j += 2)
    for (int i = 0; i < 2 * nx; i += 2) {
      const std::pair<int, int> a(i, j), b(i + 2, j), c(i + 2, j + 2), d(i, j + 2);
      if (per_element == 4 || per_element == 8) {
        cells.push_back({a, b, c, d});
      } else {
        cells.push_back({a, b, c});
        cells.push_back({a, c, d});
      }
    }
  std::set<std::pair<int, int>> known;
  const auto add = [&](const std::pair<int, int>& at) {
    const std::string name = std::to_string(at.first) + "_" + std::to_string(at.second);
    if (known.insert(at).second) {
      const Eigen::Vector2d position = place(0.5 * at.first / nx, 0.5 * at.second / ny);
      scene->nodes.push_back({name, position[0], position[1]});
    }
    solid.nodes.push_back(name);
  };
  for (const auto& corners : cells) {
    for (const auto& corner : corners) add(corner);
    if (per_element < 6) continue;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto &from = corners[k], &to = corners[(k + 1) % corners.size()];
      add({(from.first + to.first) / 2, (from.second + to.second) / 2});
    }
  }
  scene->solids.push_back(std::move(solid));
}

// The same with `prefix` before the names of the nodes.
inline void AddNamedGrid(Scene* scene, const std::string& prefix, int nx, int ny,
                         const std::function<Eigen::Vector2d(double, double)>& place, Solid solid) {
  Scene part;
  AddGrid(&part, nx, ny, place, std::move(solid));
  for (Node& node : part.nodes) {
    node.name.insert(0, prefix);
    scene->nodes.push_back(node);
  }
  for (std::string& node : part.solids[0].nodes) node.insert(0, prefix);
  scene->solids.push_back(part.solids[0]);
}

// The node of a grid with this name.
inline Node& GridNode(Scene* scene, int i, int j) {
  const std::string name = std::to_string(i) + "_" + std::to_string(j);
  for (Node& node : scene->nodes)
    if (node.name == name) return node;
  throw std::out_of_range(name);
}

inline bool HasGridNode(const Scene& scene, int i, int j) {
  const std::string name = std::to_string(i) + "_" + std::to_string(j);
  for (const Node& node : scene.nodes)
    if (node.name == name) return true;
  return false;
}

// Nodes at the height `held` are held; those at `touching` are candidates of the obstacle, which moves by dy.
inline void PressOn(const Obstacle& obstacle, double dy, double held, double touching, Scene* scene) {
  scene->obstacles = {obstacle};
  scene->obstacle_motions = {{obstacle.name, 0.0, dy}};
  for (Node& node : scene->nodes) {
    node.fixed_x = node.fixed_y = node.y == held;
    if (node.y == touching) scene->contacts.push_back({node.name, obstacle.name});
  }
}

// A block of width 1 and height 1 whose top is displaced by -lean, held below, on nx x ny elements of so many nodes,
// pressed by a rough plate that comes down by 0.2.
inline TraceRequest PressedBlock(int nx, int ny, int nodes_per_element, double lean, double friction) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "pressed block";
  scene.materials = {ElasticMaterial("m", 1.0, 0.3)};
  AddGrid(
      &scene, nx, ny, [&](double x, double y) { return Eigen::Vector2d(x - lean * y, y); },
      SolidOf("m", nodes_per_element));
  PressOn({"plate", ObstacleShape::kHalfPlane, 0.0, 1.0, 0.0, -1.0, friction}, -1.0, 0.0, 1.0, &scene);
  request.options.stop = {{"load_factor", ">", 0.2}};
  return request;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_SOLID_GRID_H_
