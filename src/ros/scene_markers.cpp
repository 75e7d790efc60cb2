#include "contact_path/ros/scene_markers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

#include "contact_path/path/stop.h"
#include "contact_path/scene/cell.h"
#include "contact_path/scene/configuration.h"
#include "contact_path/scene/elasticity.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/one_line.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/quantity.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/scene_elements.h"
#include "ros/marker_picture.h"

namespace contact_path {
namespace {

namespace msgs = contact_path_msgs;
using Eigen::Vector2d;
using std_msgs::ColorRGBA;
using visualization_msgs::Marker;

// Lengths in parts of the scene's size.
constexpr double kFullArrow = 0.2;
constexpr int kMostStrokes = 200;  // of a moving obstacle
constexpr int kCurveSteps = 100;   // of each half of a boundary that is no straight line
constexpr double kStripDepth = 0.05;
constexpr double kTextHeight = 0.045;
constexpr double kFarthestStop = 5.0;
constexpr double kMostCone = 0.12;  // edge of a cone

// Lengths in parts of the detail.
constexpr double kBarWidth = 0.35;
constexpr double kThinWidth = 0.2;
constexpr double kContactDiameter = 1.6;
constexpr double kSupportHeight = 2.2;
constexpr double kConeEdge = 6.0;

// Arrows that are shorter, in parts of the full length, are left out.
constexpr double kShortest = 1e-3;

// Energy per volume of a solid, of Young's modulus, that has the darkest colour.
constexpr double kFullEnergy = 0.01;

constexpr double kRounding = 1e-6;  // of sums of unit vectors

// As in the drawings of scripts/plot.
const ColorRGBA kGround = Colour(0.85F, 0.85F, 0.85F);
const ColorRGBA kGroundLine = Colour(0.45F, 0.45F, 0.45F);
const ColorRGBA kInitialColour = Colour(0.80F, 0.80F, 0.80F);
const ColorRGBA kBarColour = Colour(0.27F, 0.33F, 0.42F);
const ColorRGBA kSpringColour = Colour(0.35F, 0.55F, 0.65F);
const ColorRGBA kSupportColour = Colour(0.60F, 0.60F, 0.60F);
const ColorRGBA kLoadColour = Colour(0.13F, 0.40F, 0.67F);
const ColorRGBA kConstantLoadColour = Colour(0.50F, 0.70F, 0.84F);
const ColorRGBA kReactionColour = Colour(0.70F, 0.09F, 0.17F);
const ColorRGBA kConeColour = Colour(0.70F, 0.09F, 0.17F, 0.45F);
const ColorRGBA kTextColour = Colour(0.25F, 0.25F, 0.25F);

ColorRGBA StateColour(std::uint8_t state) {
  switch (state) {
    case msgs::ContactState::STICK: return Colour(0.84F, 0.37F, 0.00F);
    case msgs::ContactState::SLIP_PLUS: return Colour(0.94F, 0.75F, 0.00F);
    case msgs::ContactState::SLIP_MINUS: return Colour(0.34F, 0.71F, 0.91F);
    case msgs::ContactState::CLOSED: return Colour(0.00F, 0.62F, 0.45F);
    default: return Colour(0.70F, 0.70F, 0.70F);
  }
}

// As a part of the caption; nothing for a regular increment.
const char* KindInWords(std::uint8_t kind) {
  switch (kind) {
    case msgs::Increment::START: return ", start";
    case msgs::Increment::SMOOTH_LIMIT: return ", smooth limit point";
    case msgs::Increment::CORNER_LIMIT: return ", corner limit point";
    case msgs::Increment::CONTACT_EVENT: return ", contact event";
    case msgs::Increment::BIFURCATION: return ", bifurcation";
    default: return "";
  }
}

// Where an element holds its first node; at the start, unless its description tells.
template <typename Part>
Vector2d RestOfFirstNode(const Part&, const Vector2d& start) {
  return start;
}
Vector2d RestOfFirstNode(const Superelement& element, const Vector2d& start) {
  const std::vector<double>& rest = element.rest_positions;
  return rest.empty() ? start : Vector2d(rest[0], rest[1]);
}

Vector2d MiddleOf(const std::vector<std::size_t>& nodes, const std::vector<Vector2d>& places) {
  Vector2d sum = Vector2d::Zero();
  for (const std::size_t node : nodes) sum += places[node];
  return sum / static_cast<double>(nodes.size());
}

// share: of the energy that has the darkest colour. The root, so that colours follow the strain.
ColorRGBA SolidColour(double share) {
  const auto dark = static_cast<float>(std::sqrt(share > 0.0 ? std::min(share, 1.0) : 0.0));
  return Colour(0.85F - 0.35F * dark, 0.88F - 0.75F * dark, 0.93F - 0.8F * dark);
}

// `least` times a power of two, at least `largest`.
double FullForce(double largest, double least) {
  return largest <= least ? least : least * std::exp2(std::ceil(std::log2(largest / least)));
}

}  // namespace

void MarkerOptions::Validate() const {
  if (frame_id.empty() || frame_id.front() == '/') {
    throw std::invalid_argument("frame_id = \"" + frame_id + "\": must not be empty or begin with a slash");
  }
  if (!std::isfinite(picture_size) || picture_size < 0.0) {
    throw std::invalid_argument("picture_size = " + std::to_string(picture_size) + ": must be finite and >= 0");
  }
}

SceneMarkers::SceneMarkers(const TraceRequest& request_given, const MarkerOptions& options)
    : options_(options), name_(OneLine(request_given.scene.name)) {
  const ExpandedRequest expanded(request_given);
  const TraceRequest& request = expanded.Get();
  const Scene& scene = request.scene;
  const SceneIndex index(scene);
  for (const Node& node : scene.nodes) {
    initial_.emplace_back(node.x, node.y);
    box_.extend(initial_.back());
  }
  ForEachElementList(scene, [&](std::string_view, const auto& elements) {
    using Part = typename std::decay_t<decltype(elements)>::value_type;
    for (const Part& element : elements) {
      if constexpr (std::is_same_v<Part, Solid>) {
        AddMesh(element, scene, index);
      } else if constexpr (std::is_same_v<Part, Beam>) {
        for (std::size_t i = 0; i + 1 < element.nodes.size(); ++i)
          bars_.push_back({index.Node(element.nodes[i]), index.Node(element.nodes[i + 1])});
      } else if constexpr (Fields<Part>::kNodes == 2) {
        bars_.push_back({index.Node(element.nodes[0]), index.Node(element.nodes[1])});
      } else {
        std::vector<std::size_t>& members = stars_.emplace_back();
        for (const std::string& node : element.nodes) members.push_back(index.Node(node));
        rest_.push_back(RestOfFirstNode(element, initial_[members[0]]));
      }
    }
  });
  FindSupports(scene);
  for (const ContactCandidate& contact : scene.contacts) {
    contacts_.push_back({index.Node(contact.node), index.Obstacle(contact.obstacle)});
  }

  // What a stage begins with: of the scene, and what the stages before have brought on.
  StageParts now;
  Places places = initial_;
  const auto add_loads = [&](const std::vector<Load>& loads, StageParts* parts) {
    for (const Load& load : loads)
      parts->loads.push_back({index.Node(load.node), Vector2d(load.fx, load.fy), load.constant});
  };
  const auto add_stage = [&](const std::vector<ObstacleMotion>& motions) -> StageParts& {
    StageParts& parts = stages_.emplace_back(now);
    for (const ObstacleMotion& motion : motions)
      parts.obstacles[index.Obstacle(motion.obstacle)].motion += Vector2d(motion.dx, motion.dy);
    return parts;
  };
  add_loads(scene.loads, &now);
  for (const Obstacle& obstacle : scene.obstacles) {
    DrawnObstacle& drawn = now.obstacles.emplace_back();
    drawn.surface = MakeSurface(obstacle);
    drawn.point = {obstacle.px, obstacle.py};
    drawn.friction = obstacle.friction;
  }

  has_program_ = !request.program.empty();
  if (!has_program_) add_stage(scene.obstacle_motions);
  for (std::size_t i = 0; i < request.program.size(); ++i) {
    const Stage stage = StageAsTraced(request, i);
    StageParts& parts = add_stage(stage.obstacle_motions);
    parts.title = stage.name.empty() ? "stage " + std::to_string(stages_.size()) : OneLine(stage.name);
    const double target = stage.Target();
    if (stage.unload) {
      for (std::size_t k = scene.loads.size(); k < now.loads.size(); ++k) {
        parts.loads[k].taken_back = true;
        now.loads[k].force *= 1.0 - target;
      }
    } else {
      add_loads(stage.loads, &parts);
      for (const Load& load : stage.loads)
        now.loads.push_back({index.Node(load.node), target * Vector2d(load.fx, load.fy), /*constant=*/true});
    }
    for (const ObstacleMotion& motion : stage.obstacle_motions)
      now.obstacles[index.Obstacle(motion.obstacle)].shift += target * Vector2d(motion.dx, motion.dy);
    for (const SupportMotion& motion : stage.support_motions) {
      Vector2d& place = places[index.Node(motion.node)];
      place += target * Vector2d(motion.dx, motion.dy);
      box_.extend(place);
    }
  }

  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    const bool moves = std::any_of(stages_.begin(), stages_.end(),
                                   [i](const StageParts& stage) { return !stage.obstacles[i].motion.isZero(0.0); });
    for (StageParts& stage : stages_) stage.obstacles[i].moves = moves;
  }

