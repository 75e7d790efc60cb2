// One thread for the libraries that a trace uses.
#ifndef CONTACT_PATH_PROCESS_ONE_THREAD_H_
#define CONTACT_PATH_PROCESS_ONE_THREAD_H_

namespace contact_path {

// The OpenMP runtime reads its number of threads while it is loaded, before main(): starts the program over with one,
// unless the user set OMP_NUM_THREADS. The systems are small, and more threads only hinder each other. Where
// that fails, the program goes on as it is. Has the BLAS take its memory, too. To be called first in main(), with its
// argv.
void UseOneThread(char** argv);

}  // namespace contact_path

#endif  // CONTACT_PATH_PROCESS_ONE_THREAD_H_
