#include "contact_path/ros/bag_recorder.h"

#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sys/resource.h>

#include "contact_path/ros/memory_share.h"

namespace contact_path::bag_recorder_test {
namespace {

namespace fs = std::filesystem;
namespace msgs = contact_path_msgs;

constexpr char kPrefix[] = "/tracer";

// A directory of its own for each test, removed with what it holds.
class BagRecorderTest : public testing::Test {
 protected:
  BagRecorderTest() {
    std::string name = (fs::temp_directory_path() / "bag_recorder_test_XXXXXX").string();
    directory_ = ::mkdtemp(name.data());
  }
  ~BagRecorderTest() override { fs::remove_all(directory_); }

  std::vector<std::string> Files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory_)) names.push_back(entry.path().filename().string());
    return names;
  }

  void Touch(const std::string& name) const { std::ofstream(directory_ / name) << "not a bag"; }

  fs::path directory_;
};

std::ptrdiff_t NumberOfDescriptors() {
  return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
}

msgs::Increment IncrementOf(std::uint32_t index, std::size_t nodes = 2) {
  msgs::Increment increment;
  increment.index = index;
  increment.x.assign(nodes, 0.5 * index);
  increment.y.assign(nodes, -0.5 * index);
  return increment;
}

void Record(BagRecorder* recorder, std::uint32_t increments) {
  msgs::TraceRequest request;
  request.scene.name = "recorded";
  recorder->WriteRequest(request);
  for (std::uint32_t i = 0; i < increments; ++i) recorder->WriteIncrement(IncrementOf(i));
  msgs::TraceResult result;
  result.increments = increments;
  recorder->WriteResult(result);
}

// Expects a bag as Record() writes it.
void ExpectRecorded(const fs::path& file, std::uint32_t increments) {
  const rosbag::Bag bag(file.string(), rosbag::bagmode::Read);
  std::uint32_t position = 0;
  for (const rosbag::MessageInstance& entry : rosbag::View(bag)) {
    if (position == 0) {
      EXPECT_EQ(entry.getTopic(), "/tracer/request");
      const auto request = entry.instantiate<msgs::TraceRequest>();
      ASSERT_TRUE(request);
      EXPECT_EQ(request->scene.name, "recorded");
    } else if (position <= increments) {
      EXPECT_EQ(entry.getTopic(), "/tracer/increments");
      const auto increment = entry.instantiate<msgs::Increment>();
      ASSERT_TRUE(increment);
      EXPECT_EQ(*increment, IncrementOf(position - 1));
    } else {
      EXPECT_EQ(entry.getTopic(), "/tracer/result");
      EXPECT_TRUE(entry.instantiate<msgs::TraceResult>());
    }
    ++position;
  }
  EXPECT_EQ(position, increments + 2);
}

TEST_F(BagRecorderTest, HoldsRequestIncrementsAndResultInOrder) {
  BagRecorder recorder(directory_, "recorded", kPrefix);
  Record(&recorder, 1000);
  recorder.Close();
  ExpectRecorded(directory_ / recorder.file_name(), 1000);
}

TEST_F(BagRecorderTest, TypesInTheBagAreThoseOfThePackage) {
  BagRecorder recorder(directory_, "recorded", kPrefix);
  Record(&recorder, 1);
  recorder.Close();
  const rosbag::Bag bag((directory_ / recorder.file_name()).string(), rosbag::bagmode::Read);
  std::vector<std::string> types;
  for (const rosbag::MessageInstance& entry : rosbag::View(bag)) types.push_back(entry.getDataType());
  EXPECT_EQ(types, (std::vector<std::string>{"contact_path/TraceRequest", "contact_path/Increment",
                                             "contact_path/TraceResult"}));
}

TEST_F(BagRecorderTest, KeepsTheOrderWhenTheClockStandsStillOrJumpsBack) {
  ros::Time::setNow(ros::Time(1000, 0));
  BagRecorder recorder(directory_, "recorded", kPrefix);
  msgs::TraceRequest request;
  request.scene.name = "recorded";
  recorder.WriteRequest(request);
  recorder.WriteIncrement(IncrementOf(0));
  ros::Time::setNow(ros::Time(10, 0));
  recorder.WriteIncrement(IncrementOf(1));
  ros::Time::setNow(ros::Time(0, 0));  // as before the first tick of a simulated clock
  recorder.WriteIncrement(IncrementOf(2));
  recorder.WriteResult(msgs::TraceResult());
  recorder.Close();
  ros::Time::init();
  ExpectRecorded(directory_ / recorder.file_name(), 3);
}

