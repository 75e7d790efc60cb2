// Contact with surfaces that deform: scenes with closed forms, ends of paths, many events.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "support/parts.h"
#include "support/plank.h"
#include "support/solid_grid.h"
#include "support/traced_path.h"

namespace contact_path::deformable_scenes_test {
namespace {

constexpr double kResidual = 1e-13, kOfBeams = 1e-10;  // the largest one of an increment; of stiff beams

// A path of many snaps.
TEST(RingOnRing, HasTheSameEventsWithOtherSteps) {
  TraceRequest request = ReadExample("ring_on_ring");
  request.options.accuracy = Accuracy::kFast;
  const TracedPath path = TraceProved(request, kOfBeams);
  EXPECT_GT(IncrementsOfKind(path, IncrementKind::kCornerLimit).size(), 5u);
  for (const Accuracy accuracy : {Accuracy::kBalanced, Accuracy::kAccurate}) {
    request.options.accuracy = accuracy;
    ExpectSameEvents(path, TraceProved(request, kOfBeams), 1e-8);
  }
}

// A foot on two springs is pressed down and dragged. The ground: a half plane, or fixed nodes in line.
TraceRequest FootOn(bool surface) {
  Scene scene;
  scene.nodes = {{"l", -1.0, 1.0, true, true}, {"r", 1.0, 1.1, true, true}, {"foot", 0.05, 0.0, false, false}};
  scene.bars = {{{"l", "foot"}, 10.0}, {{"r", "foot"}, 8.0}};
  if (surface) {
    for (int i = 0; i < 6; ++i)
      scene.nodes.push_back({"g" + std::to_string(i), -1.0 + 0.45 * i * (1.0 + 0.03 * i), 0.0, true, true});
    for (int i = 0; i < 5; ++i) scene.bars.push_back({{"g" + std::to_string(i), "g" + std::to_string(i + 1)}, 1.0});
    scene.surfaces = {{"ground", {"g0", "g1", "g2", "g3", "g4", "g5"}}};
    scene.contacts = {{"foot", "", "", "ground", 0.3}};
  } else {
    scene.obstacles = {{"ground", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3}};
    scene.contacts = {{"foot", "ground"}};
  }
  return RequestOf(scene, {LoadingStage({{"foot", 0.0, -2.0}}), LoadingStage({{"foot", 7.0, 0.0}})});
}

TEST(FixedSurface, InLineIsAHalfPlane) {
  for (const Method method : kMethods) {
    TraceRequest request = FootOn(true), flat = FootOn(false);
    request.options.method = flat.options.method = method;
    const TracedPath path = TraceIncrements(request), expected = TraceIncrements(flat);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
    const Increment &end = path.increments.back(), &end_expected = expected.increments.back();
    EXPECT_NEAR(PositionX(path, end, "foot"), PositionX(expected, end_expected, "foot"), 1e-12);
    EXPECT_GT(PositionX(path, end, "foot"), 0.3);
    EXPECT_NEAR(Contact(path, end, "foot@ground").rn, Contact(expected, end_expected, "foot@ground").rn, 1e-12);
    EXPECT_NEAR(end.strain_energy, end_expected.strain_energy, 1e-12);
    EXPECT_NEAR(end.dissipation / end_expected.dissipation, 1.0, method == Method::kBranch ? 1e-11 : 2e-4);
    EXPECT_LE(EnergyImbalance(path), method == Method::kBranch ? 1e-8 : 1e-2);
  }
}

TEST(FixedSurface, WithoutFrictionIsTheSameByTheTotalLaw) {
  TraceRequest request = FootOn(true);
  request.scene.contacts[0].friction = 0.0;
  request.program[1].loads[0].fx = 0.5;
  const TracedPath expected = TraceProved(request, kResidual);
  request.options.friction_law = FrictionLaw::kTotal;
  const TracedPath path = TraceProved(request, kResidual);
  EXPECT_EQ(path.increments.back().positions, expected.increments.back().positions);
}

TEST(OnPlank, TheNodeIsCarriedByItsShapeFunctions) {
  const Plank plank;
  const TracedPath path = TraceProved(RequestUntil({"load_factor", ">", 1.0}, plank.MakeScene()), kResidual);
  for (const Increment& increment : path.increments) EXPECT_LE(plank.Error(increment), 1e-12);
  EXPECT_GT(PositionX(path, path.increments.back(), "p"), 0.5);
}

// Blocks of three elements each, whose nodes n<column><row> stand on each other; the upper one is pressed down and
// aside. Candidates: these nodes of the upper block and of the lower one.
TraceRequest MatchingBlocks(const std::vector<std::string>& on_lower, const std::vector<std::string>& on_upper) {
  TraceRequest request;
  Scene& scene = request.scene;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const bool held = j == 0 || j == 3;
      scene.nodes.push_back(
          {"n" + std::to_string(i) + std::to_string(j), 0.5 * i, j < 2 ? 0.5 * j : 0.5 * (j - 1), held, held});
    }
  scene.materials = {ElasticMaterial("rubber", 1.0, 0.3)};
  scene.solids = {SolidOf("rubber")};
  for (const int j : {0, 2})
    for (int i = 0; i < 3; ++i)
      for (const auto& [di, dj] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)})
        scene.solids[0].nodes.push_back("n" + std::to_string(i + di) + std::to_string(j + dj));
  scene.surfaces = {{"lower", {"n01", "n11", "n21", "n31"}}, {"upper", {"n32", "n22", "n12", "n02"}}};
  for (const std::string& node : on_lower) scene.contacts.push_back({node, "", "", "lower", 0.5});
  for (const std::string& node : on_upper) scene.contacts.push_back({node, "", "", "upper", 0.5});
  request.program.resize(1);
  for (int i = 0; i < 4; ++i) request.program[0].support_motions.push_back({"n" + std::to_string(i) + "3", 0.02, -0.1});
  return request;
}

