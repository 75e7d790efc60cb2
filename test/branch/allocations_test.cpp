// The corrector allocates nothing from one iteration to the next. Counts every call of malloc of this program, so that
// it is built without sanitizers only, which bring an allocator of their own.
#include <gtest/gtest.h>

#include <cstddef>

#include "contact_path/branch/mode_arc.h"
#include "contact_path/path/model.h"
#include "support/traced_path.h"

namespace {

long allocations = 0;

}  // namespace

extern "C" void* __libc_malloc(std::size_t size);  // glibc

extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}

namespace contact_path::allocations_test {
namespace {

struct Counted {
  long allocations = 0;
  Correction correction;
};

Counted Correct(SmoothArc* arc, const Eigen::VectorXd& guess, const Eigen::VectorXd& increment, double value) {
  Counted counted;
  const long before = allocations;
  counted.correction = arc->Correct(guess, increment, value);
  counted.allocations = allocations - before;
  return counted;
}

TEST(Allocations, AreAsManyForFewIterationsOfTheCorrectorAsForMany) {
  for (const char* scene : {"sliding_bar", "von_mises"}) {
    SCOPED_TRACE(scene);
    const Scene example = ReadExample(scene).scene;
    const Model model(example, CharacteristicScales(example));
    ModeArc arc(model.structure, model.laws);
    const PathPoint start = model.InitialPoint();
    arc.SetModes(start);
    const Eigen::VectorXd x = arc.system().Pack(start);
    const Eigen::VectorXd increment = Eigen::VectorXd::Unit(x.size(), arc.NumMotion() - 1);  // the load factor
    const Counted warm_up = Correct(&arc, x, increment, increment.dot(x));
    static_cast<void>(warm_up);
    const Counted few = Correct(&arc, x, increment, increment.dot(x));
    const Counted many = Correct(&arc, x, increment, increment.dot(x) + 0.01);
    EXPECT_GT(many.correction.iterations, few.correction.iterations);
    EXPECT_EQ(many.allocations, few.allocations);
    EXPECT_GT(few.allocations, 0);  // the result: counting works
  }
}

}  // namespace
}  // namespace contact_path::allocations_test
