#include "contact_path/scene/number_text.h"

#include <cmath>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>

namespace contact_path {

std::string NumberText(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
  std::string text;
  for (int digits = 15; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    text = RoundedText(value, digits);
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    double back = 0.0;
    if (in >> back && back == value) break;
  }
  return text;
}

std::string RoundedText(double value, int digits) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::setprecision(digits) << value;
  return out.str();
}

}  // namespace contact_path