// As candidates of one block or of both. The curve of each block is another one than the line of its nodes, so that
// both of them hold, and the contact is stiffer by 2.3 %. The scene in both passes is its own image, turned by half a
// turn.
TEST(BothPasses, OfMatchingMeshesShareTheReactions) {
  const TracedPath one = TraceProved(MatchingBlocks({"n12", "n22"}, {}), kResidual);
  const TracedPath two = TraceProved(MatchingBlocks({"n12", "n22"}, {"n11", "n21"}), kResidual);
  const double sum = SumOfNormals(one.increments.back());
  EXPECT_GT(sum, 0.02);
  EXPECT_NEAR(SumOfNormals(two.increments.back()) / sum, 1.0231, 1e-4);
  for (const Increment& increment : two.increments) {
    const auto rn = [&](const char* contact) { return Contact(two, increment, contact).rn; };
    EXPECT_NEAR(rn("n12@lower"), rn("n21@upper"), 1e-13);
    EXPECT_NEAR(rn("n22@lower"), rn("n11@upper"), 1e-13);
  }
}

// The outer nodes stand on the ends of the surface, and stay there. Each scene is the image of the other one, turned by
// half a turn, so that rounding is another one.
TEST(EndsOfASurface, BearNodesThatStandOnThem) {
  const TracedPath path = TraceProved(MatchingBlocks({"n02", "n12", "n22", "n32"}, {}), kResidual);
  const TracedPath image = TraceProved(MatchingBlocks({}, {"n01", "n11", "n21", "n31"}), kResidual);
  const Increment &end = path.increments.back(), &end_of_image = image.increments.back();
  for (int i = 0; i < 4; ++i) {
    const std::string contact = "n" + std::to_string(i) + "2@lower", turned = "n" + std::to_string(3 - i) + "1@upper";
    const ContactRecord &at = Contact(path, end, contact), &at_image = Contact(image, end_of_image, turned);
    EXPECT_EQ(at.state, ContactState::kStick);
    EXPECT_GT(at.rn, 0.02);
    EXPECT_NEAR(at.rn, at_image.rn, 1e-13);
    EXPECT_NEAR(at.rt, at_image.rt, 1e-13);
  }
}

// The foot of FootOn() slides over the end of the ground.
TEST(FixedSurface, EndsWhereTheNodeIsLost) {
  TraceRequest request = FootOn(true);
  request.scene.surfaces[0].nodes.resize(4);  // up to x = 0.47
  request.program[1].loads[0].fx = 12.0;
  const TracedPath path = TraceIncrements(request);
  ExpectEnd(path, EndReason::kPathEnd, "foot@ground is lost");
  EXPECT_NEAR(PositionX(path, path.increments.back(), "foot"), -1.0 + 1.35 * 1.09, 1e-9);
}

// The foot is behind the ground, so deep below its level, and is drawn on.
TraceRequest FootBehind(double deep) {
  TraceRequest request = FootOn(true);
  request.scene.nodes[2] = {"foot", -1.2, -deep};
  request.scene.loads = {{"foot", 4.0, 0.0}};
  request.program = {};
  return request;
}

// From below the level of the ground, past its first node, to behind it.
TEST(FixedSurface, NamesANodeThatComesBehindItPastAnEnd) {
  const TracedPath path = TraceIncrements(FootBehind(0.1));
  ExpectEnd(path, EndReason::kNumericalFailure, "foot@ground: the node has come past an end of the surface");
  EXPECT_NEAR(PositionX(path, path.increments.back(), "foot"), -1.0, 0.1);
}

