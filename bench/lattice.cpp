#include "lattice.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace contact_path {
namespace {

constexpr double kPress = 0.02;  // constant load on each unit of the top of a column, EA = 1

std::string NodeName(int column, int row) { return "n" + std::to_string(column) + "_" + std::to_string(row); }

class Lattice {
 public:
  explicit Lattice(const LatticeOptions& options) : options_(options) {}

  TraceRequest Build() {
    AddNodes();
    AddBars();
    switch (options_.kind) {
      case LatticeKind::kColumn: MakeColumn(); break;
      case LatticeKind::kWall: MakeWall(); break;
      case LatticeKind::kBlock: MakeBlock(); break;
    }
    AddFarCandidates();
    return std::move(request_);
  }

 private:
  Scene& scene() { return request_.scene; }
  Node& At(int column, int row) { return scene().nodes[Index(column, row)]; }
  std::size_t Index(int column, int row) const {
    return static_cast<std::size_t>(column) * static_cast<std::size_t>(options_.rows + 1) +
           static_cast<std::size_t>(row);
  }

  void AddNodes() {
    for (int column = 0; column <= options_.columns; ++column)
      for (int row = 0; row <= options_.rows; ++row) {
        Node node;
        node.name = NodeName(column, row);
        node.x = column;
        node.y = row;
        scene().nodes.push_back(std::move(node));
      }
  }

  void AddBar(int column_a, int row_a, int column_b, int row_b) {
    Bar bar;
    bar.nodes = {NodeName(column_a, row_a), NodeName(column_b, row_b)};
    bar.EA = 1.0;
    scene().bars.push_back(std::move(bar));
  }

  void AddBars() {
    const int columns = options_.columns, rows = options_.rows;
    for (int column = 0; column <= columns; ++column)
      for (int row = 0; row <= rows; ++row) {
        if (row < rows) AddBar(column, row, column, row + 1);
        if (column == columns) continue;
        AddBar(column, row, column + 1, row);
        if (row == rows) continue;
        AddBar(column, row, column + 1, row + 1);
        AddBar(column, row + 1, column + 1, row);
      }
  }

  void AddFloor(double height) {
    Obstacle floor;
    floor.name = "floor";
    floor.py = height;
    floor.ny = 1.0;
    floor.friction = options_.friction;
    scene().obstacles.push_back(std::move(floor));
  }

  // Spread over the lower edge from column `first` to column `last`, both among them.
  void AddCandidates(int first, int last) {
    const int edge = last - first + 1;
    const int count = options_.contacts == 0 ? edge : options_.contacts;
    for (int i = 0; i < count; ++i) {
      const int column = count == 1 ? (first + last) / 2 : first + i * (edge - 1) / (count - 1);
      scene().contacts.push_back({NodeName(column, 0), "floor"});
    }
  }

  void AddLoad(int column, int row, double fx, double fy, bool constant) {
    scene().loads.push_back({NodeName(column, row), fx, fy, constant});
  }

  void MakeColumn() {
    scene().name = "column";
    AddFloor(0.0);
    AddCandidates(0, options_.columns);
    for (int column = 0; column <= options_.columns; ++column) {
      const double share = column == 0 || column == options_.columns ? 0.5 : 1.0;
      AddLoad(column, options_.rows, 0.0, -kPress * share, true);
      AddLoad(column, options_.rows, kPress * share, 0.0, false);
    }
  }

  void HoldAboveFloor() {
    for (int row = 0; row <= options_.rows; ++row) At(0, row).fixed_x = At(0, row).fixed_y = true;
    AddFloor(-0.02);
    AddCandidates(1, options_.columns);
  }

  void MakeBlock() {
    scene().name = "block";
    HoldAboveFloor();
    for (int row = 0; row <= options_.rows; ++row) AddLoad(options_.columns, row, -1.0, -1.0, false);
  }

  void MakeWall() {
    scene().name = "wall";
    HoldAboveFloor();
    for (int column = 1; column <= options_.columns; ++column) AddLoad(column, options_.rows, 0.0, -1.0, false);
  }

  // Of free nodes with obstacles of their own, one after another, out of reach.
  void AddFarCandidates() {
    const double distance = 1000.0 * (options_.columns + options_.rows);
    std::vector<std::string> free_nodes;
    for (const Node& node : scene().nodes)
      if (!node.fixed_x && !node.fixed_y) free_nodes.push_back(node.name);
    const std::size_t obstacles = (static_cast<std::size_t>(options_.far_candidates) + free_nodes.size() - 1) /
                                  std::max<std::size_t>(free_nodes.size(), 1);
    for (std::size_t i = 0; i < obstacles; ++i) {
      Obstacle obstacle;
      obstacle.name = "far_" + std::to_string(i);
      obstacle.px = distance * static_cast<double>(i + 1);
      obstacle.nx = -1.0;
      obstacle.friction = options_.friction;
      scene().obstacles.push_back(std::move(obstacle));
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(options_.far_candidates); ++i)
      scene().contacts.push_back({free_nodes[i % free_nodes.size()], "far_" + std::to_string(i / free_nodes.size())});
  }

  const LatticeOptions options_;
  TraceRequest request_;
};

}  // namespace

TraceRequest LatticeRequest(const LatticeOptions& options) { return Lattice(options).Build(); }

}  // namespace contact_path