TEST_F(BagRecorderTest, ClosesTheBagOnTheWayOutOfAnException) {
  std::string file_name;
  try {
    BagRecorder recorder(directory_, "recorded", kPrefix);
    file_name = recorder.file_name();
    Record(&recorder, 5);
    throw std::runtime_error("trouble");
  } catch (const std::runtime_error&) {
    ExpectRecorded(directory_ / file_name, 5);
  }
}

TEST_F(BagRecorderTest, WritesNothingAfterClose) {
  BagRecorder recorder(directory_, "recorded", kPrefix);
  Record(&recorder, 1);
  recorder.Close();
  EXPECT_NO_THROW(recorder.Close());
  EXPECT_THROW(recorder.WriteIncrement(IncrementOf(1)), BagError);
  ExpectRecorded(directory_ / recorder.file_name(), 1);
}

TEST_F(BagRecorderTest, CreatesTheDirectory) {
  const fs::path below = directory_ / "not" / "yet";
  BagRecorder recorder(below, "recorded", kPrefix);
  Record(&recorder, 1);
  recorder.Close();
  ExpectRecorded(below / "000001_recorded.bag", 1);
}

TEST_F(BagRecorderTest, NumbersGoOnAfterWhatIsThere) {
  Touch("000003_b.bag");
  Touch("000017_a.bag");
  Touch("99_notes.txt");
  Touch("12345678901234567890_a.bag");
  Touch("_.bag");
  Touch("000020.bag");
  BagRecorder first(directory_, "s", kPrefix);
  EXPECT_EQ(first.number(), 18U);
  EXPECT_EQ(first.file_name(), "000018_s.bag");
  const BagRecorder second(directory_, "s", kPrefix);
  EXPECT_EQ(second.file_name(), "000019_s.bag");
}

TEST_F(BagRecorderTest, NumbersMayHaveMoreThanSixDigits) {
  Touch("999999_a.bag");
  EXPECT_EQ(BagRecorder(directory_, "s", kPrefix).file_name(), "1000000_s.bag");
  EXPECT_EQ(BagRecorder(directory_, "s", kPrefix).file_name(), "1000001_s.bag");
}

TEST_F(BagRecorderTest, DoesNotFollowALinkInPlaceOfTheBag) {
  fs::create_symlink(directory_ / "elsewhere.bag", directory_ / "000001_s.bag");
  EXPECT_EQ(BagRecorder(directory_, "s", kPrefix).file_name(), "000002_s.bag");
  EXPECT_FALSE(fs::exists(directory_ / "elsewhere.bag"));
}

TEST_F(BagRecorderTest, NoSceneNameLeadsOutOfTheDirectory) {
  for (const char* const name :
       {"../../etc/passwd", "/absolute", "..", "a/b", "C:\\x", "line\nbreak", "\xc3\x9f", "", "-rf"}) {
    const std::size_t before = Files().size();
    BagRecorder recorder(directory_ / "bags", name, kPrefix);
    const fs::path file = directory_ / "bags" / recorder.file_name();
    EXPECT_TRUE(fs::is_regular_file(file)) << file;
    EXPECT_EQ(fs::canonical(file).parent_path(), fs::canonical(directory_ / "bags")) << file;
    EXPECT_LE(Files().size(), before + 1);  // the directory of the bags alone
  }
}

TEST(FileNamePartTest, KeepsPlainNamesAndReplacesTheRest) {
  EXPECT_EQ(FileNamePart("Sliding_bar-2"), "Sliding_bar-2");
  EXPECT_EQ(FileNamePart("../a b.c"), "___a_b_c");
  EXPECT_EQ(FileNamePart(std::string("a\0b", 3)), "a_b");
  EXPECT_EQ(FileNamePart(""), "scene");
  EXPECT_EQ(FileNamePart(std::string(1000, 'x')), std::string(64, 'x'));
}