  const Scaling scales = StageScales(request, index, 0, ProgramScales(request, index));
  ExtendBox(request, index, kFarthestStop * std::max(box_.diagonal().norm(), scales.length));
  const double diagonal = box_.diagonal().norm();
  size_ = diagonal > 0.0 ? diagonal : scales.length;
  detail_ = std::min(0.025 * size_, bars_.empty() ? size_ : 0.12 * scales.length);
  if (!cells_.empty()) detail_ = std::min(detail_, 0.12 * CellSize());
  least_force_ = 1e-3 * scales.force;
}

// The ground is where no bars are, as far as the fixed components let it be.
void SceneMarkers::AddMesh(const Solid& solid, const Scene& scene, const SceneIndex& index) {
  const double modulus = YoungModulus(LameOf(scene.materials[index.Material(solid.material)]));
  for (PlacedElement& placed : MakeSolidElements(solid, scene, index, Configuration::Of(scene).reference)) {
    Cell cell;
    cell.nodes.assign(placed.nodes.begin(), placed.nodes.end());
    for (const std::size_t local : CellBoundary(cell.nodes.size())) cell.boundary.push_back(cell.nodes[local]);
    std::vector<double> positions;
    for (const std::size_t node : cell.nodes)
      positions.insert(positions.end(), {initial_[node].x(), initial_[node].y()});
    for (const PlacedPoint& point : PlacePoints(positions)) cell.area += point.area;
    cell.element = std::move(placed.element);
    cell.full_energy = kFullEnergy * modulus * cell.area * solid.Thickness();
    cells_.push_back(std::move(cell));
  }
}