// The same node deeper than an edge of the ground is long.
TEST(FixedSurface, IsNotThereForANodeFarBehindIt) {
  TraceRequest request = FootBehind(0.8);
  request.options.stop = {{"foot.x", ">", -0.9}};
  const TracedPath path = TraceProved(request, kResidual);
  EXPECT_GT(Contact(path, path.increments.back(), "foot@ground").gap, 0.7);
}

// A block of elements 0.2 wide and 1 high, with the surface on top, and a node beside it at half of its height.
TraceRequest NodeBesideBlock(bool of_bars) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"l", -1.0, 0.5, true, true}, {"u", -0.3, 2.0, true, true}, {"foot", -0.3, 0.5, false, false}};
  scene.bars = {{{"l", "foot"}, 1.0}, {{"u", "foot"}, 1.0}};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 2; ++j)
      scene.nodes.push_back({"b" + std::to_string(i) + std::to_string(j), 0.2 * i, 1.0 * j, true, true});
  scene.surfaces = {{"top", {"b01", "b11", "b21", "b31", "b41", "b51"}}};
  scene.contacts = {{"foot", "", "", "top"}};
  scene.loads = {{"foot", 1.0, 0.0}};
  request.options.stop = {{"foot.x", ">", 0.1}};
  if (of_bars) {
    for (int i = 0; i < 5; ++i)
      scene.bars.push_back({{"b" + std::to_string(i) + "1", "b" + std::to_string(i + 1) + "1"}, 1.0});
    return request;
  }
  scene.materials = {ElasticMaterial("stone", 1.0, 0.0)};
  scene.solids = {SolidOf("stone")};
  for (int i = 0; i < 5; ++i)
    for (const auto& [di, j] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)})
      scene.solids[0].nodes.push_back("b" + std::to_string(i + di) + std::to_string(j));
  return request;
}

TEST(FixedSurface, IsThereAsDeepAsItsSolidReaches) {
  const TracedPath past = TraceProved(NodeBesideBlock(true), kResidual), in = TraceIncrements(NodeBesideBlock(false));
  ExpectEnd(in, EndReason::kNumericalFailure, "foot@top: the node has come past an end of the surface");
}

// Two cantilevers hook onto each other: each force was measured with the upper nodes alone as candidates.
TEST(BothPasses, OfHookedCantileversGoRoundTheirFreeEnds) {
  TraceRequest request = ReadData("hooked_both_passes");
  const TracedPath both = TraceProved(request, kOfBeams);
  request.scene.contacts.resize(1);
  const TracedPath one = TraceProved(request, kOfBeams);
  const Increment &end = both.increments.back(), &end_of_one = one.increments.back();
  EXPECT_NEAR(end.load_factor / end_of_one.load_factor, 1.0, 0.02);
}

// A block with nodes that are pressed onto it from above, whole, or the half of it on the right of its axis.
TraceRequest PressedBlock(bool half) {
  constexpr int kEdges = 3;  // on each side of the axis
  TraceRequest request;
  Scene& scene = request.scene;
  const auto name = [](const char* of, int i) { return of + std::to_string(i + kEdges); };
  const int from = half ? 0 : -kEdges;
  for (int i = from; i <= kEdges; ++i) {
    const bool on_axis = half && i == 0;
    scene.nodes.push_back({name("low", i), 1.0 * i, 0.0, true, true});
    scene.nodes.push_back({name("top", i), 1.0 * i, 1.0 - 0.01 * i * i, on_axis, false});
  }
  scene.surfaces = {{"top", {}}};
  for (int i = from; i <= kEdges; ++i) scene.surfaces[0].nodes.push_back(name("top", i));
  scene.materials = {ElasticMaterial("rubber", 1.0, 0.3)};
  scene.solids = {SolidOf("rubber")};
  for (int i = from; i < kEdges; ++i)
    for (const std::string& node : {name("low", i), name("low", i + 1), name("top", i + 1), name("top", i)})
      scene.solids[0].nodes.push_back(node);
  request.program.resize(1);
  for (int i = half ? 0 : -1; i <= 1; ++i) {
    scene.nodes.push_back({name("held", i), 0.4 * i, 2.0, true, true});
    scene.nodes.push_back({name("p", i), 0.4 * i, 1.05, true, false});
    scene.bars.push_back({{name("held", i), name("p", i)}, half && i == 0 ? 0.5 : 1.0});
    scene.contacts.push_back({name("p", i), "", "", "top"});
    request.program[0].support_motions.push_back({name("held", i), 0.0, -0.3});
  }
  return request;
}

