#include <cstddef>
#include <string>
#include <utility>
#include <variant>

#include "contact_path/path/end.h"
#include "contact_path/scene/number_text.h"

namespace contact_path {
namespace {

std::string TextOf(const Number& number, int digits = 2) {
  if (const long* count = std::get_if<long>(&number)) return std::to_string(*count);
  return RoundedText(std::get<double>(number), digits);
}

}  // namespace

std::string EndText(const Causes& causes) {
  std::string text;
  for (const Cause& cause : causes) {
    if (!text.empty()) text += text.back() == ':' ? " " : "; ";
    std::string sentence(cause.sentence);
    for (const auto& [mark, words] :
         {std::pair<std::string, std::string>("<unknown>", "is not known: its value is <value>, its error <other>"),
          {"<value>", TextOf(cause.value)},
          {"<other>", TextOf(cause.other)},
          {"<digits>", TextOf(cause.value, 6)},
          {"<name>", cause.name}})
      if (const std::size_t at = sentence.find(mark); at != std::string::npos) sentence.replace(at, mark.size(), words);
    text += sentence;
  }
  return text;
}

}  // namespace contact_path
