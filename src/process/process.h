// What a program that traces does first: one thread for its libraries, and memory that it keeps.
#ifndef CONTACT_PATH_SRC_PROCESS_PROCESS_H_
#define CONTACT_PATH_SRC_PROCESS_PROCESS_H_

namespace contact_path {

// The OpenMP runtime reads its number of threads while it is loaded, before main(): starts the program over with one,
// unless the user set OMP_NUM_THREADS. The systems are small, and more threads only hinder each other. Where
// that fails, the program goes on as it is. Has the BLAS take its memory, too. To be called first in main(), with its
// argv.
void UseOneThread(char** argv);

// Each increment takes the factors of a matrix and gives them back. Has the allocator keep up to 1 GiB for the next
// increment instead of giving it back to the system, which clears each page anew: a fifth of the time of large traces.
// Not for a program whose memory is limited, as that of the node: what is kept counts. Does nothing where the C library
// is not glibc. To be called before the first allocation that is large.
void KeepMemory();

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_PROCESS_PROCESS_H_
