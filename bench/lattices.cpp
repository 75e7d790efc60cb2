#include "lattices.h"

#include <cholmod.h>

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/equations/fixed_mode_system.h"

namespace contact_path {
namespace {

constexpr Eigen::Index kFewEntries = 64;
constexpr int kSegments = 4;
constexpr int kEdges = 1000;     // of a polyline far away
constexpr double kAside = 10.0;  // between it and the wall
constexpr double kWave = 1.0;    // its height

std::string NameAt(int column, int row) { return "n" + std::to_string(column) + "_" + std::to_string(row); }

Beam BeamBetween(std::string first, std::string second) {
  Beam beam;
  beam.nodes = {std::move(first), std::move(second)};
  beam.EA = 1e4;
  beam.EI = 1.0;
  beam.segments = kSegments;
  return beam;
}

}  // namespace

TraceRequest WallOf(int dofs, int far_candidates) {
  LatticeOptions options;
  options.kind = LatticeKind::kWall;
  const double nodes = 0.5 * dofs;
  options.rows = std::max(2, static_cast<int>(std::lround(std::sqrt(nodes / 5.0))) - 1);
  options.columns = static_cast<int>(std::lround(nodes / (options.rows + 1)));
  options.contacts = std::min(options.columns, std::max(1, dofs / 200));
  options.far_candidates = far_candidates;
  return LatticeRequest(options);
}

void AddFarCurve(int candidates, Scene* wall) {
  double right = 0.0;
  for (const Node& node : wall->nodes) right = std::max(right, node.x);
  Obstacle line;
  line.name = "far_floor";
  line.shape = ObstacleShape::kPolyline;
  line.py = -kAside - kWave;
  line.friction = 0.3;
  for (int i = 0; i <= kEdges; ++i) {
    const double along = static_cast<double>(i) / kEdges;
    line.points.insert(line.points.end(), {right * (1.4 * along - 0.2), kWave * std::sin(40.0 * along)});
  }
  wall->obstacles.push_back(line);
  for (const Node& node : wall->nodes)
    if (candidates > 0 && !node.fixed_x && !node.fixed_y) {
      wall->contacts.push_back({node.name, line.name});
      --candidates;
    }
  if (candidates > 0) throw std::invalid_argument("the wall has fewer free nodes than candidates");
}

TraceRequest BlockOf(int dofs, int contacts, double gap) {
  LatticeOptions options;
  options.kind = LatticeKind::kBlock;
  options.rows = std::max(2, static_cast<int>(std::lround(std::sqrt(0.5 * dofs))) - 1);
  options.columns = options.rows + 1;
  options.contacts = contacts;
  TraceRequest request = LatticeRequest(options);
  request.scene.obstacles.front().py = -gap;
  return request;
}

TraceRequest FrameOf(int dofs) {
  // Of each cell a joint, a column and a beam.
  const int per_cell = 3 * (1 + 2 * (kSegments - 1));
  const int cells = std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(dofs) / per_cell))));
  TraceRequest request;
  Scene& scene = request.scene;
  for (int row = 0; row <= cells; ++row)
    for (int column = 0; column <= cells; ++column) {
      const bool ground = row == 0;
      scene.nodes.push_back({NameAt(column, row), 1.0 * column, 1.0 * row, ground, ground, ground});
      if (ground) continue;
      scene.beams.push_back(BeamBetween(NameAt(column, row - 1), NameAt(column, row)));
      if (column > 0) scene.beams.push_back(BeamBetween(NameAt(column - 1, row), NameAt(column, row)));
      if (column == 0) scene.loads.push_back({NameAt(column, row), 1.0, 0.0});
    }
  return request;
}

TraceRequest SolidOf(int cells, MaterialModel model, PlaneState plane) {
  TraceRequest request;
  Scene& scene = request.scene;
  Material material;
  material.name = "m";
  material.model = model;
  material.E = 1.0;
  material.nu = 0.3;
  scene.materials = {material};
  Solid solid;
  solid.material = "m";
  solid.plane = plane;
  solid.nodes_per_element = 4;
  const double side = 1.0 / cells;
  for (int row = 0; row <= cells; ++row)
    for (int column = 0; column <= cells; ++column) {
      const bool held = column == 0;
      scene.nodes.push_back({NameAt(column, row), side * column, side * row, held, held});
      if (column == cells) scene.loads.push_back({NameAt(column, row), 0.0, -side});
      if (row == 0 || column == 0) continue;
      for (const std::string& name :
           {NameAt(column - 1, row - 1), NameAt(column, row - 1), NameAt(column, row), NameAt(column - 1, row)})
        solid.nodes.push_back(name);
    }
  scene.solids = {solid};
  return request;
}

double CholmodTime(const Structure& structure, const Eigen::VectorXd& u) {
  using Clock = std::chrono::steady_clock;
  Eigen::SparseMatrix<double> tangent = structure.TangentPattern();
  structure.Tangent(u, &tangent);
  cholmod_common common;
  cholmod_start(&common);
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_METIS;
  common.supernodal = CHOLMOD_SUPERNODAL;
  cholmod_sparse matrix = Eigen::viewAsCholmod(std::as_const(tangent).selfadjointView<Eigen::Lower>());
  cholmod_factor* factor = cholmod_analyze(&matrix, &common);
  double least = 1e9;
  for (int i = 0; i < 3; ++i) {
    const Clock::time_point start = Clock::now();
    cholmod_factorize(&matrix, factor, &common);
    least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
  }
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
  return least;
}

Eigen::SparseMatrix<double> BorderedMatrix(const Model& model, ContactState state) {
  FixedModeSystem system(model.structure, model.laws);
  PathPoint point = model.InitialPoint();
  for (Mode& mode : point.modes) mode.state = NumberOf(state);
  system.SetModes(point.modes);
  // Away from the stress-free state, as along a path.
  for (Eigen::Index i = 0; i < point.u.size(); ++i) point.u[i] += 1e-3 * std::sin(1.7 * static_cast<double>(i));
  const Eigen::SparseMatrix<double> transposed = system.TransposedJacobian(system.Pack(point));
  std::vector<Eigen::Triplet<double>> triplets;
  for (Eigen::Index k = 0; k < transposed.outerSize(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, k); it; ++it)
      triplets.emplace_back(it.row(), it.col(), it.value());
  for (Eigen::Index i = 0; i <= system.NumDofs(); i += 1 + system.NumDofs() / kFewEntries)
    triplets.emplace_back(i, transposed.cols(), std::cos(static_cast<double>(i)));
  Eigen::SparseMatrix<double> matrix(transposed.rows(), transposed.cols() + 1);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  matrix.makeCompressed();
  return matrix;
}

}  // namespace contact_path
