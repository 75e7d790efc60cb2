#include "cli/progress.h"

#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <string>

namespace contact_path::progress_test {
namespace {

using std::chrono::steady_clock;

// A bar whose time is told by the test.
class ProgressBar : public testing::Test {
 protected:
  // What stands on the terminal after an increment at this time [s] since the first one.
  std::string After(double seconds, int index, double load_factor) {
    if (!progress_) progress_ = std::make_unique<Progress>(request_, true, out_, [this] { return now_; });
    now_ = start_ + std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(seconds));
    increment_.index = index;
    increment_.load_factor = load_factor;
    increment_.positions.assign(2, 0.0);
    out_.str("");
    progress_->Add(increment_);
    const std::string text = out_.str();
    return text.substr(text.find_last_of("K\r") + 1);  // after the wiping of the line
  }

  TraceRequest request_;
  Increment increment_;

 private:
  const steady_clock::time_point start_ = steady_clock::now();
  steady_clock::time_point now_ = start_;
  std::ostringstream out_;
  std::unique_ptr<Progress> progress_;
};

TEST_F(ProgressBar, TellsTheTimeLeftOfTheWantedIncrements) {
  request_.options.max_increments = 200;
  EXPECT_EQ(After(0.0, 0, 0.0), "[              ]   0%  increment 0  load factor 0  events 0");
  EXPECT_EQ(After(10.0, 50, 0.25), "[###           ]  25%  increment 50  load factor 0.25  events 0  0:30 left");
  EXPECT_EQ(After(80.0, 100, 0.5), "[#######       ]  50%  increment 100  load factor 0.5  events 0  1:20 left");
}

TEST_F(ProgressBar, EstimatesByTheCriterionThatIsNearest) {
  request_.options.max_increments = 1000;
  request_.options.stop = {{"load_factor", ">", 4.0}};
  After(0.0, 0, 0.0);
  EXPECT_EQ(After(3600.0, 10, 1.0), "[###           ]  25%  increment 10  load factor 1  events 0  3:00:00 left");
}

TEST_F(ProgressBar, EstimatesNothingFromTooLittle) {
  request_.options.max_increments = 1000;
  After(0.0, 0, 0.0);
  EXPECT_EQ(After(60.0, 10, 0.0).find("left"), std::string::npos);  // one of a hundred
  EXPECT_NE(After(61.0, 20, 0.0).find("left"), std::string::npos);
}

TEST_F(ProgressBar, EstimatesNothingInTheFirstMoments) {
  request_.options.max_increments = 10;
  After(0.0, 0, 0.0);
  EXPECT_EQ(After(2.9, 5, 0.0).find("left"), std::string::npos);
  EXPECT_NE(After(3.1, 6, 0.0).find("left"), std::string::npos);
}

TEST_F(ProgressBar, WithoutAnEndShowsWhereItIs) {
  After(0.0, 0, 0.0);
  increment_.event.number = 1;
  EXPECT_EQ(After(100.0, 7, -1.5), "increment 7  load factor -1.5  events 1");
}

}  // namespace
}  // namespace contact_path::progress_test
