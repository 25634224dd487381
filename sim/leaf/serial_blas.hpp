// CHOLMOD and BLAS on one thread: the same bits for any thread count, and no time lost in waking threads for small blocks.
#pragma once

namespace witherfield::leaf {

/// While it lives, OpenMP regions (CHOLMOD asks for four threads, whatever the machine has) run on the calling thread, and so
/// does OpenBLAS where that is the BLAS.
class SerialBlas {
 public:
  SerialBlas();
  ~SerialBlas();
  SerialBlas(const SerialBlas&) = delete;
  SerialBlas& operator=(const SerialBlas&) = delete;

 private:
  int levels_ = -1, threads_ = -1;
};

}  // namespace witherfield::leaf