double SceneMarkers::CellSize() const {
  double area = 0.0;
  for (const Cell& cell : cells_) area += cell.area;
  return std::sqrt(area / static_cast<double>(cells_.size()));
}

void SceneMarkers::FindSupports(const Scene& scene) {
  Places inwards(initial_.size(), Vector2d::Zero());
  for (const auto& [a, b] : bars_) {
    const Vector2d along = (initial_[b] - initial_[a]).stableNormalized();
    inwards[a] += along;
    inwards[b] -= along;
  }
  for (const Cell& cell : cells_) {
    const Vector2d middle = MiddleOf(cell.nodes, initial_);
    for (const std::size_t node : cell.nodes) inwards[node] += (middle - initial_[node]).stableNormalized();
  }
  for (std::size_t i = 0; i < initial_.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (!node.fixed_x && !node.fixed_y) continue;
    Places directions;
    if (node.fixed_y) directions = {{0.0, -1.0}, {0.0, 1.0}};
    if (node.fixed_x) directions.insert(directions.end(), {{-1.0, 0.0}, {1.0, 0.0}});
    Vector2d ground = directions.front();
    for (const Vector2d& direction : directions) {
      if (direction.dot(inwards[i]) < ground.dot(inwards[i]) - kRounding) ground = direction;
    }
    supports_.push_back({i, ground, !(node.fixed_x && node.fixed_y)});
  }
}

