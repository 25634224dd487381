#include "sim/leaf/serial_blas.hpp"

#include <dlfcn.h>

namespace witherfield::leaf {
namespace {

// Looked up at run time: which BLAS is behind CHOLMOD, and whether CHOLMOD was built with OpenMP, is the system's choice.
int get(const char* name) {
  const auto f = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, name));
  return f ? f() : -1;
}
void set(const char* name, int value) {
  const auto f = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, name));
  if (f) f(value);
}

}  // namespace

SerialBlas::SerialBlas() : levels_(get("omp_get_max_active_levels")), threads_(get("openblas_get_num_threads")) {
  if (levels_ >= 0) set("omp_set_max_active_levels", 0);
  if (threads_ > 1) set("openblas_set_num_threads", 1);
}
SerialBlas::~SerialBlas() {
  if (levels_ >= 0) set("omp_set_max_active_levels", levels_);
  if (threads_ > 1) set("openblas_set_num_threads", threads_);
}

}  // namespace witherfield::leaf
