#include "contact_path/linear/blas.h"

#include <dlfcn.h>

#include <utility>
#include <vector>

namespace contact_path {
namespace {

constexpr const char* kReferenceBlas = "reference BLAS";
constexpr std::size_t kManyNodes = 10000;  // from which on another BLAS saves half of the time

// A function of the libraries that are loaded; null if there is none of this name.
template <typename Function>
Function* Find(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_DEFAULT, name));
}

}  // namespace

OneBlasThread::OneBlasThread() {
  auto* const get = Find<int()>("openblas_get_num_threads");
  auto* const set = Find<void(int)>("openblas_set_num_threads");
  if (get == nullptr || set == nullptr) return;
  before_ = get();
  set(1);
}

OneBlasThread::~OneBlasThread() {
  if (before_ > 1) Find<void(int)>("openblas_set_num_threads")(before_);
}

void WarmUpBlas() {
  using UpdateSymmetric = void(const char*, const char*, const int*, const int*, const double*, const double*,
                               const int*, const double*, double*, const int*);
  auto* const update = Find<UpdateSymmetric>("dsyrk_");
  if (update == nullptr) return;
  const OneBlasThread one_thread;
  const int n = 32;
  const double one = 1.0, zero = 0.0;
  const std::vector<double> a(static_cast<std::size_t>(n) * n, 1.0);
  std::vector<double> product(a.size());
  update("L", "N", &n, &n, &one, a.data(), &n, &zero, product.data(), &n);
}

std::string LoadedBlas() {
  for (const auto& [symbol, name] :
       {std::pair("openblas_get_config", "OpenBLAS"), std::pair("MKL_Get_Version", "MKL"),
        std::pair("bli_info_get_version_str", "BLIS"), std::pair("ATL_buildinfo", "ATLAS")})
    if (::dlsym(RTLD_DEFAULT, symbol) != nullptr) return name;
  return kReferenceBlas;
}

std::string BlasAdvice(std::size_t nodes) {
  if (nodes < kManyNodes || LoadedBlas() != kReferenceBlas) return {};
  return "the reference BLAS is loaded, with which a structure of this size takes up to 2.5 times as long as with "
         "libopenblas0-serial";
}

}  // namespace contact_path