// By the places that nodes are to reach: where stop criteria lie, unless that is farther than `reach` from the start.
void SceneMarkers::ExtendBox(const TraceRequest& request, const SceneIndex& index, double reach) {
  const std::vector<Quantity> quantities = StopQuantities(request, index);
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const Quantity& quantity = quantities[i];
    if (!quantity.IsOfNode()) continue;
    const Vector2d& start = initial_[quantity.part];
    Vector2d place = start;
    (quantity.kind == Quantity::Kind::kX ? place.x() : place.y()) = request.options.stop[i].value;
    if ((place - start).norm() <= reach) box_.extend(place);
  }
}

const SceneMarkers::StageParts& SceneMarkers::StageOf(const msgs::Increment& increment) const {
  return stages_[has_program_ ? increment.stage - 1 : 0];
}

bool SceneMarkers::Fits(const msgs::Increment& increment) const {
  const bool of_a_stage =
      has_program_ ? increment.stage >= 1 && increment.stage <= stages_.size() : increment.stage == 0;
  return of_a_stage && increment.x.size() == initial_.size() && increment.y.size() == initial_.size() &&
         increment.contacts.size() == contacts_.size();
}

double SceneMarkers::LargestForce(const msgs::Increment& increment) const {
  double square = 0.0;
  for (const NodalLoad& load : StageOf(increment).loads) {
    square = std::max(square, load.Force(increment.load_factor).squaredNorm());
  }
  for (const msgs::ContactState& contact : increment.contacts) {
    square = std::max(square, contact.rn * contact.rn + contact.rt * contact.rt);
  }
  return std::sqrt(square);
}

visualization_msgs::MarkerArray SceneMarkers::Draw(const msgs::Increment& increment, double largest_force) const {
  std::ostringstream caption;
  caption.imbue(std::locale::classic());
  caption << name_ << "   ";
  if (has_program_) caption << StageOf(increment).title << "   ";
  caption << "increment " << increment.index << KindInWords(increment.kind) << "\nload factor "
          << increment.load_factor;
  return Draw(increment, largest_force, caption.str());
}

visualization_msgs::MarkerArray SceneMarkers::DrawInitial() const {
  msgs::Increment increment;
  increment.stage = has_program_ ? 1 : 0;
  for (const Vector2d& place : initial_) {
    increment.x.push_back(place.x());
    increment.y.push_back(place.y());
  }
  increment.contacts.resize(contacts_.size());
  return Draw(increment, LargestForce(increment), name_ + "   initial shape");
}

