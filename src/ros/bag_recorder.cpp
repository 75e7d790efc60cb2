#include "contact_path/ros/bag_recorder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <limits>
#include <system_error>
#include <utility>
#include <vector>

#include <rosbag/bag.h>
#include <boost/make_shared.hpp>

#include "contact_path/ros/names.h"

namespace contact_path {
namespace {

constexpr std::size_t kMaxNamePart = 64;
constexpr std::size_t kChunkBytes = 16 * 1024;
constexpr std::chrono::milliseconds kChunkTime{100};
enum ChunkThreshold : std::uint32_t { kAtOnce = 0, kNever = std::numeric_limits<std::uint32_t>::max() };
constexpr char kExtension[] = ".bag";

bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// The number that a bag's name starts with; 0 for a file of another name.
std::uint32_t NumberOf(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  const std::size_t digits = std::min(name.find('_'), name.size());
  const bool numbered = digits > 0 && digits <= std::numeric_limits<std::uint32_t>::digits10 && digits < name.size() &&
                        std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(digits), IsDigit);
  return numbered && path.extension() == kExtension ? static_cast<std::uint32_t>(std::stoul(name)) : 0;
}

std::string FileName(std::uint32_t number, const std::string& part) {
  const std::string digits = std::to_string(number);
  return std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits + "_" + part + kExtension;
}

// Has what is still to be written to `file` go nowhere, and cuts off what is there beyond `size`.
void CutOff(const std::filesystem::path& file, std::uintmax_t size) {
  struct stat wanted {};
  if (::stat(file.c_str(), &wanted) != 0) return;
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere < 0) return;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const int descriptor = std::stoi(entry.path().filename().string());
    struct stat status {};
    if (::fstat(descriptor, &status) == 0 && status.st_dev == wanted.st_dev && status.st_ino == wanted.st_ino)
      ::dup2(nowhere, descriptor);
  }
  ::close(nowhere);
  if (size < static_cast<std::uintmax_t>(wanted.st_size)) std::filesystem::resize_file(file, size);
}

// Gives up a bag that cannot be written, whose first `size` bytes are whole chunks. Its destructor would try once more,
// and end the program by throwing.
void Abandon(const std::filesystem::path& file, std::uintmax_t size, std::unique_ptr<rosbag::Bag> bag) {
  try {
    CutOff(file, size);
    bag->close();
  } catch (const std::exception&) {
    static auto* const abandoned = new std::vector<std::unique_ptr<rosbag::Bag>>;
    abandoned->push_back(std::move(bag));
  }
}

}  // namespace

std::string FileNamePart(const std::string& scene_name) {
  std::string part = scene_name.substr(0, kMaxNamePart);
  for (char& c : part) {
    if (!IsDigit(c) && !IsLetter(c) && c != '-') c = '_';
  }
  return part.empty() ? "scene" : part;
}

BagRecorder::BagRecorder(const std::filesystem::path& directory, const std::string& scene_name,
                         const std::string& topic_prefix, std::uintmax_t reserve)
    : directory_(directory), topic_prefix_(topic_prefix), reserve_(reserve), bag_(std::make_unique<rosbag::Bag>()) {
  try {
    std::filesystem::create_directories(directory_);
    CheckSpace();
    CreateFile(scene_name);
  } catch (const std::filesystem::filesystem_error& error) {
    throw BagError("bag directory " + directory_.string() + ": " + error.code().message());
  }
  Open();
}

BagRecorder::BagRecorder(const std::filesystem::path& file, const std::string& topic_prefix)
    : directory_(file.has_parent_path() ? file.parent_path() : std::filesystem::path(".")),
      topic_prefix_(topic_prefix),
      reserve_(kDefaultReserve),
      file_name_(file.filename().string()),
      bag_(std::make_unique<rosbag::Bag>()) {
  CheckSpace();
  Open();
}

BagRecorder::~BagRecorder() {
  try {
    Close();
  } catch (const std::exception&) {
    // A caller that wants to know calls Close().
  }
}

void BagRecorder::WriteRequest(const contact_path_msgs::TraceRequest& request) {
  CheckSpace();
  Write(names::kRequest, request, /*latched=*/true);
}

void BagRecorder::WriteIncrement(const contact_path_msgs::Increment& increment) {
  CheckSpace();
  const bool first = increment.index == 0;
  chunk_bytes_ += ros::serialization::serializationLength(increment);
  const bool full = chunk_bytes_ >= kChunkBytes || Clock::now() - chunk_time_ > kChunkTime;
  if (full && !first) EndChunk(kAtOnce);
  Write(names::kIncrements, increment);
  if (full || first) EndChunk(kNever);
}

