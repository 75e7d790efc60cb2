#include <cstddef>
#include <utility>

#include "contact_path/path/end.h"
#include "contact_path/scene/number_text.h"

namespace contact_path {

std::string EndText(const Causes& causes) {
  std::string text;
  for (const Cause& cause : causes) {
    if (!text.empty()) text += text.back() == ':' ? " " : "; ";
    std::string sentence(cause.sentence);
    for (const auto& [mark, words] :
         {std::pair<std::string, std::string>("<unknown>", "is not known: its value is <value>, its error <other>"),
          {"<value>", RoundedText(cause.value)},
          {"<other>", RoundedText(cause.other)},
          {"<digits>", RoundedText(cause.value, 6)},
          {"<count>", std::to_string(static_cast<long>(cause.value))},
          {"<of>", std::to_string(static_cast<long>(cause.other))},
          {"<name>", cause.name}})
      if (const std::size_t at = sentence.find(mark); at != std::string::npos) sentence.replace(at, mark.size(), words);
    text += sentence;
  }
  return text;
}

}  // namespace contact_path