visualization_msgs::MarkerArray SceneMarkers::Draw(const msgs::Increment& increment, double largest_force,
                                                   const std::string& caption) const {
  Places places;
  places.reserve(increment.x.size());
  for (std::size_t i = 0; i < increment.x.size(); ++i) places.emplace_back(increment.x[i], increment.y[i]);
  const double full_force = FullForce(largest_force, least_force_);
  MarkerPicture picture(size_, detail_);
  DrawObstacles(places, increment, &picture);
  DrawStructure(places, &picture);
  DrawStars(places, &picture);
  DrawMeshes(places, &picture);
  DrawSupports(places, &picture);
  DrawContacts(places, increment, &picture);
  DrawForces(places, increment, full_force, &picture);
  DrawCaption(caption, full_force, &picture);
  if (options_.picture_size == 0.0) return picture.Finish(options_.frame_id, Vector2d::Zero(), 1.0);
  return picture.Finish(options_.frame_id, box_.center(), options_.picture_size / size_);
}

std::vector<SceneMarkers::BoundaryPoint> SceneMarkers::BoundaryOf(const DrawnObstacle& obstacle, double load_factor,
                                                                  const Vector2d& centre, double half_length) {
  const auto foot_of = [&](const Vector2d& x) {
    const Projection at = obstacle.ProjectAt(load_factor, x);
    return BoundaryPoint{x - at.gap * at.normal, at.normal, at.xi};
  };
  const BoundaryPoint middle = foot_of(centre);
  if (obstacle.surface->Flat()) {
    const Vector2d half = half_length * Tangent(middle.normal);
    return {foot_of(middle.place - half), foot_of(middle.place + half)};
  }
  const double length = half_length / kCurveSteps;
  std::vector<BoundaryPoint> points = {middle};
  // First backwards to the begin, then forwards to the end.
  for (int k = 0; k < kCurveSteps; ++k)
    points.push_back(foot_of(points.back().place - length * Tangent(points.back().normal)));
  std::reverse(points.begin(), points.end());
  for (int k = 0; k < kCurveSteps; ++k)
    points.push_back(foot_of(points.back().place + length * Tangent(points.back().normal)));
  return points;
}

void SceneMarkers::DrawObstacles(const Places& places, const msgs::Increment& increment, MarkerPicture* picture) const {
  // Long enough for the nodes, and of a length that hardly ever changes.
  const Vector2d centre = box_.center();
  double reach = 0.0;
  for (const Vector2d& place : places) reach = std::max(reach, (place - centre).norm());
  const double half_length = size_ * std::ceil(reach / size_ + 0.25);
  const std::vector<DrawnObstacle>& obstacles = StageOf(increment).obstacles;
  std::vector<std::vector<BoundaryPoint>> boundaries;
  boundaries.reserve(obstacles.size());
  for (const DrawnObstacle& obstacle : obstacles)
    boundaries.push_back(BoundaryOf(obstacle, increment.load_factor, centre, half_length));
  const double depth = kStripDepth * size_;

  picture->BeginTriangles("obstacles", 0, kGround, kStrips);
  for (const std::vector<BoundaryPoint>& boundary : boundaries) {
    for (std::size_t k = 1; k < boundary.size(); ++k) {
      const BoundaryPoint &from = boundary[k - 1], &to = boundary[k];
      picture->AddTriangle(from.place, from.place - depth * from.normal, to.place - depth * to.normal);
      picture->AddTriangle(from.place, to.place - depth * to.normal, to.place);
    }
  }
  picture->BeginLines("obstacles", 1, kBarWidth * detail_, kGroundLine, kBoundaries);
  for (const std::vector<BoundaryPoint>& boundary : boundaries)
    for (std::size_t k = 1; k < boundary.size(); ++k) picture->AddLine(boundary[k - 1].place, boundary[k].place);
  picture->BeginLines("obstacles", 2, kThinWidth * detail_, kGroundLine, kBoundaries);
  const double distance = std::max(2.0 * depth, 2.0 * half_length / kMostStrokes);
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    if (!obstacles[i].moves) continue;
    // At multiples of the distance from the point that moves.
    const double xi_of_point = obstacles[i].surface->Project(obstacles[i].point).xi;
    for (std::size_t k = 1; k < boundaries[i].size(); ++k) {
      const BoundaryPoint &from = boundaries[i][k - 1], &to = boundaries[i][k];
      const double length = to.xi - from.xi;
      double along = std::fmod(xi_of_point - from.xi, distance);
      if (along < 0.0) along += distance;
      for (; along < length; along += distance) {
        const Vector2d place = from.place + along / length * (to.place - from.place);
        picture->AddLine(place, place - depth * (from.normal + Tangent(from.normal)));
      }
    }
  }
}

