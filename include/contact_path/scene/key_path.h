// The place of a value in a request, e.g. "scene.bars[0].EA", which is written out only where a message needs it.
#ifndef CONTACT_PATH_SCENE_KEY_PATH_H_
#define CONTACT_PATH_SCENE_KEY_PATH_H_

#include <cstddef>
#include <string>
#include <string_view>

namespace contact_path {

// Refers to the path that it extends, which must outlive it: paths are made on the way down into a request.
class KeyPath {
 public:
  KeyPath() = default;  // the request itself
  explicit KeyPath(std::string_view key) : key_(key) {}

  KeyPath Key(std::string_view key) const { return {this, key, 0}; }
  KeyPath operator[](std::size_t index) const { return {this, {}, index}; }

  std::string ToString() const {
    if (outer_ == nullptr) return std::string(key_);
    const std::string outer = outer_->ToString();
    if (key_.data() == nullptr) return outer + "[" + std::to_string(index_) + "]";
    return outer.empty() ? std::string(key_) : outer + "." + std::string(key_);
  }

 private:
  KeyPath(const KeyPath* outer, std::string_view key, std::size_t index) : outer_(outer), key_(key), index_(index) {}

  const KeyPath* outer_ = nullptr;
  std::string_view key_;  // without data: an element of a list
  std::size_t index_ = 0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_KEY_PATH_H_
