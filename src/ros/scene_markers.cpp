#include "contact_path/ros/scene_markers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <locale>
#include <sstream>
#include <stdexcept>

#include "contact_path/geometry/outline.h"
#include "ros/drawn_scene.h"
#include "ros/marker_picture.h"
#include "ros/marker_style.h"

namespace contact_path {
namespace {

namespace msgs = contact_path_msgs;
using Eigen::Vector2d;
using std_msgs::ColorRGBA;
using visualization_msgs::Marker;

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
const ColorRGBA kSupportReactionColour = Colour(0.46F, 0.16F, 0.51F);
const ColorRGBA kUnstableColour = Colour(0.55F, 0.34F, 0.29F);
const ColorRGBA kConeColour = Colour(0.70F, 0.09F, 0.17F, 0.45F);
const ColorRGBA kSurfaceColour = Colour(0.11F, 0.47F, 0.22F);
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
    case msgs::Increment::SAMPLE: return ", wanted value";
    case msgs::Increment::ONSET: return ", onset of instability";
    case msgs::Increment::JUMP: return ", landing of a jump";
    default: return "";
  }
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

// The boundary of an obstacle around the foot of `centre`, along the tangent: up to its ends, or once round.
// half_length [length].
std::vector<OutlinePoint> BoundaryOf(const DrawnObstacle& obstacle, double load_factor, const Vector2d& centre,
                                     double half_length) {
  const Surface& surface = *obstacle.surface;
  const Vector2d seen = obstacle.Seen(load_factor, centre);
  const int patch = surface.Nearest(seen).patch;
  double middle = surface.Project(seen, patch).xi;
  if (!std::isfinite(middle)) middle = surface.RangeOf(patch).begin;  // the centre of a circle
  const XiRange whole = surface.Range();
  if (surface.Closed()) half_length = std::min(half_length, 0.5 * (whole.end - whole.begin));
  std::vector<OutlinePoint> points =
      Outline(surface, {middle - half_length, middle + half_length}, {kStyle.patch_steps});
  for (OutlinePoint& point : points) {
    point.place = obstacle.Placed(load_factor, point.place);
    point.normal = obstacle.Rotation(load_factor) * point.normal;
  }
  return points;
}

void DrawObstacles(const DrawnScene& scene, const DrawnStage& stage, const NodePlaces& places,
                   const msgs::Increment& increment, MarkerPicture* picture) {
  // Long enough for the nodes, and of a length that hardly ever changes.
  const Vector2d centre = scene.box.center();
  double reach = 0.0;
  for (const Vector2d& place : places) reach = std::max(reach, (place - centre).norm());
  const double half_length = scene.size * std::ceil(reach / scene.size + 0.25);
  const std::vector<DrawnObstacle>& obstacles = stage.obstacles;
  std::vector<std::vector<OutlinePoint>> boundaries;
  boundaries.reserve(obstacles.size());
  for (const DrawnObstacle& obstacle : obstacles)
    boundaries.push_back(BoundaryOf(obstacle, increment.load_factor, centre, half_length));
  const double depth = kStyle.strip_depth * scene.size;

  picture->BeginTriangles("obstacles", 0, kGround, kStrips);
  for (const std::vector<OutlinePoint>& boundary : boundaries) {
    for (std::size_t k = 1; k < boundary.size(); ++k) {
      const OutlinePoint &from = boundary[k - 1], &to = boundary[k];
      picture->AddTriangle(from.place, from.place - depth * from.normal, to.place - depth * to.normal);
      picture->AddTriangle(from.place, to.place - depth * to.normal, to.place);
    }
  }
  picture->BeginLines("obstacles", 1, kStyle.bar_width * scene.detail, kGroundLine, kBoundaries);
  for (const std::vector<OutlinePoint>& boundary : boundaries)
    for (std::size_t k = 1; k < boundary.size(); ++k) picture->AddLine(boundary[k - 1].place, boundary[k].place);
  picture->BeginLines("obstacles", 2, kStyle.thin_width * scene.detail, kGroundLine, kBoundaries);
  const double distance = std::max(2.0 * depth, 2.0 * half_length / kStyle.most_strokes);
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    if (!obstacles[i].moves) continue;
    // At multiples of the distance from the point that moves.
    const bool flat = obstacles[i].surface->Flat();
    const double xi_of_point = flat ? obstacles[i].surface->ProjectOnNearest(obstacles[i].point).xi : 0.0;
    for (std::size_t k = 1; k < boundaries[i].size(); ++k) {
      const OutlinePoint &from = boundaries[i][k - 1], &to = boundaries[i][k];
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

void DrawStructure(const DrawnScene& scene, const NodePlaces& places, const std::vector<double>& rotations,
                   MarkerPicture* picture) {
  const std::size_t steps = std::clamp(kStyle.most_lines / std::max<std::size_t>(scene.segments.size(), 1),
                                       kStyle.fewest_steps, kStyle.most_steps);
  const auto draw_lines = [&](const NodePlaces& at, const std::vector<double>& turned) {
    for (const auto& [a, b] : scene.bars) picture->AddLine(at[a], at[b]);
    for (const DrawnSegment& segment : scene.segments) {
      const auto [a, b] = segment.nodes;
      const NodePlaces curve = CurveOf(segment, {{at[a], at[b]}, {turned[a], turned[b]}}, static_cast<int>(steps));
      for (std::size_t i = 1; i < curve.size(); ++i) picture->AddLine(curve[i - 1], curve[i]);
    }
  };
  const auto draw_nodes = [&](const NodePlaces& at) {
    for (std::size_t i = 0; i < at.size(); ++i)
      if (!scene.inner[i]) picture->AddPoint(at[i]);
  };
  picture->BeginLines("initial", 0, kStyle.thin_width * scene.detail, kInitialColour, kInitial);
  draw_lines(scene.initial, std::vector<double>(scene.initial.size(), 0.0));
  picture->BeginDots("initial", 1, Marker::SPHERE_LIST, 0.6 * scene.detail, kInitialColour, kInitial);
  draw_nodes(scene.initial);

  picture->BeginLines("structure", 0, kStyle.bar_width * scene.detail, kBarColour, kBars);
  draw_lines(places, rotations);
  picture->BeginDots("structure", 1, Marker::SPHERE_LIST, scene.detail, kBarColour, kNodes);
  draw_nodes(places);
}

void DrawStars(const DrawnScene& scene, const NodePlaces& places, MarkerPicture* picture) {
  NodePlaces middles;
  for (std::size_t i = 0; i < scene.stars.size(); ++i)
    middles.push_back(scene.stars[i].size() == 1 ? scene.rest[i] : MiddleOf(scene.stars[i], places));
  picture->BeginLines("superelements", 0, kStyle.bar_width * scene.detail, kSpringColour, kSprings);
  for (std::size_t i = 0; i < scene.stars.size(); ++i) {
    for (const std::size_t node : scene.stars[i]) picture->AddLine(places[node], middles[i]);
  }
  picture->BeginDots("superelements", 1, Marker::CUBE_LIST, scene.detail, kSpringColour, kSprings);
  for (const Vector2d& middle : middles) picture->AddPoint(middle);
}

void DrawMeshes(const DrawnScene& scene, const NodePlaces& places, MarkerPicture* picture) {
  const auto draw_boundaries = [&](const NodePlaces& at) {
    for (const DrawnCell& cell : scene.cells)
      for (std::size_t i = 0; i < cell.boundary.size(); ++i)
        picture->AddLine(at[cell.boundary[i]], at[cell.boundary[(i + 1) % cell.boundary.size()]]);
  };
  picture->BeginLines("solids", 0, kStyle.thin_width * scene.detail, kInitialColour, kInitial);
  draw_boundaries(scene.initial);
  picture->BeginTriangles("solids", 1, SolidColour(0.0), kSprings);
  for (const DrawnCell& cell : scene.cells) {
    Eigen::VectorXd x(static_cast<Eigen::Index>(2 * cell.nodes.size()));
    for (std::size_t i = 0; i < cell.nodes.size(); ++i)
      x.segment<2>(static_cast<Eigen::Index>(2 * i)) = places[cell.nodes[i]];
    const ColorRGBA colour = SolidColour(cell.element->Energy(x) / cell.full_energy);
    const Vector2d middle = MiddleOf(cell.nodes, places);
    for (std::size_t i = 0; i < cell.boundary.size(); ++i)
      picture->AddTriangle(middle, places[cell.boundary[i]], places[cell.boundary[(i + 1) % cell.boundary.size()]],
                           colour);
  }
  picture->BeginLines("solids", 2, kStyle.thin_width * scene.detail, kBarColour, kBars);
  draw_boundaries(places);
}

void DrawSupports(const DrawnScene& scene, const NodePlaces& places, MarkerPicture* picture) {
  const double height = kStyle.support_height * scene.detail;
  picture->BeginTriangles("supports", 0, kSupportColour, kSprings);
  for (const DrawnSupport& support : scene.supports) {
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

void DrawSurfaces(const DrawnScene& scene, const NodePlaces& places, MarkerPicture* picture) {
  picture->BeginLines("surfaces", 0, kStyle.thin_width * scene.detail, kSurfaceColour, kBars);
  for (const DrawnSurface& surface : scene.surfaces) {
    const std::vector<OutlinePoint> points = surface.At(places).Points(kStyle.surface_steps);
    for (std::size_t k = 1; k < points.size(); ++k) picture->AddLine(points[k - 1].place, points[k].place);
  }
}

// Of each contact where it is nearest to its obstacle or surface.
std::vector<Vector2d> NormalsOf(const DrawnScene& scene, const DrawnStage& stage, const NodePlaces& places,
                                double load_factor) {
  std::vector<BoundaryCurve> curves;
  for (const DrawnSurface& surface : scene.surfaces) curves.push_back(surface.At(places));
  std::vector<Vector2d> normals;
  for (const DrawnCandidate& contact : scene.contacts) {
    const Vector2d& place = places[contact.node];
    normals.push_back(contact.on_surface ? curves[contact.partner].Nearest(place, *contact.patches).normal
                                         : stage.obstacles[contact.partner].ProjectAt(load_factor, place).normal);
  }
  return normals;
}

void DrawContacts(const DrawnScene& scene, const NodePlaces& places, const std::vector<Vector2d>& normals,
                  const msgs::Increment& increment, MarkerPicture* picture) {
  const std::vector<msgs::ContactState>& states = increment.contacts;
  picture->BeginDots("contacts", 0, Marker::SPHERE_LIST, kStyle.contact_diameter * scene.detail, StateColour(0),
                     kCandidates);
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    // A node in a corner has several candidates: seen is one that touches.
    const Layer layer = states[i].state == msgs::ContactState::OPEN ? kCandidates : kTouching;
    picture->AddPoint(places[scene.contacts[i].node], StateColour(states[i].state), layer);
  }

  picture->BeginTriangles("cones", 0, kConeColour, kCones);
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const double friction = scene.contacts[i].friction;
    const std::uint8_t state = states[i].state;
    if (friction <= 0.0 || state == msgs::ContactState::OPEN || state == msgs::ContactState::CLOSED) continue;
    const Vector2d& apex = places[scene.contacts[i].node];
    const Vector2d &normal = normals[i], side = friction * Tangent(normal);
    const double edge = std::min(kStyle.cone_edge * scene.detail, kStyle.most_cone * scene.size);
    picture->AddTriangle(apex, apex + edge * (normal - side).normalized(), apex + edge * (normal + side).normalized());
  }
}

void DrawForces(const DrawnScene& scene, const DrawnStage& stage, const NodePlaces& places,
                const std::vector<Vector2d>& normals, const msgs::Increment& increment, double full_force,
                MarkerPicture* picture) {
  const double scale = kStyle.full_arrow * scene.size / full_force;
  const auto draw = [&](std::size_t node, const Vector2d& force, const ColorRGBA& colour) {
    if (force.norm() > kStyle.shortest * full_force) picture->AddArrow(places[node], scale * force, colour);
  };
  const auto draw_moment = [&](std::size_t node, double moment, const ColorRGBA& colour) {
    const double part = moment / (full_force * scene.size);
    if (std::abs(part) > kStyle.shortest)
      picture->AddTurnedArrow(places[node], kStyle.moment_radius * scene.size, kStyle.full_turn * part, colour);
  };
  picture->BeginTriangles("loads", 0, kLoadColour, kArrows);
  for (const DrawnLoad& load : stage.loads) {
    const ColorRGBA& colour = load.constant ? kConstantLoadColour : kLoadColour;
    const double share = load.Share(increment.load_factor);
    draw(load.node, share * load.force, colour);
    draw_moment(load.node, share * load.moment, colour);
  }
  picture->BeginTriangles("reactions", 0, kReactionColour, kArrows);
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    draw(scene.contacts[i].node, increment.contacts[i].rn * normals[i] + increment.contacts[i].rt * Tangent(normals[i]),
         kReactionColour);
  picture->BeginTriangles("support_reactions", 0, kSupportReactionColour, kArrows);
  for (std::size_t i = 0; i < increment.supports.size(); ++i) {
    const msgs::Resultant& reaction = increment.supports[i];
    draw(scene.reacting[i].node, {reaction.rx, reaction.ry}, kSupportReactionColour);
    draw_moment(scene.reacting[i].node, reaction.rm, kSupportReactionColour);
  }
}

// Half as long as the arrow of the full force where the direction has its largest motion.
void DrawUnstableDirection(const DrawnScene& scene, const NodePlaces& places, const msgs::Increment& increment,
                           MarkerPicture* picture) {
  picture->BeginTriangles("unstable_direction", 0, kUnstableColour, kArrows);
  const std::vector<double>& direction = increment.unstable_direction;
  if (direction.size() != 2 * places.size()) return;
  const auto of = [&](std::size_t node) { return Vector2d(direction[2 * node], direction[2 * node + 1]); };
  double largest = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) largest = std::max(largest, of(i).norm());
  for (std::size_t i = 0; i < places.size(); ++i)
    if (of(i).norm() > kStyle.shortest * largest)
      picture->AddArrow(places[i], 0.5 * kStyle.full_arrow * scene.size / largest * of(i), kUnstableColour);
}

// Above the initial shape.
void DrawCaption(const DrawnScene& scene, const std::string& caption, const DrawnStage& stage, double full_force,
                 MarkerPicture* picture) {
  const double height = kStyle.text_height * scene.size;
  const Vector2d above(scene.box.center().x(), scene.box.max().y() + 0.2 * scene.size);
  const double length = kStyle.full_arrow * scene.size;
  std::ostringstream force;
  force.imbue(std::locale::classic());
  force << std::setprecision(3) << full_force;
  const bool moments =
      std::any_of(stage.loads.begin(), stage.loads.end(), [](const DrawnLoad& load) { return load.moment != 0.0; }) ||
      std::any_of(scene.reacting.begin(), scene.reacting.end(),
                  [](const SupportedNode& node) { return node.rotation; });
  if (moments) force << ", turned by 3/4: " << full_force * scene.size;
  picture->AddText("caption", 0, above + Vector2d(0.0, 2.0 * height), height, kTextColour, caption);
  picture->BeginTriangles("caption", 1, kTextColour, kText);
  picture->AddArrow(above - Vector2d(length, 0.0), Vector2d(length, 0.0), kTextColour);
  const double middle = moments ? 1.75 * length : 0.5 * length;  // of a text that is long or short
  picture->AddText("caption", 2, above + Vector2d(middle, 0.0), height, kTextColour, force.str());
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

SceneMarkers::SceneMarkers(const TraceRequest& request, const MarkerOptions& options)
    : options_(options), scene_(std::make_shared<const DrawnScene>(request)) {}

bool SceneMarkers::Fits(const msgs::Increment& increment) const { return scene_->Fits(increment); }

double SceneMarkers::LargestForce(const msgs::Increment& increment) const { return scene_->LargestForce(increment); }

visualization_msgs::MarkerArray SceneMarkers::Draw(const msgs::Increment& increment, double largest_force) const {
  std::ostringstream caption;
  caption.imbue(std::locale::classic());
  caption << scene_->name << "   ";
  if (scene_->has_program) caption << scene_->StageOf(increment)->title << "   ";
  caption << "increment " << increment.index << KindInWords(increment.kind) << "\nload factor "
          << increment.load_factor;
  return Draw(increment, largest_force, caption.str());
}

visualization_msgs::MarkerArray SceneMarkers::DrawInitial() const {
  const msgs::Increment increment = scene_->Initial();
  return Draw(increment, LargestForce(increment), scene_->name + "   initial shape");
}

visualization_msgs::MarkerArray SceneMarkers::Draw(const msgs::Increment& increment, double largest_force,
                                                   const std::string& caption) const {
  const DrawnScene& scene = *scene_;
  NodePlaces places;
  places.reserve(increment.x.size());
  for (std::size_t i = 0; i < increment.x.size(); ++i) places.emplace_back(increment.x[i], increment.y[i]);
  const double full_force = FullForce(largest_force, scene.least_force);
  const std::shared_ptr<const DrawnStage> stage = scene.StageOf(increment);
  MarkerPicture picture(scene.size, scene.detail);
  DrawObstacles(scene, *stage, places, increment, &picture);
  DrawStructure(scene, places, increment.rotation, &picture);
  DrawStars(scene, places, &picture);
  DrawMeshes(scene, places, &picture);
  DrawSupports(scene, places, &picture);
  DrawSurfaces(scene, places, &picture);
  const std::vector<Vector2d> normals = NormalsOf(scene, *stage, places, increment.load_factor);
  DrawContacts(scene, places, normals, increment, &picture);
  DrawForces(scene, *stage, places, normals, increment, full_force, &picture);
  DrawUnstableDirection(scene, places, increment, &picture);
  DrawCaption(scene, caption, *stage, full_force, &picture);
  if (options_.picture_size == 0.0) return picture.Finish(options_.frame_id, Vector2d::Zero(), 1.0);
  return picture.Finish(options_.frame_id, scene.box.center(), options_.picture_size / scene.size);
}

}  // namespace contact_path
