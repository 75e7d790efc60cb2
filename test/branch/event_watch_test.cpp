#include "contact_path/branch/event_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "branch/example_scenes.h"
#include "branch/model_point.h"
#include "contact_path/branch/ways.h"
#include "contact_path/path/model.h"
#include "support/reference_cases.h"
#include "support/traced_path.h"

namespace contact_path {
namespace {

// A piece of the path of a scene, from one of its rows on, with the states of the row after it.
class Piece {
 public:
  Piece(const TracedPath& path, std::size_t row)
      : model_(path.request.scene, CharacteristicScales(path.request.scene)),
        piece_(model_.structure, model_.contacts) {
    const PathPoint from = PointOf(model_, path.rows.at(row)), to = PointOf(model_, path.rows.at(row + 1));
    piece_.SetStates(to.states, from);
    const Eigen::VectorXd start = piece_.system().Pack(from);
    EXPECT_TRUE(piece_.Derivatives(start, (piece_.system().Pack(to) - start).head(piece_.NumMotion()), &start_));
  }

  // From the point at distance t0 to that at t1, both along the tangent at the row.
  Segment Between(double t0, double t1) {
    const CurvePoint start = At(t0);
    return MakeSegment(start, At(t1), piece_.NumMotion());
  }
  CurvePoint At(double t) {
    CurvePoint point;
    if (t == 0.0) return start_;
    const Eigen::VectorXd normal = start_.first.head(piece_.NumMotion());
    // In short steps: the curve may bend.
    Eigen::VectorXd x = start_.x;
    const int steps = 1 + static_cast<int>(std::abs(t) / 0.01);
    for (int i = 0; i < steps; ++i) x = piece_.CorrectOnPlane(x + t / steps * start_.first, normal).x;
    EXPECT_TRUE(piece_.Derivatives(x, normal, &point));
    return point;
  }

  SmoothPiece& piece() { return piece_; }
  const Model& model() const { return model_; }
  double Load(const CurvePoint& point) const { return point.x[piece_.NumMotion() - 1] * model_.scaling.load_factor; }

