#include "contact_path/contact/deformable_boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/deformable_contacts.h"
#include "support/random.h"

namespace contact_path::deformable_boundary_test {
namespace {

// Against the nearest of many points.
TEST(BoundaryAt, FindsWhatIsNearest) {
  Random random(4);
  for (const bool closed : {false, true})
    for (const int count : {2, 3, 9, 40}) {
      if (closed && count == 2) continue;
      DeformableContact contact(count, closed, 0.05);
      contact.u += random.Vector(contact.u.size(), -0.1, 0.1);
      const BoundaryAt at = contact.Shape();
      const XiRange range = at.Range();
      for (int i = 0; i < 30; ++i) {
        const double size = closed ? 1.5 : 0.6 * count;
        const Eigen::Vector2d x(random.Number(closed ? -size : -0.3, size), random.Number(-1.5, 1.5));
        const int samples = 400 * count;
        double least = std::numeric_limits<double>::infinity();
        for (int k = 0; k <= samples; ++k)
          least = std::min(least, (x - at.PointAt(range.begin + (range.end - range.begin) * k / samples)).norm());
        const NearestFoot nearest = at.Nearest(x);
        EXPECT_LE(nearest.distance, least + 1e-14);
        EXPECT_NEAR(nearest.distance, least, 1e-3);
        if (!nearest.is_end) {
          const Projection foot = at.Project(x, nearest.patch);
          EXPECT_NEAR(std::abs(foot.gap + 0.05), nearest.distance, 1e-13);
        }
      }
    }
}

// Rounding does not lose the foot between two patches.
TEST(BoundaryAt, FindsFeetWherePatchesMeet) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    DeformableContact contact(6, false, 0.0);
    contact.u += random.Vector(contact.u.size(), -0.1, 0.1);
    contact.PutBeside(2, 1.0, random.Number(0.0, 0.3));
    const BoundaryAt at = contact.Shape();
    const Eigen::Vector2d x = contact.u.tail<2>();
    const int patch = PatchBeside(at, x);
    EXPECT_TRUE(patch == 2 || patch == 3);
    EXPECT_NEAR(at.Project(x, patch).xi, at.RangeOf(2).end, 1e-12);
  }
}

TEST(BoundaryAt, XiStaysWithTheMaterial) {
  DeformableContact contact(5, false, 0.0);
  const BoundaryAt at = contact.Shape();
  const double xi = 0.37 * contact.boundary->LengthPerKnot();
  const Eigen::Vector2d before = at.PointAt(xi);
  contact.u *= 2.0;
  EXPECT_LE((at.PointAt(xi) - 2.0 * before).norm(), 1e-14);
}

}  // namespace
}  // namespace contact_path::deformable_boundary_test
