// Memory that was freed and will be needed again.
#ifndef CONTACT_PATH_PROCESS_KEEP_MEMORY_H_
#define CONTACT_PATH_PROCESS_KEEP_MEMORY_H_

namespace contact_path {

// Each increment takes the factors of a matrix and gives them back. Has the allocator keep up to 1 GiB for the next
// increment instead of giving it back to the system, which clears each page anew: a fifth of the time of large traces.
// Not for a program whose memory is limited, as that of the node: what is kept counts. Does nothing where the C library
// is not glibc. To be called before the first allocation that is large.
void KeepMemory();

}  // namespace contact_path

#endif  // CONTACT_PATH_PROCESS_KEEP_MEMORY_H_