 private:
  Model model_;
  SmoothPiece piece_;
  CurvePoint start_;
};

TracedPath Trace(const Scene& scene, int rows) {
  TraceRequest request;
  request.scene = scene;
  request.options.max_increments = rows;
  return TraceRows(request);
}

std::size_t FirstRow(const TracedPath& path, RowKind kind, std::size_t from = 1) {
  while (path.rows.at(from).kind != kind) ++from;
  return from;
}

TEST(Watch, NothingHappens) {
  Piece piece(Trace(ReadExample("rigid_stop").scene, 3), 0);
  const Segment segment = piece.Between(0.0, 0.1);
  const Watched watched = Watch(&piece.piece(), segment);
  EXPECT_EQ(watched.happening, Happening::kNone);
  EXPECT_EQ(watched.t, segment.length);
  const std::optional<CurvePoint> located = Locate(&piece.piece(), segment, watched);
  ASSERT_TRUE(located);
  EXPECT_EQ(located->x, segment.end.x);
}

// The scene is its own scaled scene, and u and s move by the same: the gap 0.1 is closed at sqrt(2) 0.1.
TEST(Watch, AGapCloses) {
  Piece piece(Trace(ReadExample("rigid_stop").scene, 3), 0);
  for (const double length : {0.15, 1.0, 10.0}) {
    const Segment segment = piece.Between(0.0, length);
    const Watched watched = Watch(&piece.piece(), segment);
    ASSERT_EQ(watched.happening, Happening::kEvent);
    EXPECT_EQ(watched.limit.contact, 0);
    EXPECT_EQ(watched.limit.inequality, Inequality::kGap);
    EXPECT_NEAR(watched.t, 0.1 * std::sqrt(2.0), 1e-14);
    const std::optional<CurvePoint> located = Locate(&piece.piece(), segment, watched);
    ASSERT_TRUE(located);
    EXPECT_NEAR(located->x[0], 1.1, 1e-15);
    EXPECT_NEAR(piece.Load(*located), 0.1, 1e-15);
    EXPECT_FALSE(watched.singular);
  }
  // Just before, and just at the end of the segment.
  EXPECT_EQ(Watch(&piece.piece(), piece.Between(0.0, 0.14)).happening, Happening::kNone);
  EXPECT_EQ(Watch(&piece.piece(), piece.Between(0.0, 0.1415)).happening, Happening::kEvent);
}

TEST(Watch, TheConeIsReached) {
  const TracedPath path = Trace(ReadExample("rough_truss").scene, 60);
  Piece piece(path, 1);
  // t = 0 is row 1; the corner limit point is where the slope of the bars is 1 / mu.
  const std::size_t corner = FirstRow(path, RowKind::kCornerLimit);
  const Segment segment = piece.Between(0.0, 0.3);
  const Watched watched = Watch(&piece.piece(), segment);
  ASSERT_EQ(watched.happening, Happening::kEvent);
  EXPECT_EQ(watched.limit.inequality, Inequality::kConePlus);
  const std::optional<CurvePoint> located = Locate(&piece.piece(), segment, watched);
  ASSERT_TRUE(located);
  EXPECT_NEAR(piece.Load(*located), rough_truss::CornerLoad(), 1e-14);
  EXPECT_NEAR(piece.Load(*located), path.rows[corner].load_factor, 1e-14);
}

TEST(Watch, TheReactionVanishes) {
  const TracedPath path = Trace(ReadExample("two_dof_friction").scene, 100);
  Piece piece(path, FirstRow(path, RowKind::kCornerLimit));  // slip starts
  const Segment segment = piece.Between(0.0, 3.0);
  const Watched watched = Watch(&piece.piece(), segment);
  ASSERT_EQ(watched.happening, Happening::kEvent);
  EXPECT_EQ(watched.limit.inequality, Inequality::kNormalReaction);
  const std::optional<CurvePoint> located = Locate(&piece.piece(), segment, watched);
  ASSERT_TRUE(located);
  EXPECT_NEAR(piece.Load(*located), 2.0 / 3.0, 1e-14);
}

// The block comes to rest where the rate of slip is zero: the end of its path.
TEST(Watch, SlipStops) {
  const TracedPath path = Trace(snap_block::MakeScene(), 300);
  const std::size_t last = path.rows.size() - 1;
  Piece piece(path, last - 2);
  const Segment segment = piece.Between(0.0, 0.03);
  const Watched watched = Watch(&piece.piece(), segment);
  ASSERT_EQ(watched.happening, Happening::kEvent);
  EXPECT_EQ(watched.limit.inequality, Inequality::kSlip);
  const std::optional<CurvePoint> located = Locate(&piece.piece(), segment, watched);
  ASSERT_TRUE(located);
  EXPECT_NEAR(piece.piece().system().Rate(watched.limit, located->first), 0.0, 1e-12);
  EXPECT_NEAR(located->x[0] * piece.model().scaling.length, snap_block::kEndX, 1e-14);
}

TEST(Watch, LimitPoints) {
  const TracedPath path = Trace(ReadExample("von_mises").scene, 100);
  const std::size_t limit = FirstRow(path, RowKind::kSmoothLimit);
  for (const std::size_t before : {1U, 3U, 8U}) {
    Piece piece(path, limit - before);
    const Segment segment = piece.Between(0.0, 0.02 * static_cast<double>(before) + 0.01);
    const Watched watched = Watch(&piece.piece(), segment);
    ASSERT_EQ(watched.happening, Happening::kLimitPoint);
    const std::optional<CurvePoint> located = Locate(&piece.piece(), segment, watched);
    ASSERT_TRUE(located);
    EXPECT_NEAR(located->first[piece.piece().NumMotion() - 1], 0.0, 1e-12);
    EXPECT_NEAR(piece.Load(*located), von_mises::BiotLimit(1.0, 1.0), 1e-14);
  }
}

TEST(Watch, Bifurcations) {
  const TracedPath path = Trace(tall_truss::MakeScene(), 40);
  Piece piece(path, FirstRow(path, RowKind::kBifurcation) - 1);
  const Segment segment = piece.Between(0.0, 0.02);
  const Watched watched = Watch(&piece.piece(), segment);
  ASSERT_EQ(watched.happening, Happening::kBifurcation);
  EXPECT_TRUE(watched.singular);
  const std::optional<CurvePoint> located = Locate(&piece.piece(), segment, watched);
  ASSERT_TRUE(located);
  EXPECT_EQ(located->determinant_sign, 0);
  EXPECT_NEAR(located->x[1] * piece.model().scaling.length, tall_truss::BifurcationY(), 1e-9);
}

// Of several happenings on a segment the first is reported, whatever its kind.
TEST(Watch, TheFirstOfSeveral) {
  Scene scene = ReadExample("von_mises").scene;
  const double limit_y = 0.50983;  // of the apex, at the limit point, rounded
  scene.obstacles = {{"low", ObstacleShape::kHalfPlane, 0.0, limit_y - 0.01, 0.0, 1.0, 0.0},
                     {"lower", ObstacleShape::kHalfPlane, 0.0, limit_y - 0.02, 0.0, 1.0, 0.0}};
  scene.contacts = {{"apex", "lower"}, {"apex", "low"}};
  const TracedPath path = Trace(scene, 100);
  Piece piece(path, FirstRow(path, RowKind::kSmoothLimit) - 2);
  EXPECT_EQ(Watch(&piece.piece(), piece.Between(0.0, 0.1)).happening, Happening::kLimitPoint);
  Piece beyond(path, FirstRow(path, RowKind::kSmoothLimit));
  const Segment segment = beyond.Between(0.0, 0.1);
  const Watched watched = Watch(&beyond.piece(), segment);
  ASSERT_EQ(watched.happening, Happening::kEvent);
  EXPECT_EQ(watched.limit.contact, 1);  // "low", the higher of the two
  const std::optional<CurvePoint> located = Locate(&beyond.piece(), segment, watched);
  ASSERT_TRUE(located);
  EXPECT_NEAR(located->x[1] * beyond.model().scaling.length, limit_y - 0.01, 1e-15);
}

// A start at the limit is no event while it is left to the admissible side; towards the other it is one at t = 0.
TEST(Watch, AStartAtTheLimit) {
  Scene scene = ReadExample("rigid_stop").scene;
  scene.obstacles[0].px = 1.0;
  TraceRequest request;
  request.scene = scene;
  request.options.max_increments = 2;
  request.options.direction = -1.0;
  Piece piece(TraceRows(request), 0);
  EXPECT_EQ(Watch(&piece.piece(), piece.Between(0.0, 0.1)).happening, Happening::kNone);
  const Segment towards = piece.Between(0.1, 0.1 - 1e-12);
  const CurvePoint start = piece.At(0.0);
  CurvePoint back;
  ASSERT_TRUE(piece.piece().Derivatives(start.x, -start.first.head(2), &back));
  CurvePoint end;
  const Eigen::VectorXd x = start.x - 0.1 * start.first;
  ASSERT_TRUE(piece.piece().Derivatives(x, -start.first.head(2), &end));
  const Watched watched = Watch(&piece.piece(), MakeSegment(back, end, 2));
  ASSERT_EQ(watched.happening, Happening::kEvent);
  EXPECT_EQ(watched.t, 0.0);
  EXPECT_LE(towards.length, 0.0);
}

class Swing : public testing::Test {
 protected:
  // A segment over the top of the circle, from before to beyond it. q moves on the same circle whatever the clearance.
  std::unique_ptr<Piece> Over(double clearance) {
    const Scene far = swing::MakeScene(1.0, 0.0);
    TracedPath path = Trace(far, 20);
    path.request.scene = swing::MakeScene(clearance, 0.0);
    row_ = 0;
    while (path.rows[row_ + 1].load_factor < swing::Load(0.0)) ++row_;
    return std::make_unique<Piece>(path, row_);
  }
  std::size_t row_ = 0;
};

TEST_F(Swing, AnInequalityBrokenAndMendedWithinTheSegmentIsFound) {
  for (const double clearance : {-1e-3, -1e-6, -1e-8}) {
    const std::unique_ptr<Piece> piece = Over(clearance);
    const Segment segment = piece->Between(-0.05, 0.1);
    EXPECT_GT(segment.start.x.size(), 0);
    ASSERT_GT(piece->piece().system().Value({0, Inequality::kGap}, segment.end.x), 0.0);
    ASSERT_GT(piece->piece().system().Value({0, Inequality::kGap}, segment.start.x), 0.0);
    const Watched watched = Watch(&piece->piece(), segment);
    if (clearance > -1e-7 && watched.happening == Happening::kNearTouch) continue;  // a row there will tell
    ASSERT_EQ(watched.happening, Happening::kEvent) << clearance;
    const std::optional<CurvePoint> located = Locate(&piece->piece(), segment, watched);
    ASSERT_TRUE(located);
    EXPECT_NEAR(piece->Load(*located), swing::Load(swing::TouchingAngle(clearance)), 1e-11);
  }
}

TEST_F(Swing, ANearMissIsLookedAtMoreClosely) {
  for (const double clearance : {1e-7, 1e-8, 1e-9}) {
    const std::unique_ptr<Piece> piece = Over(clearance);
    const Segment segment = piece->Between(-0.05, 0.1);
    const Watched watched = Watch(&piece->piece(), segment);
    ASSERT_TRUE(watched.happening == Happening::kNearTouch || watched.happening == Happening::kEvent) << clearance;
    if (watched.happening != Happening::kNearTouch) continue;
    const std::optional<CurvePoint> located = Locate(&piece->piece(), segment, watched);
    ASSERT_TRUE(located);
    // On the curve, next to the top.
    EXPECT_NEAR(located->x[3] * piece->model().scaling.length, swing::kCentreY + swing::kRadius, 1e-4);
    EXPECT_LE(piece->piece().CorrectOnPlane(located->x, segment.normal).first_step, 1e-13);
  }
  const std::unique_ptr<Piece> piece = Over(0.05);
  EXPECT_EQ(Watch(&piece->piece(), piece->Between(-0.05, 0.1)).happening, Happening::kNone);
}

}  // namespace
}  // namespace contact_path