// Of the surface that ends on the axis, half the reaction of the node over the axis, and the whole of the other one.
TEST(SymmetricSurface, BearsAsTheWholeOne) {
  const TracedPath whole = TraceProved(PressedBlock(false), kResidual);
  const TracedPath half = TraceProved(PressedBlock(true), kResidual);
  const Increment &end = whole.increments.back(), &end_of_half = half.increments.back();
  EXPECT_GT(Contact(whole, end, "p3@top").rn, 0.01);
  EXPECT_NEAR(2.0 * Contact(half, end_of_half, "p3@top").rn, Contact(whole, end, "p3@top").rn, 1e-12);
  EXPECT_NEAR(Contact(half, end_of_half, "p4@top").rn, Contact(whole, end, "p4@top").rn, 1e-12);
  EXPECT_NEAR(PositionX(half, end_of_half, "top4"), PositionX(whole, end, "top4"), 1e-12);
}

// A block of `columns` elements pressed flush on a wider one, of twice as long elements: every second node stands where
// edges of the surface meet. aside: of the upper block.
TraceRequest FlushBlocks(int columns, double aside) {
  Scene scene;
  scene.materials = {ElasticMaterial("rubber", 1.0, 0.3, MaterialModel::kLinear)};
  BoundarySurface top{"top", {}}, table{"table", {}};
  Group pressed{"pressed", {}};
  const auto add = [&](const std::string& name, int count, double width, double low, double middle, bool on_ground) {
    Solid block = SolidOf("rubber");
    const auto node = [&](int i, int row) { return name + std::to_string(i) + (row == 0 ? "_low" : "_high"); };
    for (const int row : {0, 1})
      for (int i = 0; i <= count; ++i) {
        const bool fixed = on_ground && row == 0;
        scene.nodes.push_back({node(i, row), middle - 0.5 * width + width * i / count, low + row,
                               fixed || (!on_ground && 2 * i == count), fixed});
      }
    for (int i = 0; i < count; ++i)
      for (const auto& [k, row] : {std::pair(i, 0), std::pair(i + 1, 0), std::pair(i + 1, 1), std::pair(i, 1)})
        block.nodes.push_back(node(k, row));
    for (int i = 0; i <= count; ++i) {
      (on_ground ? table : top).nodes.push_back(node(i, 1));
      if (!on_ground) pressed.nodes.push_back(node(i, 0));
    }
    scene.solids.push_back(block);
  };
  add("u", columns, 2.0, 0.0, aside, false);
  add("b", columns, 4.0, -1.0, 0.0, true);
  scene.surfaces = {top, table};
  scene.groups = {pressed};
  scene.loads.resize(1);
  scene.loads[0].surface = "top";
  scene.loads[0].py = -1.0;
  scene.contacts = {{"", "", "pressed", "table"}};
  return RequestUntil({"load_factor", ">", 0.01}, scene);
}

// Whether nodes stand where edges meet or beside, the block is borne, and by hardly other reactions.
TEST(FlushBlocks, AreBorneWhereverNodesStand) {
  for (const int columns : {6, 8, 12, 16, 20}) {
    SCOPED_TRACE(columns);
    const TracedPath path = TraceProved(FlushBlocks(columns, 0.0)), beside = TraceProved(FlushBlocks(columns, 1e-3));
    EXPECT_NEAR(SumOfNormals(path.increments.back()), 0.02, 5e-6);
    const Increment &end = path.increments.back(), &other = beside.increments.back();
    ASSERT_EQ(end.contacts.size(), other.contacts.size());
    for (std::size_t i = 0; i < end.contacts.size(); ++i)
      EXPECT_NEAR(end.contacts[i].rn, other.contacts[i].rn, 2e-3 * end.contacts[0].rn) << i;
  }
}

// A block of steel stands on rubber. Rounding of the places of its nodes stresses it by more than the load: it is at
// rest.
TEST(FlushBlocks, OfSteelOnRubberAreAtRestWhereverTheyStand) {
  for (const double aside : {0.0, 0.0123, 0.1, 0.07})
    for (const double stiffness : {1e3, 1e5}) {
      SCOPED_TRACE(testing::Message() << "aside " << aside << ", stiffness " << stiffness);
      TraceRequest request = FlushBlocks(4, aside);
      request.scene.materials.push_back(ElasticMaterial("steel", stiffness, 0.3, MaterialModel::kLinear));
      request.scene.solids[0].material = "steel";
      request.scene.contacts[0].friction = 0.3;
      const TracedPath path = TraceProved(request);
      EXPECT_NEAR(SumOfNormals(path.increments.back()), 0.02, 5e-6);
    }
}

}  // namespace
}  // namespace contact_path::deformable_scenes_test