TEST_F(BagRecorderTest, SaysSoWhereTheDirectoryCannotBe) {
  Touch("file");
  try {
    const BagRecorder recorder(directory_ / "file" / "bags", "s", kPrefix);
    FAIL() << "was opened";
  } catch (const BagError& error) {
    EXPECT_NE(std::string(error.what()).find((directory_ / "file").string()), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("Not a directory"), std::string::npos) << error.what();
  }
  EXPECT_THROW(BagRecorder("/proc/contact_path", "s", kPrefix), BagError);
}

TEST_F(BagRecorderTest, RefusesToOpenWithoutItsReserve) {
  EXPECT_THROW(BagRecorder(directory_, "s", kPrefix, std::numeric_limits<std::uintmax_t>::max()), BagError);
  EXPECT_TRUE(Files().empty());
}

// What a killed node leaves: the file as it is while the recorder lives. A bag without index cannot be opened, but what
// is in its chunks is in the file.
TEST_F(BagRecorderTest, IncrementsOfASlowTraceReachTheFileAtOnce) {
  BagRecorder recorder(directory_, "s", kPrefix);
  recorder.WriteRequest(msgs::TraceRequest());
  const fs::path file = directory_ / recorder.file_name();
  const auto holds = [&](const std::string& text) {
    std::ifstream in(file, std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    return content.find(text) != std::string::npos;
  };
  for (std::uint32_t i = 0; i < 3; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(110));
    msgs::Increment increment = IncrementOf(i);
    increment.header.frame_id = "increment number " + std::to_string(i);
    recorder.WriteIncrement(increment);
    EXPECT_TRUE(holds(increment.header.frame_id)) << i;
  }
}

TEST_F(BagRecorderTest, SaysSoWhenTheBagIsRemoved) {
  BagRecorder recorder(directory_, "s", kPrefix);
  recorder.WriteRequest(msgs::TraceRequest());
  fs::remove(directory_ / recorder.file_name());
  EXPECT_THROW(recorder.WriteIncrement(IncrementOf(0)), BagError);
  EXPECT_THROW(recorder.WriteResult(msgs::TraceResult()), BagError);
}

// Of long increments, and of short ones that share their chunks.
TEST_F(BagRecorderTest, MemoryDoesNotGrowWithTheBag) {
  if (DataMegabytes() == 0.0) GTEST_SKIP() << "not counted in this build";
  for (const std::size_t nodes : {2000U, 20U}) {
    BagRecorder recorder(directory_, "s", kPrefix);
    recorder.WriteRequest(msgs::TraceRequest());
    msgs::Increment increment = IncrementOf(0, nodes);
    const auto write = [&](std::size_t megabytes) {
      const std::size_t increments = (megabytes << 20U) / ros::serialization::serializationLength(increment);
      for (std::size_t i = 0; i < increments; ++i, ++increment.index) recorder.WriteIncrement(increment);
    };
    write(2);
    const double before = DataMegabytes();
    write(40);
    EXPECT_LT(DataMegabytes() - before, 4.0) << nodes;
  }
}

// A limit on the size of files stands for a full disk: writing fails in the middle of the trace.
TEST_F(BagRecorderTest, SaysSoWhenWritingFailsAndGoesOnLiving) {
  const auto descriptors = NumberOfDescriptors();
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  struct rlimit limited = before;
  limited.rlim_cur = 100 * 1024;
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  {
    BagRecorder recorder(directory_, "s", kPrefix);
    recorder.WriteRequest(msgs::TraceRequest());
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limited), 0);
    const auto write_much = [&recorder] {
      for (std::uint32_t i = 0; i < 1000; ++i) recorder.WriteIncrement(IncrementOf(i, 100));
    };
    EXPECT_THROW(write_much(), BagError);
    EXPECT_THROW(recorder.Close(), BagError);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(NumberOfDescriptors(), descriptors);

  BagRecorder next(directory_, "recorded", kPrefix);
  Record(&next, 1);
  next.Close();
  ExpectRecorded(directory_ / next.file_name(), 1);
}

}  // namespace
}  // namespace contact_path::bag_recorder_test