void SceneMarkers::DrawStructure(const Places& places, MarkerPicture* picture) const {
  picture->BeginLines("initial", 0, kThinWidth * detail_, kInitialColour, kInitial);
  for (const auto& [a, b] : bars_) picture->AddLine(initial_[a], initial_[b]);
  picture->BeginDots("initial", 1, Marker::SPHERE_LIST, 0.6 * detail_, kInitialColour, kInitial);
  for (const Vector2d& place : initial_) picture->AddPoint(place);

  picture->BeginLines("structure", 0, kBarWidth * detail_, kBarColour, kBars);
  for (const auto& [a, b] : bars_) picture->AddLine(places[a], places[b]);
  picture->BeginDots("structure", 1, Marker::SPHERE_LIST, detail_, kBarColour, kNodes);
  for (const Vector2d& place : places) picture->AddPoint(place);
}

void SceneMarkers::DrawStars(const Places& places, MarkerPicture* picture) const {
  Places middles;
  for (std::size_t i = 0; i < stars_.size(); ++i)
    middles.push_back(stars_[i].size() == 1 ? rest_[i] : MiddleOf(stars_[i], places));
  picture->BeginLines("superelements", 0, kBarWidth * detail_, kSpringColour, kSprings);
  for (std::size_t i = 0; i < stars_.size(); ++i) {
    for (const std::size_t node : stars_[i]) picture->AddLine(places[node], middles[i]);
  }
  picture->BeginDots("superelements", 1, Marker::CUBE_LIST, detail_, kSpringColour, kSprings);
  for (const Vector2d& middle : middles) picture->AddPoint(middle);
}

void SceneMarkers::DrawMeshes(const Places& places, MarkerPicture* picture) const {
  const auto draw_boundaries = [&](const Places& at) {
    for (const Cell& cell : cells_)
      for (std::size_t i = 0; i < cell.boundary.size(); ++i)
        picture->AddLine(at[cell.boundary[i]], at[cell.boundary[(i + 1) % cell.boundary.size()]]);
  };
  picture->BeginLines("solids", 0, kThinWidth * detail_, kInitialColour, kInitial);
  draw_boundaries(initial_);
  picture->BeginTriangles("solids", 1, SolidColour(0.0), kSprings);
  for (const Cell& cell : cells_) {
    Eigen::VectorXd x(static_cast<Eigen::Index>(2 * cell.nodes.size()));
    for (std::size_t i = 0; i < cell.nodes.size(); ++i)
      x.segment<2>(static_cast<Eigen::Index>(2 * i)) = places[cell.nodes[i]];
    const ColorRGBA colour = SolidColour(cell.element->Energy(x) / cell.full_energy);
    const Vector2d middle = MiddleOf(cell.nodes, places);
    for (std::size_t i = 0; i < cell.boundary.size(); ++i)
      picture->AddTriangle(middle, places[cell.boundary[i]], places[cell.boundary[(i + 1) % cell.boundary.size()]],
                           colour);
  }
  picture->BeginLines("solids", 2, kThinWidth * detail_, kBarColour, kBars);
  draw_boundaries(places);
}

