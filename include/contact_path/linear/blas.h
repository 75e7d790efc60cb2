// The BLAS that the process has loaded: its dense kernels take most of the time of large structures.
#ifndef CONTACT_PATH_LINEAR_BLAS_H_
#define CONTACT_PATH_LINEAR_BLAS_H_

#include <cstddef>
#include <string>

namespace contact_path {

// Has the BLAS compute with one thread for as long as this lives, whatever the environment says: with several, sums are
// rounded in another order. Known is the call of OpenBLAS; the reference BLAS has no threads. The number is one of
// the whole process: traces side by side set it in turn.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  int before_ = 0;  // threads; 0: not known
};

// Has the BLAS take the memory that it keeps for its kernels. OpenBLAS ends the process where that fails, so programs
// call this before memory is limited or used up.
void WarmUpBlas();

// "OpenBLAS", "MKL", "BLIS", "ATLAS", or "reference BLAS" where none of these is loaded.
std::string LoadedBlas();

// One sentence for people whose structure has so many nodes that another BLAS would be worth its installation; empty
// where it would not, or is loaded.
std::string BlasAdvice(std::size_t nodes);

}  // namespace contact_path

#endif  // CONTACT_PATH_LINEAR_BLAS_H_