void BagRecorder::WriteResult(const contact_path_msgs::TraceResult& result) {
  EndChunk(kNever);
  Write(names::kResult, result);
}

void BagRecorder::Close() {
  if (!bag_) return;
  std::unique_ptr<rosbag::Bag> bag = std::move(bag_);
  try {
    bag->close();
  } catch (const std::exception& error) {
    Abandon(directory_ / file_name_, whole_, std::move(bag));
    throw BagError("bag " + file_name_ + " cannot be closed, `rosbag reindex` restores what it holds: " + error.what());
  }
}

// `rosbag reindex` takes chunks that are followed by their index, and gives up a bag where the definition of a topic is
// the last thing. So the first chunk holds the request and the first increment, no chunk ends but here, and what is
// still in the buffers of the C library is written.
//
// rosbag keeps what it has written until a chunk has grown beyond its threshold. So the last increment of each 16 KiB
// is a chunk of its own that does so at once: or else the memory would grow with the bag.
void BagRecorder::EndChunk(std::uint32_t next_threshold) {
  if (!bag_) return;
  try {
    bag_->setChunkThreshold(next_threshold);  // ends the chunk that is open, too
  } catch (const rosbag::BagException& error) {
    throw BagError("bag " + file_name_ + " cannot be written: " + error.what());
  }
  if (next_threshold == kAtOnce) return;
  // rosbag keeps its stream to itself. Where this fails, so does what is written next.
  if (std::fflush(nullptr) == 0) {
    std::error_code error;  // of a bag that was removed meanwhile
    const std::uintmax_t size = std::filesystem::file_size(directory_ / file_name_, error);
    if (error) throw BagError("bag " + file_name_ + ": " + error.message());
    whole_ = size;
  }
  chunk_time_ = Clock::now();
  chunk_bytes_ = 0;
}

void BagRecorder::Open() {
  try {
    bag_->setChunkThreshold(kNever);
    bag_->open((directory_ / file_name_).string(), rosbag::bagmode::Write);
  } catch (const rosbag::BagException& error) {
    Abandon(directory_ / file_name_, whole_, std::move(bag_));
    throw BagError("bag " + (directory_ / file_name_).string() + " cannot be opened: " + error.what());
  }
}

void BagRecorder::CreateFile(const std::string& scene_name) {
  for (const auto& entry : std::filesystem::directory_iterator(directory_)) {
    number_ = std::max(number_, NumberOf(entry.path()));
  }
  const std::string part = FileNamePart(scene_name);
  for (;;) {
    ++number_;
    file_name_ = FileName(number_, part);
    // Fails for a file that another program has created meanwhile.
    const int file = ::open((directory_ / file_name_).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (file >= 0) {
      ::close(file);
      return;
    }
    if (errno != EEXIST) {
      const std::error_code code(errno, std::generic_category());
      throw BagError("bag " + (directory_ / file_name_).string() + " cannot be created: " + code.message());
    }
  }
}

void BagRecorder::CheckSpace() const {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(directory_, error);
  if (error) throw BagError("bag directory " + directory_.string() + ": " + error.message());
  if (space.available < reserve_) {
    throw BagError("bag directory " + directory_.string() + ": " + std::to_string(space.available) +
                   " bytes are free, but " + std::to_string(reserve_) + " are to be kept");
  }
}

template <typename Message>
void BagRecorder::Write(const char* topic, const Message& message, bool latched) {
  if (!bag_) throw BagError("bag " + file_name_ + " is closed");
  // Readers sort by time: the order must survive clocks that stand still or jump back.
  last_stamp_ = std::max(StampNow(), last_stamp_ + ros::Duration(0, 1));
  boost::shared_ptr<ros::M_string> connection;  // null: the bag makes one, of a topic that is not latched
  if (latched) {
    connection = boost::make_shared<ros::M_string>();
    (*connection)["type"] = ros::message_traits::datatype(message);
    (*connection)["md5sum"] = ros::message_traits::md5sum(message);
    (*connection)["message_definition"] = ros::message_traits::definition(message);
    (*connection)["latching"] = "1";
  }
  try {
    bag_->write(topic_prefix_ + "/" + topic, last_stamp_, message, connection);
  } catch (const rosbag::BagException& error) {
    throw BagError("bag " + file_name_ + " cannot be written: " + error.what());
  }
}

}  // namespace contact_path