void SceneMarkers::DrawSupports(const Places& places, MarkerPicture* picture) const {
  const double height = kSupportHeight * detail_;
  picture->BeginTriangles("supports", 0, kSupportColour, kSprings);
  for (const Support& support : supports_) {
    const Vector2d& node = places[support.node];
    const Vector2d side = 0.6 * height * Tangent(support.ground);
    const Vector2d foot = node + height * support.ground;
    picture->AddTriangle(node, foot - side, foot + side);
    if (!support.slides) continue;
    const Vector2d above = foot + 0.2 * height * support.ground;
    const Vector2d below = foot + 0.4 * height * support.ground;
    picture->AddTriangle(above - side, below - side, below + side);
    picture->AddTriangle(above - side, below + side, above + side);
  }
}

void SceneMarkers::DrawContacts(const Places& places, const msgs::Increment& increment, MarkerPicture* picture) const {
  const std::vector<msgs::ContactState>& states = increment.contacts;
  picture->BeginDots("contacts", 0, Marker::SPHERE_LIST, kContactDiameter * detail_, StateColour(0), kCandidates);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    // A node in a corner has several candidates: seen is one that touches.
    const Layer layer = states[i].state == msgs::ContactState::OPEN ? kCandidates : kTouching;
    picture->AddPoint(places[contacts_[i].node], StateColour(states[i].state), layer);
  }

  picture->BeginTriangles("cones", 0, kConeColour, kCones);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const DrawnObstacle& obstacle = StageOf(increment).obstacles[contacts_[i].obstacle];
    const std::uint8_t state = states[i].state;
    if (obstacle.friction <= 0.0 || state == msgs::ContactState::OPEN || state == msgs::ContactState::CLOSED) continue;
    const Vector2d& apex = places[contacts_[i].node];
    const Vector2d normal = obstacle.ProjectAt(increment.load_factor, apex).normal;
    const Vector2d side = obstacle.friction * Tangent(normal);
    const double edge = std::min(kConeEdge * detail_, kMostCone * size_);
    picture->AddTriangle(apex, apex + edge * (normal - side).normalized(), apex + edge * (normal + side).normalized());
  }
}

void SceneMarkers::DrawForces(const Places& places, const msgs::Increment& increment, double full_force,
                              MarkerPicture* picture) const {
  const double scale = kFullArrow * size_ / full_force;
  const auto draw = [&](std::size_t node, const Vector2d& force, const ColorRGBA& colour) {
    if (force.norm() > kShortest * full_force) picture->AddArrow(places[node], scale * force, colour);
  };
  picture->BeginTriangles("loads", 0, kLoadColour, kArrows);
  for (const NodalLoad& load : StageOf(increment).loads) {
    draw(load.node, load.Force(increment.load_factor), load.constant ? kConstantLoadColour : kLoadColour);
  }
  picture->BeginTriangles("reactions", 0, kReactionColour, kArrows);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const DrawnObstacle& obstacle = StageOf(increment).obstacles[contacts_[i].obstacle];
    const Vector2d normal = obstacle.ProjectAt(increment.load_factor, places[contacts_[i].node]).normal;
    draw(contacts_[i].node, increment.contacts[i].rn * normal + increment.contacts[i].rt * Tangent(normal),
         kReactionColour);
  }
}

// Above the initial shape.
void SceneMarkers::DrawCaption(const std::string& caption, double full_force, MarkerPicture* picture) const {
  const double height = kTextHeight * size_;
  const Vector2d above(box_.center().x(), box_.max().y() + 0.2 * size_);
  const double length = kFullArrow * size_;
  std::ostringstream force;
  force.imbue(std::locale::classic());
  force << std::setprecision(3) << full_force;
  picture->AddText("caption", 0, above + Vector2d(0.0, 2.0 * height), height, kTextColour, caption);
  picture->BeginTriangles("caption", 1, kTextColour, kText);
  picture->AddArrow(above - Vector2d(length, 0.0), Vector2d(length, 0.0), kTextColour);
  picture->AddText("caption", 2, above + Vector2d(0.5 * length, 0.0), height, kTextColour, force.str());
}

}  // namespace contact_path
